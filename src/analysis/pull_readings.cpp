#include "knot_utm/analysis/pull_readings.hpp"

#include "pull_integrals.hpp"

namespace knot_utm {
namespace {

constexpr double kChordBegin = 0.1, kChordEnd = 0.5;  // of the peak
constexpr double kSteady = 0.02;                      // by which the last two quarters of a pull that slides may differ
constexpr double kTangentWindow = 0.1;                // of the way to the peak

}  // namespace

double energy(const Pull& pull) {
  return pull.empty() ? 0.0 : integrate(pull, {pull.front().extension, pull.back().extension}).force;
}

double energy_to_peak(const Pull& pull) { return pull.empty() ? 0.0 : WayToPeak(pull).work(); }

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
  const WayToPeak way(pull);
  const double begin = kChordBegin * peak_force(pull), end = kChordEnd * peak_force(pull);
  const double length = way.last_rise_through(end) - way.last_rise_through(begin);
  if (!(length > 0.0) || !way.is_below(begin)) return std::nullopt;
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
  const WayToPeak way(pull);
  double steepest = way.slope({end - window, end});
  for (std::size_t i = 0; pull[i].extension + window < end; ++i)
    steepest = std::max(steepest, way.slope({pull[i].extension, pull[i].extension + window}));
  return steepest;
}

}  // namespace knot_utm
