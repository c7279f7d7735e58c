#include "knot_utm/machine/break_detector.hpp"

#include <algorithm>
#include <sstream>

#include "knot_utm/machine/load_control.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

namespace {

/// The larger one of two falls: from what came before a command to its least load, and from the largest of both to the
/// load that it ends with. Within a command nobody knows which of the two extremes came first.
struct Fall {
  double from, to;

  Fall(double before, const Sample& sample) : from(before), to(sample.lowest_load) {
    const double highest = std::max(before, sample.highest_load), end = balanced_load(sample);
    if (highest - end > from - to) {
      from = highest;
      to = end;
    }
  }

  double size() const { return from - to; }

  std::string text() const {
    std::ostringstream out;
    out << "the load fell from " << from << " to " << to << " N";
    return out.str();
  }
};

}  // namespace

double BreakDetector::Window::largest(double now, double width) const {
  for (const Seen& seen : seen_)
    if (now - seen.at <= width) return seen.load;
  return 0.0;
}

void BreakDetector::Window::add(double now, double width, double load) {
  while (!seen_.empty() && seen_.back().load <= load) seen_.pop_back();
  seen_.push_back({now, load});
  const auto inside = [&](const Seen& seen) { return now - seen.at <= width; };
  seen_.erase(seen_.begin(), std::find_if(seen_.begin(), seen_.end(), inside));
}

void BreakDetector::begin() {
  peak_ = 0.0;
  in_time_.clear();
  in_extension_.clear();
}

std::string BreakDetector::judge(const Sample& sample) {
  if (!detection_.on()) return {};
  const double time = sample.time, extension = sample.extension, highest = sample.highest_load;
  const Fall from_peak(peak_, sample);
  peak_ = std::max(peak_, highest);
  std::string found;
  const auto falls_within = [&](Window& window, double now, double width, double fraction, const char* how) {
    const Fall fall(window.largest(now, width), sample);
    window.add(now, width, highest);
    if (found.empty() && fall.size() >= fraction * peak_) found = fall.text() + how;
  };
  if (detection_.sharp_drop)
    falls_within(in_time_, time, detection_.sharp_drop_time, *detection_.sharp_drop, " at once");
  if (detection_.drop)
    falls_within(in_extension_, extension, detection_.drop_extension, *detection_.drop, " over a short distance");
  if (peak_ <= 0.0 || peak_ < detection_.arming_load) return {};
  if (detection_.fraction_of_peak && from_peak.size() > 0.0 &&
      from_peak.to <= *detection_.fraction_of_peak * from_peak.from)
    return from_peak.text();
  return found;
}

void BreakDetector::state(Archive& archive) { archive(peak_, in_time_, in_extension_); }

}  // namespace knot_utm
