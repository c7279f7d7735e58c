#include "knot_utm/machine/break_detector.hpp"

#include <algorithm>
#include <sstream>

namespace knot_utm {

namespace {

/// The larger one of two falls: from what came before a command to its least load, and from the largest of both to the
/// load that it ends with. Within a command nobody knows which of the two extremes came first.
struct Fall {
  double from, to;

  Fall(double before, const Sample& sample) : from(before), to(sample.lowest_load) {
    const double highest = std::max(before, sample.highest_load), end = sample.force_upper - sample.balance_offset;
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

void BreakDetector::begin() {
  peak_ = 0.0;
  seen_.clear();
}

template <class Counts>
double BreakDetector::largest(Counts counts) const {
  double load = 0.0;
  for (const Seen& seen : seen_)
    if (counts(seen)) load = std::max(load, seen.load);
  return load;
}

void BreakDetector::forget_what_is_past(const Sample& sample) {
  const auto past = [&](const Seen& seen) {
    return sample.time - seen.time > detection_.sharp_drop_time &&
           sample.extension - seen.extension > detection_.drop_extension;
  };
  seen_.erase(seen_.begin(), std::find_if_not(seen_.begin(), seen_.end(), past));
}

std::string BreakDetector::judge(const Sample& sample) {
  if (!detection_.on()) return {};
  const auto at_once = [&](const Seen& seen) { return sample.time - seen.time <= detection_.sharp_drop_time; };
  const auto nearby = [&](const Seen& seen) { return sample.extension - seen.extension <= detection_.drop_extension; };
  const Fall from_peak(peak_, sample), sharp(largest(at_once), sample), short_way(largest(nearby), sample);
  peak_ = std::max(peak_, sample.highest_load);
  seen_.push_back({sample.time, sample.extension, sample.highest_load});
  forget_what_is_past(sample);
  if (peak_ <= 0.0 || peak_ < detection_.arming_load) return {};
  if (detection_.fraction_of_peak && from_peak.size() > 0.0 &&
      from_peak.to <= *detection_.fraction_of_peak * from_peak.from)
    return from_peak.text();
  if (detection_.sharp_drop && sharp.size() >= *detection_.sharp_drop * peak_) return sharp.text() + " at once";
  if (detection_.drop && short_way.size() >= *detection_.drop * peak_) return short_way.text() + " over a short way";
  return {};
}

void BreakDetector::state(Archive& archive) {
  archive(peak_);
  archive.list(seen_);
}

}  // namespace knot_utm
