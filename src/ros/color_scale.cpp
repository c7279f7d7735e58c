#include "knot_utm/ros/color_scale.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace knot_utm {
namespace {

constexpr double kDecades = 1e4;        // from the end of the linear part to the end of the scale
constexpr double kLargestStrain = 0.5;  // that is shown of a rod without a breaking force
constexpr double kSharpestBend = 1.0;   // radius of the rod over that of its curve
constexpr double kCompression = 1e-3;   // where blue ends: a thin rod buckles before [of `full`]
constexpr int kColors = 128;            // of the bar

struct Stop {
  double place, red, green, blue;
};
/// Blue below zero, light grey at zero, and green, yellow and red above. Ropes that lock at a thousand times the
/// sliding force slide in the green range, which must look neither like zero nor like locking.
constexpr Stop kStops[] = {{-1.0, 0.15, 0.35, 0.95},
                           {0.0, 0.85, 0.85, 0.85},
                           {0.2, 0.45, 0.8, 0.35},
                           {0.5, 1.0, 0.8, 0.1},
                           {1.0, 0.85, 0.05, 0.1}};

/// The colour of a place on a scale from -1 to 1.
std_msgs::ColorRGBA color_at(double place) {
  const Stop* high = std::find_if(std::begin(kStops) + 1, std::end(kStops) - 1,
                                  [place](const Stop& stop) { return place < stop.place; });
  const Stop& low = high[-1];
  const double fraction = (place - low.place) / (high->place - low.place);
  const auto mixed = [&](double Stop::*part) { return (1.0 - fraction) * low.*part + fraction * high->*part; };
  return color(mixed(&Stop::red), mixed(&Stop::green), mixed(&Stop::blue));
}

/// 1, 2 or 5 times a power of ten, no less than `value`.
double rounded_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (value <= digit * power * (1.0 + 1e-9)) return digit * power;
  return 10.0 * power;
}

}  // namespace

std_msgs::ColorRGBA color(double red, double green, double blue) {
  std_msgs::ColorRGBA c;
  c.r = static_cast<float>(red);
  c.g = static_cast<float>(green);
  c.b = static_cast<float>(blue);
  c.a = 1.0f;
  return c;
}

ColorScale ColorScale::of_tension(const Material& material, const LoadCellOptions& cell) {
  const double stretched = std::min(kLargestStrain * material.stretching_stiffness, cell.capacity);
  return {ColorBy::kTension,
          rounded_up(material.breaking_force.value_or(std::max(stretched, material.tying_preload.value_or(0.0))))};
}

ColorScale ColorScale::of_curvature() { return {ColorBy::kCurvature, kSharpestBend}; }

double ColorScale::place(double value) const {
  const double fraction = std::clamp(value / full_, -1.0, 1.0);
  if (what_ == ColorBy::kCurvature) return fraction;
  return std::copysign(std::log1p(kDecades * std::abs(fraction)) / std::log1p(kDecades), fraction);
}

double ColorScale::lowest() const { return what_ == ColorBy::kTension ? place(-kCompression * full_) : 0.0; }

std_msgs::ColorRGBA ColorScale::color(double value) const { return at(place(value)); }

std_msgs::ColorRGBA ColorScale::at(double place) const {
  return color_at(place < 0.0 ? std::max(place / std::abs(lowest()), -1.0) : place);
}

ColorBar ColorScale::bar() const {
  const bool tension = what_ == ColorBy::kTension;
  ColorBar bar;
  bar.quantity = tension ? "tension" : "curvature";
  bar.unit = tension ? "N" : "1/radius";
  if (tension) {
    bar.ticks = {-kCompression * full_, 0.0, 1e-3 * full_, 1e-2 * full_, 0.1 * full_, full_};
  } else {
    bar.ticks = {0.0, 0.25 * full_, 0.5 * full_, 0.75 * full_, full_};
  }
  for (const double tick : bar.ticks) bar.places.push_back((place(tick) - lowest()) / (1.0 - lowest()));
  for (int i = 0; i < kColors; ++i) bar.colors.push_back(at(lowest() + (1.0 - lowest()) * i / (kColors - 1)));
  return bar;
}

}  // namespace knot_utm
