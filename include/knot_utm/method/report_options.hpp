#pragma once

#include <optional>
#include <string>
#include <vector>

namespace knot_utm {

enum class ForceUnit { kNewton, kKilonewton, kPoundForce };
enum class LengthUnit { kMillimetre, kInch, kMetre };

/// What a report says in addition to the results. None of it changes a number of the test. The test's files stay in SI
/// units.
struct ReportOptions {
  std::string specimen_id;
  std::string standard;
  std::string conditioning;  ///< of the specimens before the test
  std::string terminations;  ///< of the specimen's ends in the grips
  std::string notes;
  ForceUnit force = ForceUnit::kNewton;
  LengthUnit length = LengthUnit::kMillimetre;
};

/// A requirement on one number of result.yaml, in the unit of that file. At least one of the limits is set.
struct Requirement {
  std::string key;
  std::optional<double> min;
  std::optional<double> max;
};

/// The requirements in the order of the method. Empty: there are none.
using Specification = std::vector<Requirement>;

}  // namespace knot_utm
