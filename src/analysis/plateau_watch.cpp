#include "knot_utm/analysis/plateau_watch.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/analysis/results.hpp"
#include "knot_utm/analysis/statistics.hpp"
#include "knot_utm/program/phases.hpp"
#include "pull_integrals.hpp"

namespace knot_utm {
namespace {

// doc/developers/measured.md says where these come from.
constexpr int kBatches = 5;
constexpr std::ptrdiff_t kFewestInPart = 2;  // readings in a part of the plateau, on average
constexpr double kLeastSlid = 8.0;           // least way along the plateau [h] ...
constexpr double kLeastShare = 0.5;          // ... and least share of it
constexpr double kOfError = 0.5;             // of the relative error of a plateau force
constexpr double kMostDoubt = 0.02;          // of the mean force
constexpr double kOften = 0.25;              // extension between two looks [h]

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The whole plateau of a pull whose knots slide until they meet.
Range whole_plateau(const Pull& pull) { return plateau_between(pull.front().extension, meeting_extension(pull)); }

/// The part of it that was pulled.
Range plateau_read(const Pull& pull) { return plateau_range(pull, meeting_extension(pull)); }

std::vector<double> means_of_parts(const Pull& pull, const Range& read) {
  std::vector<double> means;
  const double width = (read.high - read.low) / kBatches;
  for (int k = 0; k < kBatches; ++k)
    means.push_back(mean_over(pull, {read.low + k * width, read.low + (k + 1) * width}));
  return means;
}

/// Whether a test that ends here has the plateau of knots that slide and have not begun to lock.
bool has_plateau(const Results& results) {
  return results.curve.plateau_force && results.motion_pattern == MotionPattern::kSliding &&
         !results.first_contact_extension && !results.lock_extension && !results.curve.rises_at;
}

}  // namespace

double doubt_about_plateau(const Pull& pull) {
  if (pull.empty()) return kInfinity;
  const Range read = plateau_read(pull), whole = whole_plateau(pull);
  if (!(read.high > read.low) || count_within(pull, read) < kBatches * kFewestInPart) return kInfinity;
  const double left = whole.high - read.high;
  const Statistics parts = statistics_of(means_of_parts(pull, read));
  const double of_mean = parts.high ? 0.5 * (*parts.high - *parts.low) : 0.0, share = left / (whole.high - whole.low);
  const double by_trend = 0.5 * std::abs(slope_over(pull, read)) * left,
               by_last = std::abs(pull.back().force - *parts.mean) * share;
  return of_mean * std::sqrt(share) + std::max(by_trend, by_last);
}

PlateauWatch::PlateauWatch(double radius, std::optional<double> error)
    : radius_(radius), tolerance_(std::min(kMostDoubt, kOfError * error.value_or(1.0))) {}

bool PlateauWatch::settled_by(const Sample& reading) {
  readings_.push_back(reading);
  if (!samples_.empty() && samples_.back().time == reading.time) samples_.back() = reading;
  const bool pulled = pulls(reading.phase) && reading.status == BenchStatus::kRunning;
  if (!pulled || !(reading.extension >= next_look_)) return false;
  std::vector<CurveRow> rows;
  for (const Sample& one : readings_) rows.push_back(curve_row(one));
  const Pull pull = pull_of(rows);
  next_look_ = next_look_after(pull);
  return looks_settled(pull) && has_plateau(analyse(samples_, readings_, EndedBy::kPlateau, true));
}

/// The extension up to which the knots are to slide at least [m].
double PlateauWatch::least_extension(const Pull& pull) const {
  const Range whole = whole_plateau(pull);
  const double length = whole.high - whole.low;
  return whole.low + std::min(length, std::max(kLeastSlid * radius_, kLeastShare * length));
}

/// The extension at which the knots have slid far enough; a little further on if they have; infinite once the whole
/// plateau was read.
double PlateauWatch::next_look_after(const Pull& pull) const {
  const double here = pull.back().extension, least = least_extension(pull);
  return here < least ? least : here < whole_plateau(pull).high ? here + kOften * radius_ : kInfinity;
}

bool PlateauWatch::looks_settled(const Pull& pull) const {
  if (pull.back().extension < least_extension(pull)) return false;
  const std::optional<Plateau> level = plateau(borne_of(pull), meeting_extension(pull));
  return level && doubt_about_plateau(pull) <= tolerance_ * level->force;
}

}  // namespace knot_utm
