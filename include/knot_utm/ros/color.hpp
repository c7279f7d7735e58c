#pragma once

#include <std_msgs/ColorRGBA.h>

namespace knot_utm {

/// An opaque colour from its components, 0 to 1.
inline std_msgs::ColorRGBA color(double red, double green, double blue) {
  std_msgs::ColorRGBA c;
  c.r = static_cast<float>(red);
  c.g = static_cast<float>(green);
  c.b = static_cast<float>(blue);
  c.a = 1.0f;
  return c;
}

/// Linear interpolation between two colours.
inline std_msgs::ColorRGBA mixed(const std_msgs::ColorRGBA& from, const std_msgs::ColorRGBA& to, double fraction) {
  const auto mix = [fraction](float a, float b) {
    return (1.0 - fraction) * static_cast<double>(a) + fraction * static_cast<double>(b);
  };
  return color(mix(from.r, to.r), mix(from.g, to.g), mix(from.b, to.b));
}

/// The colour of a place on a scale from -1 to 1: blue below zero, light grey at zero, and green, yellow and red above.
inline std_msgs::ColorRGBA tension_color(double place) {
  const std_msgs::ColorRGBA grey = color(0.85, 0.85, 0.85), yellow = color(1.0, 0.8, 0.1);
  // Ropes that lock at a thousand times the sliding force slide in the green range. It must look neither like zero nor
  // like locking.
  constexpr double kGreen = 0.2, kYellow = 0.5;
  const std_msgs::ColorRGBA green = color(0.45, 0.8, 0.35);
  if (place < 0.0) return mixed(grey, color(0.15, 0.35, 0.95), -place);
  if (place < kGreen) return mixed(grey, green, place / kGreen);
  if (place < kYellow) return mixed(green, yellow, (place - kGreen) / (kYellow - kGreen));
  return mixed(yellow, color(0.85, 0.05, 0.1), (place - kYellow) / (1.0 - kYellow));
}

}  // namespace knot_utm
