#include "knot_utm/analysis/motion_pattern.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"
#include "pull_integrals.hpp"

namespace knot_utm {
namespace {

constexpr double kWindow = 0.03;            // of the first knot distance
constexpr double kTurnover = 0.5;           // de/ds between sliding and stretching, over that of rigid sliding
constexpr double kLeastSliding = 0.15;      // of all extension
constexpr double kMuchSliding = 1.0 / 3.0;  // of all extension: knots that slid so far slide, whatever the load does
constexpr double kLoadLevel = 2.0;          // load at the end of a slide over its mean, at most
constexpr double kGone = 0.05;              // load over the largest one below which a knot is lost
constexpr double kVanished = 0.25;          // excess length over the tied one below which a knot is lost
constexpr double kOpened = 0.05;            // approach over e from which a knot opened as the loop was mounted

/// Least-squares line y(s) through the samples from `begin` to `end`, each weighted by the extension it stands for.
struct Line {
  double mean_s = 0.0, mean = 0.0, slope = 0.0;
  double deviation = 0.0;    ///< standard deviation from the line
  double correlation = 0.0;  ///< of y with s
  double width = 0.0;        ///< of s
};

template <typename Value>
Line fit(const Pull& pull, std::size_t begin, std::size_t end, Value value) {
  Line line;
  double weights = 0.0;
  const auto weight = [&](std::size_t i) {
    const double from = pull[i > begin ? i - 1 : i].extension;
    const double to = pull[i + 1 < end ? i + 1 : i].extension;
    return 0.5 * (to - from);
  };
  for (std::size_t i = begin; i < end; ++i) {
    weights += weight(i);
    line.mean_s += weight(i) * pull[i].extension;
    line.mean += weight(i) * value(pull[i]);
  }
  if (!(weights > 0.0)) return line;
  line.mean_s /= weights;
  line.mean /= weights;
  double ss = 0.0, sy = 0.0, yy = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const double s = pull[i].extension - line.mean_s;
    const double y = value(pull[i]) - line.mean;
    ss += weight(i) * s * s;
    sy += weight(i) * s * y;
    yy += weight(i) * y * y;
  }
  line.width = pull[end - 1].extension - pull[begin].extension;
  if (ss > 0.0) {
    line.slope = sy / ss;
    line.deviation = std::sqrt(std::max(0.0, (yy - sy * line.slope) / weights));
    if (yy > 0.0) line.correlation = sy / std::sqrt(ss * yy);
  }
  return line;
}

double unit(double x) { return std::isfinite(x) ? std::clamp(x, 0.0, 1.0) : 0.0; }

/// Whether no rope with a free end touches another rope any more.
bool came_apart(const Sample& sample) {
  const PerKnot& tails = sample.tail_length;
  return tails.size() > 0 && std::none_of(tails.begin(), tails.end(), [](double tail) { return std::isfinite(tail); });
}

}  // namespace

const char* motion_pattern_name(MotionPattern pattern) {
  constexpr const char* kNames[] = {"none", "sliding", "stretching", "untangling"};
  return kNames[static_cast<std::size_t>(pattern)];
}

MotionPatternTracker::MotionPatternTracker(bool on_rollers, double hung, double marks)
    : on_rollers_(on_rollers), turnover_(kTurnover * rigid_sliding(on_rollers)), hung_(hung), marks_(marks) {}

void MotionPatternTracker::add(const Sample& sample) {
  if (sample.knot_type == KnotType::kKept && !came_apart(sample))
    type_lost_.reset();
  else if (!type_lost_)
    type_lost_ = sample.time;
  crossed_ |= sample.knot_type == KnotType::kCrossed;
  // The sample that reports a break is the last one that counts.
  if (broken_) return;
  if (sample.status == BenchStatus::kBroken) broken_ = true;
  if (sample.status == BenchStatus::kFailed) return;
  if (sample.phase == Phase::kPull || sample.phase == Phase::kHold) borne_ = sample.force_upper;
  if (pulls(sample.phase))
    add_pulled(sample);
  else if (pull_.empty() && forms(sample.phase))
    add_tied(sample);
  else if (pull_.empty() && std::isfinite(tied_distance_) && std::isfinite(sample.force_upper))
    mounted_ = std::max(mounted_, sample.force_upper);
}

/// The excess length counts at the end of tying; a release may let the knot open.
void MotionPatternTracker::add_tied(const Sample& sample) {
  tied_distance_ = sample.knot_distance;
  for (std::size_t k = 0; k < sample.excess_length.size(); ++k) {
    const double excess = sample.excess_length[k];
    double& tied = excess_[k].tied;
    if (std::isfinite(excess) && (sample.phase == Phase::kTie || !std::isfinite(tied))) tied = excess;
  }
}

void MotionPatternTracker::add_pulled(const Sample& sample) {
  if (!std::isfinite(sample.extension) || !std::isfinite(sample.force_upper)) return;
  for (std::size_t k = 0; k < sample.excess_length.size(); ++k) {
    const double excess = sample.excess_length[k];
    if (!std::isfinite(excess)) continue;
    Excess& knot = excess_[k];
    if (!std::isfinite(knot.tied)) knot.tied = excess;
    knot.last = excess;
  }
  if (!pull_.empty() && sample.extension <= pull_.back().extension) return;
  const double before = pull_.empty() ? sample.extension : pull_.back().extension;
  pull_.push_back({sample.time, sample.extension, sample.knot_distance, sample.force_upper, sample.normal_force});
  hidden_.push_back(sample.excess_length);
  if (pull_.size() == 1) {
    window_ = kWindow * sample.knot_distance;
    slope_ = Sample::kNone;
  }

  peak_ = std::max(peak_, sample.force_upper);
  follow_slope(sample.extension, before);
  follow_jumps();
}

/// Looks for a jump among the last points. It counts once the pull has gone on so far behind it that the knot has kept
/// the rod which it took in.
void MotionPatternTracker::follow_jumps() {
  constexpr double kWhole = 3.0;   // length that is searched, over that of a jump: before, in and behind it
  constexpr double kOften = 0.25;  // extension between two searches, over that of a jump: saves time in short steps
  const double interval = jump_interval(pull_), here = pull_.back().extension;
  if (jumped_ || !(interval > 0.0) || here - jump_looked_for_ < kOften * interval) return;
  jump_looked_for_ = here;
  while (here - pull_[jump_begin_].extension > kWhole * interval) ++jump_begin_;
  const std::optional<Drop> found = jump(pull_, on_rollers_, hidden_, jump_begin_);
  jumped_ = found && here - pull_[found->to].extension > interval;
}

/// Follows de/ds over the last window, and how far and where the knots slid.
void MotionPatternTracker::follow_slope(double extension, double before) {
  if (!(window_ > 0.0) || extension - pull_.front().extension < window_) return;
  while (window_begin_ + 3 < pull_.size() && extension - pull_[window_begin_ + 1].extension >= window_) ++window_begin_;
  const Line line = fit(pull_, window_begin_, pull_.size(), [](const PullPoint& p) { return p.knot_distance; });
  const double slope_before = slope_;
  const double centre_before = centre_;
  const bool first = !std::isfinite(slope_before);
  slope_ = line.slope;
  centre_ = line.mean_s;
  const double passed = first ? extension - pull_.front().extension : extension - before;
  if (slope_ < turnover_) {
    if (slid_ == 0.0) first_sliding_ = first ? pull_.front().extension : centre_;
    slid_ += passed;
    last_sliding_ = centre_;
  } else if (!first && slope_before < turnover_) {
    const double t = (turnover_ - slope_before) / (slope_ - slope_before);
    last_sliding_ = centre_before + t * (centre_ - centre_before);
  }
}

/// A single knot in a line may have been tightened so far.
bool MotionPatternTracker::vanished() const {
  return std::isfinite(pull_.front().knot_distance) &&
         std::any_of(excess_.begin(), excess_.end(),
                     [](const Excess& knot) { return knot.last < kVanished * knot.tied; });
}

bool MotionPatternTracker::knot_lost() const {
  return type_lost_ && (crossed_ || pull_.empty() || borne_ - hung_ < kGone * (peak_ - hung_) || vanished());
}

std::optional<double> MotionPatternTracker::opened_when_mounted() const {
  if (pull_.empty()) return {};
  const double put_on = marks_ > 0.0 ? marks_ : tied_distance_, nearer = put_on - pull_.front().knot_distance;
  return nearer > kOpened * put_on ? std::optional<double>(nearer) : std::nullopt;
}

bool MotionPatternTracker::untangles() const {
  return knot_lost() || jumped_ || (opened_when_mounted() && !slides_under_more());
}

/// Whether knots that moved as the loop was mounted slide in the pull, and bear more than during mounting.
bool MotionPatternTracker::slides_under_more() const { return std::isfinite(slope_) && peak_ > mounted_ && slid(); }

bool MotionPatternTracker::slid() const {
  const PullPoint &start = pull_.front(), &first = point_at(first_sliding_), &last = point_at(last_sliding_);
  const auto came_nearer = [&](const PullPoint& from) {
    return last.knot_distance - from.knot_distance < turnover_ * (last.extension - from.extension);
  };
  const double whole = pull_.back().extension - start.extension;
  if (slid_ < window_ || slid_ < kLeastSliding * whole) return false;
  if (slid_ > kMuchSliding * whole) return true;
  return came_nearer(start) || (came_nearer(first) && last.force < kLoadLevel * mean_between(first, last));
}

/// The first point from s = `extension` on, or the last point.
const PullPoint& MotionPatternTracker::point_at(double extension) const {
  return *first_from(pull_.begin(), pull_.end() - 1, extension);
}

/// The mean load between two points of the pull [N].
double MotionPatternTracker::mean_between(const PullPoint& first, const PullPoint& last) const {
  const Integrals part = integrate(pull_, {first.extension, last.extension});
  return part.width > 0.0 ? part.force / part.width : first.force;
}

MotionPattern MotionPatternTracker::pattern() const {
  if (untangles()) return MotionPattern::kUntangling;
  if (pull_.empty() || !std::isfinite(slope_)) return MotionPattern::kNone;
  return slid() ? MotionPattern::kSliding : MotionPattern::kStretching;
}

std::optional<double> MotionPatternTracker::lock_extension() const {
  if (pattern() != MotionPattern::kSliding || slope_ < turnover_ || centre_ - last_sliding_ < window_) return {};
  return last_sliding_;
}

std::optional<double> MotionPatternTracker::untangled_at() const { return knot_lost() ? type_lost_ : std::nullopt; }

double MotionPatternTracker::confidence() const {
  const MotionPattern found = pattern();
  if (found == MotionPattern::kNone) return 0.0;
  if (found == MotionPattern::kUntangling) return knot_lost() ? 1.0 : 0.75;
  const bool sliding = found == MotionPattern::kSliding;
  const Range whole = {pull_.front().extension, pull_.back().extension};
  const Range part = sliding ? plateau_range(pull_, lock_extension().value_or(whole.high)) : whole;
  const auto place = [&](double s) {
    return static_cast<std::size_t>(first_from(pull_.begin(), pull_.end(), s) - pull_.begin());
  };
  const std::size_t first = place(part.low);
  const std::size_t last = std::min(place(part.high) + 1, pull_.size());
  if (last < first + 3) return 0.0;

  const auto force_sign = [&](const Line& line) {
    if (!sliding) return unit(line.correlation);
    return unit(1.0 - (std::max(0.0, line.slope) * line.width + line.deviation) / line.mean);
  };
  const double rate = fit(pull_, first, last, [](const PullPoint& p) { return p.knot_distance; }).slope;
  double signs = sliding ? unit(1.0 - std::abs(rate / turnover_ - 2.0)) : unit(1.0 - rate / turnover_);
  signs += force_sign(fit(pull_, first, last, [](const PullPoint& p) { return p.force; }));
  const Line contact = fit(pull_, first, last, [](const PullPoint& p) { return p.normal_force; });
  if (!(contact.mean > 0.0)) return signs / 2.0;
  return (signs + force_sign(contact)) / 3.0;
}

}  // namespace knot_utm
