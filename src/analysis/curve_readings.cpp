#include "knot_utm/analysis/curve_readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <tuple>

#include "knot_utm/record/sample.hpp"
#include "pull_integrals.hpp"

namespace knot_utm {
namespace {

constexpr double kPlateauBegin = 0.3, kPlateauEnd = 0.8;  // of the way to the lock
constexpr double kLockedLoad = 2.0;                       // load of a lock over the mean of its plateau
constexpr double kEarliestLock = 0.15;                    // of the pull
constexpr std::ptrdiff_t kFewestReadings = 3;             // of the load within a plateau
constexpr double kRises = 1.0 / 3.0, kFalls = 0.5;        // change over the mean from which a force is not level
constexpr double kOffSliding = 0.5;                       // of de/ds from rigid sliding on rollers
constexpr double kSudden = 0.05;                          // of the way to the lock
// A jump takes in rod over the first excess length and lets F fall; without excess lengths, the knots come nearer by a
// part of the first e, and this part of F is left.
constexpr double kTakenIn = 0.125, kFallen = 0.1, kLetOut = 0.05, kLetGo = 0.5;
constexpr int kFewestForDrops = 20;  // readings on the way to the lock

/// Least-squares slopes over three parts of equal length.
std::array<double, 3> slopes_of_thirds(const Pull& pull, const Range& range) {
  std::array<double, 3> slope;
  for (std::size_t k = 0; k < 3; ++k) {
    const double part = (range.high - range.low) / 3.0, from = range.low + static_cast<double>(k) * part;
    slope[k] = slope_over(pull, {from, from + part});
  }
  return slope;
}

/// Smallest and largest F, which is linear from point to point.
std::pair<double, double> extremes(const Pull& pull, const Range& range) {
  const auto force_at = [&](double s) {
    const auto after = first_from(pull.begin() + 1, pull.end() - 1, s);
    const PullPoint &a = *(after - 1), &b = *after;
    return a.force + (s - a.extension) / (b.extension - a.extension) * (b.force - a.force);
  };
  const double begin = force_at(range.low), end = force_at(range.high);
  double low = std::min(begin, end), high = std::max(begin, end);
  for (const PullPoint& point : pull)
    if (point.extension >= range.low && point.extension <= range.high) {
      low = std::min(low, point.force);
      high = std::max(high, point.force);
    }
  return {low, high};
}

/// The last point within `interval` of point i, at least the next one, as far as s = `end`.
std::size_t last_within(const Pull& pull, std::size_t i, double interval, double end) {
  std::size_t last = i;
  while (last + 1 < pull.size() && pull[last + 1].extension <= end &&
         (last == i || pull[last + 1].extension - pull[i].extension <= interval))
    ++last;
  return last;
}

double sudden(const Pull& pull, double end) { return kSudden * (end - pull.front().extension); }

/// The largest fall of F between two points of a range that are no further apart than `interval`. As a record may have
/// a million readings, `low` holds only the points ahead that can still become the lowest one, in order, with rising F.
std::optional<Drop> largest_drop(const Pull& pull, const Range& range, double interval) {
  std::optional<Drop> out;
  std::deque<std::size_t> low;
  std::size_t seen = 0;  // up to there points have been put into `low`
  for (std::size_t i = 0; i < pull.size() && pull[i].extension <= range.high; ++i) {
    if (pull[i].extension < range.low) continue;
    const auto within = [&](std::size_t j) {
      return j < pull.size() && pull[j].extension <= range.high &&
             (j == i + 1 || pull[j].extension - pull[i].extension <= interval);
    };
    for (seen = std::max(seen, i); within(seen + 1);) {
      ++seen;
      while (!low.empty() && pull[low.back()].force > pull[seen].force) low.pop_back();
      low.push_back(seen);
    }
    while (!low.empty() && low.front() <= i) low.pop_front();
    if (low.empty()) continue;
    const Drop fall{i, low.front()};
    // Among equal falls the last one begins where F begins to fall.
    if (fall.force(pull) > 0.0 && (!out || fall.force(pull) >= out->force(pull))) out = fall;
  }
  return out;
}

/// The least excess length of each knot from each point on over `interval`. A knot that opens keeps the rod that it
/// takes in; one that a tail whips past gives it back.
HiddenRod as_kept(const Pull& pull, const HiddenRod& hidden, double interval, std::size_t begin) {
  HiddenRod out = hidden;
  for (std::size_t i = begin; i < out.size(); ++i)
    for (std::size_t j = i, last = last_within(pull, i, interval, pull.back().extension); j <= last; ++j)
      for (std::size_t k = 0; k < out[i].size(); ++k) out[i][k] = std::min(out[i][k], hidden[j].at(k));
  return out;
}

/// Growth of the excess length from one point to another, over that at `first`: the largest of all knots. NaN: not
/// known.
double taken_in(const PerKnot& first, const PerKnot& from, const PerKnot& to) {
  double most = Sample::kNone;
  for (std::size_t k = 0; k < first.size(); ++k) most = std::fmax(most, (to.at(k) - from.at(k)) / first.at(k));
  return most;
}

/// Approach of the knots beyond that of rigid sliding (`sliding`, de/ds), over the first e; 0 if F did not fall by
/// half.
double let_out(const Pull& pull, const PullPoint& from, const PullPoint& to, double sliding) {
  if (to.force > kLetGo * from.force) return 0.0;
  return (from.knot_distance - to.knot_distance + sliding * (to.extension - from.extension)) /
         pull.front().knot_distance;
}

/// How much a knot opened from one point to another, over the least opening of a jump: by the share of rod that it has
/// `taken` in or, where that is not known, by the approach of the knots. NaN: neither is known.
double opened(const Pull& pull, const PullPoint& from, const PullPoint& to, double taken, double sliding) {
  const double known = taken / kTakenIn;
  return std::isfinite(known) ? known : let_out(pull, from, to, sliding) / kLetOut;
}

/// For every point from `begin` on: the point with the smallest F within `interval` after it.
std::vector<std::size_t> lowest_behind(const Pull& pull, double interval, std::size_t begin) {
  std::vector<std::size_t> out(pull.size());
  for (std::size_t i = begin; i < pull.size(); ++i) {
    out[i] = i;
    for (std::size_t j = i + 1, last = last_within(pull, i, interval, pull.back().extension); j <= last; ++j)
      if (pull[j].force < pull[out[i]].force) out[i] = j;
  }
  return out;
}

/// Whether the excess length of a knot varies so much from `begin` on that it may have jumped; true if it is not known.
bool may_have_jumped(const HiddenRod& hidden, std::size_t begin) {
  if (hidden.empty()) return true;
  for (std::size_t k = 0; k < hidden.front().size(); ++k) {
    const auto less = [k](const PerKnot& a, const PerKnot& b) { return a.at(k) < b.at(k); };
    const auto [least, most] =
        std::minmax_element(hidden.begin() + static_cast<std::ptrdiff_t>(begin), hidden.end(), less);
    if (!(most->at(k) - least->at(k) < kTakenIn * hidden.front().at(k))) return true;
  }
  return false;
}

std::string text(const char* format, double a, double b = 0.0) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), format, a, b);
  return line.data();
}

/// Why the motion of two knots says that F is no sliding force; empty: it may be one.
std::string why_not_sliding(double slope, bool on_rollers) {
  if (!std::isfinite(slope)) return {};
  if (!on_rollers)
    return "two nodes of the loop are held: the load is also that of the side without knots, which is stretched";
  const double sliding = rigid_sliding(on_rollers);
  if (std::abs(slope - sliding) <= kOffSliding) return {};
  return text("the knots do not slide steadily: de/ds is %.2f, where %.0f is sliding on rollers", slope, sliding);
}

/// Why the mean of F is no plateau; empty: it is.
std::string why_not_level(const Plateau& level) {
  if (level.rise < kRises * level.force && -level.rise < kFalls * level.force) return {};
  return text("the load is not level: from 0.3 to 0.8 of the way it changes by %.0f %% of its mean",
              100.0 * level.rise / level.force);
}

std::optional<double> lock_by_load(const Pull& pull) {
  const PullToPeak rise(pull);
  const double length = rise.end() - rise.start();
  const double earliest = rise.start() + kEarliestLock * (pull.back().extension - rise.start());
  // Each step goes back by a share of the way, unless F is about proportional to s and has no lock.
  constexpr int kMostSteps = 1000;
  double lock = rise.end();
  for (int step = 0; step < kMostSteps && lock > earliest; ++step) {
    const double mean = rise.mean_force(plateau_range(pull, lock));
    if (!(mean > 0.0)) return std::nullopt;
    const double next = std::min(lock, rise.last_rise_through(kLockedLoad * mean));
    if (next >= rise.end()) return std::nullopt;
    if (lock - next <= 1e-9 * length) return next;
    lock = next;
  }
  return std::nullopt;
}

}  // namespace

Range plateau_between(double start, double end) {
  return {start + kPlateauBegin * (end - start), start + kPlateauEnd * (end - start)};
}

Range plateau_range(const Pull& pull, double end) {
  const Range whole = plateau_between(pull.front().extension, end);
  return {whole.low, std::min(whole.high, pull.back().extension)};
}

double meeting_extension(const Pull& pull) { return pull.front().extension + 0.5 * pull.front().knot_distance; }

bool has_few_for_drops(const Pull& pull, double end) {
  return std::count_if(pull.begin(), pull.end(), [&](const PullPoint& p) { return p.extension <= end; }) <
         kFewestForDrops;
}

double peak_force(const Pull& pull) { return pull[peak_of(pull)].force; }

std::optional<Plateau> plateau(const Pull& pull, double end) {
  if (pull.empty()) return std::nullopt;
  const Range range = plateau_range(pull, end);
  const Integrals part = integrate(pull, range);
  if (!(part.width > 0.0)) return std::nullopt;
  Plateau out;
  out.force = part.force / part.width;
  out.force_sd = std::sqrt(std::max(0.0, part.square / part.width - out.force * out.force));
  out.slope = part.distance_change / part.width;
  out.force_slope = slope_over(pull, range);
  std::tie(out.low, out.high) = extremes(pull, range);
  const double middle = 0.5 * (range.low + range.high);
  out.rise = 2.0 * (mean_over(pull, {middle, range.high}) - mean_over(pull, {range.low, middle}));
  return out;
}

double breakaway_force(const Pull& pull, double end) {
  if (pull.empty()) return 0.0;
  const double before = plateau_range(pull, end).low;
  double out = 0.0;
  for (const PullPoint& point : pull)
    if (point.extension <= before) out = std::max(out, point.force);
  return out;
}

std::optional<Drop> largest_drop(const Pull& pull, double end) {
  if (has_few_for_drops(pull, end)) return std::nullopt;
  return largest_drop(pull, {pull.front().extension, end}, sudden(pull, end));
}

double rigid_sliding(bool on_rollers) { return on_rollers ? -2.0 : -1.0; }

double jump_interval(const Pull& pull) { return 0.5 * kSudden * pull.front().knot_distance; }

std::optional<Drop> jump(const Pull& pull, bool on_rollers, const HiddenRod& hidden, std::size_t begin) {
  if (pull.empty() || !may_have_jumped(hidden, begin)) return std::nullopt;
  const double interval = jump_interval(pull);
  if (!(interval > 0.0)) return std::nullopt;  // a single knot
  const HiddenRod kept = as_kept(pull, hidden, interval, begin);
  const std::vector<std::size_t> lowest = lowest_behind(pull, interval, begin);
  double most = 1.0;
  std::optional<Drop> out;
  for (std::size_t i = begin; i < pull.size(); ++i) {
    const std::size_t last = last_within(pull, i, interval, pull.back().extension);
    std::size_t highest = i;
    for (std::size_t j = i + 1; j <= last; ++j) {
      if (pull[j - 1].force > pull[highest].force) highest = j - 1;
      const Drop fall{highest, lowest[j]};
      if (!(pull[highest].force > 0.0) || fall.force(pull) < kFallen * pull[highest].force) continue;
      const double taken = hidden.empty() ? Sample::kNone : taken_in(hidden.front(), hidden[i], kept[j]);
      if (const double much = opened(pull, pull[i], pull[j], taken, rigid_sliding(on_rollers)); much > most) {
        most = much;
        out = fall;
      }
    }
  }
  if (!out) return out;
  for (std::size_t k = out->from; k < out->to; ++k)
    if (pull[k].force > pull[out->from].force) out->from = k;
  return out;
}

std::optional<LockedPart> locked_part(const Pull& pull, double from) {
  if (pull.empty()) return std::nullopt;
  const double peak = peak_force(pull);
  const std::size_t end = peak_of(pull) + 1;
  std::size_t begin = end;
  while (begin > 0 && pull[begin - 1].extension >= from && (pull[begin - 1].force >= 0.5 * peak || end - begin < 3))
    --begin;
  if (end < begin + 3) return std::nullopt;
  const Range range{pull[begin].extension, pull[end - 1].extension};
  std::array<double, 3> slope = slopes_of_thirds(pull, range);
  const double change = 1.5 * (slope[2] - slope[0]);  // the middles of the outer thirds are 2/3 of the part apart
  std::sort(slope.begin(), slope.end());
  return LockedPart{slope[1], change, range.high - range.low, static_cast<int>(end - begin)};
}

namespace {

/// Why a sudden fall divides the plateau into two levels; empty: there is none so large.
std::string why_interrupted(const Pull& pull, double end, double mean) {
  const std::optional<Drop> fall = largest_drop(pull, plateau_range(pull, end), sudden(pull, end));
  if (!fall || fall->force(pull) < kFalls * mean) return {};
  return text("the load is not level: it falls at once by %.0f %% of its mean", 100.0 * fall->force(pull) / mean);
}

/// Why there are too few readings for a mean; empty: there are enough.
std::string why_too_few(const Pull& pull, double end) {
  const std::ptrdiff_t within = count_within(pull, plateau_range(pull, end));
  if (within >= kFewestReadings) return {};
  return text("the load was read %.0f times from 0.3 to 0.8 of the way, where a mean takes at least %.0f",
              static_cast<double>(within), static_cast<double>(kFewestReadings));
}

/// Why the force that the rod bears has no plateau; empty: it has one.
std::string why_no_plateau(const Pull& borne, bool on_rollers, const CurveReadings& found) {
  if (!(peak_force(borne) > 0.0)) return "the specimen was never in tension";
  const std::optional<Plateau> level = plateau(borne, found.slides_to);
  if (!level) return "the pull has too few readings";
  if (std::string few = why_too_few(borne, found.slides_to); !few.empty()) return few;
  if (found.jumped) return "a knot jumped open";
  if (!(level->force > 0.0))
    return text("the rod is not pulled: from 0.3 to 0.8 of the way the mean of the load is %.2g N", level->force);
  if (std::string falls = why_interrupted(borne, found.slides_to, level->force); !falls.empty()) return falls;
  if (std::string held = why_not_sliding(level->slope, on_rollers); !held.empty()) return held;
  return why_not_level(*level);
}

/// Why the knots do not lock; empty: they lock where the force rises for good.
std::string why_no_lock(const Pull& borne, const CurveReadings& found) {
  if (found.jumped) return "a knot jumped open";
  if (!found.no_plateau.empty()) return "there is no plateau";
  if (!found.rises_at) return "the load does not stay above twice the mean of its plateau";
  const auto after = first_from(borne.begin() + 1, borne.end() - 1, *found.rises_at);
  const double slid = *found.rises_at - borne.front().extension;
  const double apart = (after->extension - (after - 1)->extension) / slid;
  if (apart <= kSudden) return {};
  return text("the readings around it are %.2g of the way apart, where %.2g is close enough", apart, kSudden);
}

void read_plateau(const Pull& pull, CurveReadings& out) {
  const double end = out.slides_to;
  const std::optional<Plateau> level = plateau(pull, end);
  out.plateau_force = level->force;
  out.plateau_force_sd = level->force_sd;
  out.plateau_force_low = level->low;
  out.plateau_force_high = level->high;
  out.plateau_force_slope = level->force_slope;
  out.breakaway_force = breakaway_force(pull, end);
}

}  // namespace

Pull borne_of(Pull pull) {
  for (PullPoint& point : pull)
    if (std::isfinite(point.borne)) point.force = point.borne;
  return pull;
}

CurveReadings curve_readings(const Pull& pull, bool on_rollers, const HiddenRod& hidden, const KnotsOfPull& knots) {
  CurveReadings out;
  out.no_lock_by_load = "nothing was pulled";
  out.no_plateau = knots.lost.empty() ? out.no_lock_by_load : knots.lost;
  if (pull.empty()) return out;
  const Pull borne = borne_of(pull);
  out.rises_at = lock_by_load(borne);
  out.slides_to = out.rises_at.value_or(knots.ended_in_plateau ? meeting_extension(pull) : pull.back().extension);
  out.jumped = jump(borne, on_rollers, hidden);
  if (const double peak = peak_force(pull); peak > 0.0) out.peak_force = peak;
  const std::optional<Drop> fall = largest_drop(borne, out.slides_to);
  if (!has_few_for_drops(borne, out.slides_to)) out.largest_drop = fall ? fall->force(borne) : 0.0;
  if (fall) out.largest_drop_at = pull[fall->from].extension;
  if (out.jumped) {
    out.jump_force = pull[out.jumped->from].force;
    out.jump_extension = pull[out.jumped->from].extension;
    out.force_after_jump = pull[out.jumped->to].force;
  }
  out.no_plateau = why_no_plateau(borne, on_rollers, out);
  out.no_lock_by_load = knots.ended_in_plateau ? kEndedInPlateau : why_no_lock(borne, out);
  const bool level = out.no_plateau.empty();
  if (!knots.lost.empty())
    out.no_plateau = knots.lost;
  else if (level)
    out.no_plateau = knots.not_sliding;
  if (out.no_plateau.empty())
    read_plateau(pull, out);
  else if (out.no_lock_by_load.empty())
    out.no_lock_by_load = "there is no plateau";
  if (out.no_lock_by_load.empty()) out.lock_extension_by_load = out.rises_at;
  if (!out.jumped && (out.rises_at || !level))
    out.locked = locked_part(pull, out.rises_at.value_or(pull.front().extension));
  const bool holds = !knots.untangled && (!knots.slid_to_end || out.rises_at);
  if (out.locked && holds) out.locked_stiffness = out.locked->stiffness;
  return out;
}

}  // namespace knot_utm
