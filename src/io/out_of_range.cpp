#include "out_of_range.hpp"

#include <cmath>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm {

InvalidInput narrowed(const OutOfRange& wrong, const std::function<void(const std::string& override)>& attempt) {
  std::string here;
  for (const double end : {wrong.min, wrong.max}) {
    if (!std::isfinite(end)) continue;
    try {
      attempt(wrong.key + "=" + format_yaml_number(end));
    } catch (const InvalidInput& inner) {
      const bool says_a_range = std::string(inner.what()).find(", but must be " + inner.allowed) != std::string::npos;
      if (inner.key != wrong.key || !says_a_range || here.find(inner.allowed) != std::string::npos) continue;
      here += (here.empty() ? ", and here " : " and ") + inner.allowed;
    }
  }
  return {wrong.file, wrong.key, wrong.value, wrong.allowed + here};
}

}  // namespace knot_utm
