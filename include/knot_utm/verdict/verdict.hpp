#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/words/yaml_lines.hpp"

namespace knot_utm {

/// Whether a test meets its specification.
struct Verdict {
  std::optional<bool> passed;       ///< empty: there are no requirements
  std::vector<std::string> failed;  ///< one line for each requirement that was not met, with the reason
};

void check_specification(const Specification& specification);

/// Compares the results with the specification. A number that the test does not have meets no requirement.
Verdict verdict(const Specification& specification, const YamlLines& results);

}  // namespace knot_utm
