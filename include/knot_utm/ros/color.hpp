#pragma once

#include <std_msgs/ColorRGBA.h>

namespace knot_utm {

inline std_msgs::ColorRGBA color(double red, double green, double blue) {
  std_msgs::ColorRGBA c;
  c.r = static_cast<float>(red);
  c.g = static_cast<float>(green);
  c.b = static_cast<float>(blue);
  c.a = 1.0f;
  return c;
}

/// Of a place on a scale from -1 to 1: blue below zero, light grey at zero, yellow to red above.
inline std_msgs::ColorRGBA tension_color(double place) {
  if (place < 0.0) return color(0.85 + 0.7 * place, 0.85 + 0.5 * place, 0.85 - 0.1 * place);
  if (place < 0.5) return color(0.85 + 0.3 * place, 0.85 - 0.1 * place, 0.85 - 1.5 * place);
  return color(1.0 - 0.3 * (place - 0.5), 0.8 - 1.5 * (place - 0.5), 0.1);
}

}  // namespace knot_utm
