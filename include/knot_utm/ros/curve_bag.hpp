#pragma once

#include <string>
#include <vector>

#include "knot_utm/io/csv.hpp"

namespace knot_utm {

/// The readings of a bag that has utm/load_cell and utm/crosshead of the same stamps, under whatever namespace: those
/// of a simulated test, and of a measured one that was brought into this form. Extension, knot distance and the lower
/// force are those of knot/state where the bag has it; else the extension is the crosshead's displacement, what was not
/// measured is NaN. Throws InvalidInput where the file is no bag, a topic is missing or stands there twice. A bag whose
/// index is damaged may end the process: rosbag trusts it.
std::vector<CurveRow> read_curve_bag(const std::string& file);

/// A bag of these two topics, one reading a command, stamps a nanosecond apart at least; the last digit of each number
/// is kept. Throws std::runtime_error
/// where it cannot be written.
void write_curve_bag(const std::string& file, const std::vector<CurveRow>& rows);

}  // namespace knot_utm
