#include "knot_utm/verdict/verdict.hpp"

#include <algorithm>

#include "knot_utm/verdict/result_keys.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

/// Why a requirement is not met; empty: it is.
std::string reason(const Requirement& required, const std::optional<double>& value) {
  if (!value) return required.key + " has no value in this test";
  const std::string is = required.key + " is " + format_number(*value);
  if (required.min && !(*value >= *required.min))
    return is + ", less than the least that is allowed, " + format_number(*required.min);
  if (required.max && !(*value <= *required.max))
    return is + ", more than the most that is allowed, " + format_number(*required.max);
  return {};
}

}  // namespace

void check_specification(const Specification& specification) {
  std::vector<std::string> known;
  for (const ResultKey& key : result_keys())
    if (key.is_number()) known.emplace_back(key.name);
  for (const Requirement& required : specification)
    if (std::find(known.begin(), known.end(), required.key) == known.end())
      throw InvalidInput::unknown_key("specification", required.key, known, "a specification");
}

Verdict verdict(const Specification& specification, const YamlLines& results) {
  Verdict verdict;
  for (const Requirement& required : specification) {
    const std::string why = reason(required, results.value(required.key));
    if (!why.empty()) verdict.failed.push_back(why);
  }
  if (!specification.empty()) verdict.passed = verdict.failed.empty();
  return verdict;
}

}  // namespace knot_utm
