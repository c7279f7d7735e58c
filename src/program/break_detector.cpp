#include "knot_utm/program/break_detector.hpp"

#include <algorithm>
#include <sstream>

#include "knot_utm/program/load_control.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

std::string BreakDetector::judge(const Sample& sample) {
  if (!detection_.fraction_of_peak) return {};
  // Within a command nobody knows whether its largest or its least load came first: the larger of two falls counts,
  // from what came before to the least load, and from the largest of both to the load at the end.
  double from = peak_, to = sample.lowest_load;
  peak_ = std::max(peak_, sample.highest_load);
  if (peak_ - balanced_load(sample) > from - to) {
    from = peak_;
    to = balanced_load(sample);
  }
  if (peak_ <= 0.0 || peak_ < detection_.arming_load) return {};
  if (!(from > to) || to > *detection_.fraction_of_peak * from) return {};
  std::ostringstream out;
  out << "the load fell from " << from << " to " << to << " N";
  return out.str();
}

}  // namespace knot_utm
