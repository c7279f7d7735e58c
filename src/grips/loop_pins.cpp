#include "knot_utm/grips/loop_pins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace knot_utm {

namespace {

constexpr int kPlaces = 100;               // in the length of the loop, at which a pin is tried
constexpr double kNarrowestPin = 0.05;     // of the widest
constexpr double kNearestToMiddle = 0.25;  // further in are the knots [length of the loop]
constexpr double kNarrower = 0.8;          // each next radius that is tried

/// The loop as it is seen along the pins.
class Outline {
 public:
  explicit Outline(const Points& loop)
      : loop_(loop), low_(loop.rowwise().minCoeff()), high_(loop.rowwise().maxCoeff()) {}

  double height() const { return high_[2] - low_[2]; }
  double middle() const { return 0.5 * (low_[2] + high_[2]); }
  double left() const { return low_[0]; }
  double right() const { return high_[0]; }

  /// Distance of the nearest node.
  double room(double x, double z) const {
    return std::sqrt(((loop_.row(0).array() - x).square() + (loop_.row(2).array() - z).square()).minCoeff());
  }

  /// Whether the loop goes round a place: how often it passes above it from one side to the other.
  bool goes_round(double x, double z) const {
    int turns = 0;
    for (Eigen::Index i = 0; i < loop_.cols(); ++i) {
      const Eigen::Index next = i + 1 < loop_.cols() ? i + 1 : 0;
      const double from = loop_(0, i) - x, to = loop_(0, next) - x;
      if ((from < 0.0) == (to < 0.0)) continue;
      if (loop_(2, i) + (loop_(2, next) - loop_(2, i)) * from / (from - to) > z) turns += to > from ? 1 : -1;
    }
    return turns != 0;
  }

 private:
  const Points& loop_;
  Vec3 low_, high_;
};

/// The pin of the given radius that stands furthest out in the upper half (sense 1) or in the lower one (-1).
std::optional<Pin> furthest_out(const Outline& loop, double sense, double radius, double clearance) {
  const double step = loop.height() / kPlaces;
  for (double out = 0.5 * loop.height(); out > kNearestToMiddle * loop.height(); out -= step) {
    const double z = loop.middle() + sense * out;
    std::optional<Pin> best;
    double most = radius + clearance;
    for (double x = loop.left(); x <= loop.right(); x += 0.25 * step) {
      const double room = loop.room(x, z);
      if (room < most || !loop.goes_round(x, z)) continue;
      most = room;
      best = Pin{Vec3(x, 0.0, z), radius};
    }
    if (best) return best;
  }
  return std::nullopt;
}

std::optional<Pin> widest_pin(const Outline& loop, double sense, double widest, double clearance) {
  for (double radius = widest; radius > kNarrowestPin * widest; radius *= kNarrower)
    if (const std::optional<Pin> pin = furthest_out(loop, sense, radius, clearance)) return pin;
  return std::nullopt;
}

}  // namespace

std::vector<Pin> pins_in(const Points& loop, double widest, double clearance) {
  const Outline outline(loop);
  const std::optional<Pin> lower = widest_pin(outline, -1.0, widest, clearance),
                           upper = widest_pin(outline, 1.0, widest, clearance);
  if (!lower || !upper) return {};
  return {*lower, *upper};
}

void widen(const Pin& pin, double left, Roller& roller) {
  roller.radius += left * (pin.radius - roller.radius);
  roller.centre += left * (pin.place - roller.centre);
}

}  // namespace knot_utm
