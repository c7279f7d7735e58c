#include "knot_utm/analysis/pull_readings.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/record/sample.hpp"
#include "pull_integrals.hpp"

namespace knot_utm {
namespace {

constexpr double kChordBegin = 0.1, kChordEnd = 0.5;  // of the peak
constexpr double kSteady = 0.02;        // largest relative difference of the last two quarters of a steady force
constexpr double kTangentWindow = 0.1;  // of the way to the peak

}  // namespace

double energy(const Pull& pull) {
  return pull.empty() ? 0.0 : integrate(pull, {pull.front().extension, pull.back().extension}).force;
}

double energy_to_peak(const Pull& pull) { return pull.empty() ? 0.0 : PullToPeak(pull).work(); }

std::optional<double> peak_extension(const Pull& pull) {
  if (pull.empty()) return std::nullopt;
  return pull[peak_of(pull)].extension;
}

std::optional<double> steady_force(const Pull& pull) {
  if (pull.empty()) return std::nullopt;
  const double begin = pull.front().extension, end = pull.back().extension;
  const double middle = 0.5 * (begin + end), three_quarters = 0.5 * (middle + end);
  const Integrals third = integrate(pull, {middle, three_quarters}), fourth = integrate(pull, {three_quarters, end});
  if (!(third.width > 0.0 && fourth.width > 0.0)) return std::nullopt;
  const double before = third.force / third.width, after = fourth.force / fourth.width;
  if (!(std::abs(after - before) <= kSteady * std::abs(before))) return std::nullopt;
  return 0.5 * (before + after);
}

std::optional<double> chord_stiffness(const Pull& pull) {
  if (pull.empty()) return std::nullopt;
  const PullToPeak part(pull);
  const double begin = kChordBegin * peak_force(pull), end = kChordEnd * peak_force(pull);
  const double length = part.last_rise_through(end) - part.last_rise_through(begin);
  if (!(length > 0.0) || !part.is_below(begin)) return std::nullopt;
  return (end - begin) / length;
}

std::optional<double> secant_stiffness(const Pull& pull) {
  const std::size_t peak = peak_of(pull);
  if (pull.empty() || peak == 0) return std::nullopt;
  return (pull[peak].force - pull[0].force) / (pull[peak].extension - pull[0].extension);
}

std::optional<double> tangent_stiffness(const Pull& pull) {
  const std::size_t peak = peak_of(pull);
  if (pull.empty() || peak == 0) return std::nullopt;
  const double end = pull[peak].extension, window = kTangentWindow * (end - pull[0].extension);
  const PullToPeak part(pull);
  double steepest = part.slope({end - window, end});
  for (std::size_t i = 0; pull[i].extension + window < end; ++i)
    steepest = std::max(steepest, part.slope({pull[i].extension, pull[i].extension + window}));
  return steepest;
}

namespace {

constexpr double kClosed = 0.1;  // of the cycle's range

double range_of(const Path& path, std::size_t begin, std::size_t end, double PathPoint::*of) {
  double low = path[begin].*of, high = low;
  for (std::size_t i = begin; i <= end; ++i) {
    low = std::min(low, path[i].*of);
    high = std::max(high, path[i].*of);
  }
  return high - low;
}

/// Turning points of the crosshead, with the beginning and the end of the path.
std::vector<std::size_t> turning_points(const Path& path) {
  std::vector<std::size_t> turns;
  double before = 0.0;  // sense of the last motion of the crosshead
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double moved = path[i].crosshead - path[i - 1].crosshead;
    if (moved == 0.0) continue;  // the crosshead may stand still before it turns
    if (turns.empty()) turns.push_back(0);
    if (moved * before < 0.0) turns.push_back(i - 1);
    before = moved > 0.0 ? 1.0 : -1.0;
  }
  if (!turns.empty()) turns.push_back(path.size() - 1);
  return turns;
}

bool comes_back(const Path& path, std::size_t begin, std::size_t end, double PathPoint::*of) {
  return std::abs(path[end].*of - path[begin].*of) <= kClosed * range_of(path, begin, end, of);
}

double enclosed(const Path& path, std::size_t begin, std::size_t end) {
  const auto under = [&](std::size_t from, std::size_t to) {
    return 0.5 * (path[from].force + path[to].force) * (path[to].extension - path[from].extension);
  };
  double area = under(end, begin);
  for (std::size_t i = begin; i < end; ++i) area += under(i, i + 1);
  return area;
}

/// Samples of a step of the program: the first one, and the one after the last.
struct Stretch {
  std::size_t begin, end;
};

/// The steps with this phase that have a sample before them, in order, up to a break.
std::vector<Stretch> stretches(const std::vector<Sample>& samples, Phase phase, const std::vector<int>& steps) {
  std::vector<Stretch> out;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i - 1].status == BenchStatus::kBroken) break;
    if (samples[i].phase != phase) continue;
    const bool begins = !steps.empty() && steps[i] != steps[i - 1];
    if (out.empty() || out.back().end != i || begins) out.push_back({i, i});
    out.back().end = i + 1;
  }
  return out;
}

/// The relaxation in the last hold in which the crosshead stood still further out than at the start, under load. It
/// moves where a load is held; and a sketched shape that settles bears no load.
std::optional<Relaxation> last_relaxation(const std::vector<Sample>& samples, const std::vector<int>& steps) {
  std::optional<Relaxation> last;
  for (const Stretch& hold : stretches(samples, Phase::kHold, steps)) {
    const Sample &before = samples[hold.begin - 1], &end = samples[hold.end - 1];
    bool stands = true;
    for (std::size_t i = hold.begin; i < hold.end; ++i) stands &= samples[i].displacement == before.displacement;
    if (stands && before.displacement > samples.front().displacement && before.force_upper > 0.0)
      last = Relaxation{before.force_upper, end.force_upper};
  }
  return last;
}

/// The cycles of the last step that cycles. Their indices count from the sample before that step.
struct LastCycles {
  std::size_t origin = 0;
  std::vector<Cycle> closed;
};

LastCycles last_cycles(const std::vector<Sample>& samples, const std::vector<int>& steps) {
  const std::vector<Stretch> cycling = stretches(samples, Phase::kCycle, steps);
  if (cycling.empty()) return {};
  const Stretch& step = cycling.back();
  const Sample origin = origin_at(samples[step.begin], samples[step.begin - 1]);
  const auto point = [](const Sample& at) { return PathPoint{at.extension, at.force_upper, at.displacement}; };
  Path path = {point(origin)};
  for (std::size_t i = step.begin; i < step.end; ++i) path.push_back(point(samples[i]));
  return {step.begin - 1, closed_cycles(path)};
}

Elongations elongations_of(const std::vector<Sample>& samples, const LastCycles& cycles, double gauge_length) {
  const Cycle& last = cycles.closed.back();
  const auto at = [&](std::size_t i) { return samples.begin() + static_cast<std::ptrdiff_t>(cycles.origin + i); };
  const auto longest = std::max_element(at(last.begin), at(last.end) + 1,
                                        [](const Sample& a, const Sample& b) { return a.end_to_end < b.end_to_end; });
  const double loaded = longest->end_to_end, unloaded = at(last.end)->end_to_end, back = loaded - unloaded;
  return {(loaded - gauge_length) / gauge_length, (unloaded - gauge_length) / gauge_length, back / gauge_length,
          back / unloaded};
}

}  // namespace

std::vector<Cycle> closed_cycles(const Path& path) {
  std::vector<Cycle> cycles;
  const std::vector<std::size_t> turns = turning_points(path);
  for (std::size_t i = 0; i + 2 < turns.size(); ++i) {
    const std::size_t begin = turns[i], end = turns[i + 2];
    if (path[turns[i + 1]].extension < path[begin].extension) continue;  // begins inwards
    const bool whole = i > 0 && i + 3 < turns.size();
    if (whole || comes_back(path, begin, end, &PathPoint::extension) || comes_back(path, begin, end, &PathPoint::force))
      cycles.push_back({begin, end, enclosed(path, begin, end)});
  }
  return cycles;
}

Sample origin_at(const Sample& first, Sample before) {
  if (before.balance_offset == first.balance_offset) return before;
  before.extension = 0.0;
  before.force_upper = before.balance_offset = first.balance_offset;
  return before;
}

void read_holds_and_cycles(const std::vector<Sample>& samples, const std::vector<int>& steps, Results& results) {
  results.relaxation = last_relaxation(samples, steps);
  const LastCycles cycles = last_cycles(samples, steps);
  results.cycles = cycles.closed.size();
  if (cycles.closed.empty()) return;
  results.hysteresis = cycles.closed.back().hysteresis;
  if (results.gauge_length) results.elongations = elongations_of(samples, cycles, *results.gauge_length);
}

}  // namespace knot_utm
