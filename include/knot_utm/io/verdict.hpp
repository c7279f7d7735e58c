#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/io/report_options.hpp"
#include "knot_utm/io/yaml_lines.hpp"

namespace knot_utm {

/// How a test stands against its specification.
struct Verdict {
  std::optional<bool> passed;       ///< none: nothing was asked for
  std::vector<std::string> failed;  ///< one line for each requirement that was not met, with the reason
};

/// A number that the test does not have meets no requirement.
Verdict verdict(const Specification& specification, const YamlLines& results);

}  // namespace knot_utm
