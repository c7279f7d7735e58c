#pragma once

#include <string>
#include <vector>

#include "knot_utm/run/csv.hpp"

namespace knot_utm {

/// Reads a curve from a bag with the topics utm/load_cell and utm/crosshead, in any namespace, whose stamps agree. Bags
/// of simulated tests have this form, and measured ones can be brought into it. Extension, knot distance and the force
/// on the lower grip are taken from knot/state where the bag has it. Otherwise the extension is the displacement of the
/// crosshead, and what was not measured is NaN; without utm/crosshead these are loads over time alone. `test`: which
/// one of several tests in the bag, from 1; 0: there must be only one. Throws InvalidInput where the file is not a bag,
/// a topic is missing or occurs twice, or there is no such test. A bag with a damaged index may end the process,
/// because rosbag trusts the index.
std::vector<CurveRow> read_curve_bag(const std::string& file, int test = 0);

/// Reads a record, a bag or a curve.csv, from where it is pulled on; of several tests in a bag the first.
std::vector<CurveRow> read_record(const std::string& file);

/// Writes a bag of these two topics, with one command for each reading unless there is no travel. Stamps are at least a
/// nanosecond apart, and numbers keep their last digit. Throws std::runtime_error where the file cannot be written.
void write_curve_bag(const std::string& file, const std::vector<CurveRow>& rows);

}  // namespace knot_utm
