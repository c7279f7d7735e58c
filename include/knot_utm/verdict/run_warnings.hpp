#pragma once

#include <string>
#include <vector>

#include "knot_utm/verdict/known_errors.hpp"

namespace knot_utm {

/// Overlap beyond which a contact no longer represents the contact of the rod [fraction of radius]. It is larger than
/// the overlaps of every shipped material at its largest load.
inline constexpr double kDeepContact = 0.05;
/// The same of sections that give, up to which their pressure law is a rubber cylinder's: half of the diameter.
inline constexpr double kDeepSoftContact = 1.0;
inline double deepest_contact(const RodMaterial& material) {
  return material.is_soft() ? kDeepSoftContact : kDeepContact;
}

/// A warning, one line, where the plateau force may be wrong by more than a tenth. Otherwise empty.
std::string accuracy_warning(const Results& results, const ReadingErrors& errors);

/// The warnings that are also printed on the console, one line each.
std::vector<std::string> printed_warnings(const Results& results, const RunFacts& facts);

/// All warnings that a reader of the results should know, one line each. The printed ones are among them.
std::vector<std::string> all_warnings(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
