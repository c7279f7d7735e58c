#pragma once

#include <optional>
#include <string>
#include <vector>

namespace knot_utm {

enum class ForceUnit { kNewton, kKilonewton, kPoundForce };
enum class LengthUnit { kMillimetre, kInch, kMetre };

/// What a report says beside the test itself. Nothing of it changes a number of the test, whose files stay in SI.
struct ReportOptions {
  std::string specimen_id;
  std::string operator_name;
  std::string customer;
  std::string date;  ///< as the user writes it: a page made again is the same to the last byte
  std::string standard;
  std::string conditioning;  ///< of the specimens before the test
  std::string terminations;  ///< of the specimen's ends in the grips
  std::string notes;
  std::string logo;       ///< a PNG or SVG file; empty: none
  std::string signature;  ///< the name under a line to sign on; empty: no line
  ForceUnit force = ForceUnit::kNewton;
  LengthUnit length = LengthUnit::kMillimetre;
};

/// What a user asks of one number of result.yaml, in the unit of that file. At least one limit is set.
struct Requirement {
  std::string key;
  std::optional<double> min;
  std::optional<double> max;
};

/// In the order of the method; empty: nothing is asked for.
using Specification = std::vector<Requirement>;

}  // namespace knot_utm
