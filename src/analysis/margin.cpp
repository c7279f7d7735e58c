#include "knot_utm/analysis/margin.hpp"

#include <cmath>

namespace knot_utm {
namespace {

constexpr int kBisections = 3;

}  // namespace

double fraction_until_it_opens(const std::function<bool(double)>& opens) {
  double open = 1.0 - Margin::kMost, holds = 1.0;
  if (!opens(open)) return Margin::kMost;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = std::sqrt(open * holds);
    (opens(middle) ? open : holds) = middle;
  }
  return 1.0 - std::sqrt(open * holds);
}

}  // namespace knot_utm
