#pragma once

#include <knot_utm/ColorBar.h>
#include <std_msgs/ColorRGBA.h>

#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// An opaque colour from its components, 0 to 1.
std_msgs::ColorRGBA color(double red, double green, double blue);

/// What the colours of the rod show. Tension: blue in compression, light grey at zero, then green, yellow and red.
/// Curvature: light grey where the rod is straight, then green, yellow and red.
enum class ColorBy { kTension, kCurvature };

/// A colour scale. It is chosen once for a test, so that a colour has the same meaning from tying to the break.
///
/// Tension spans decades, from the newtons of sliding to the kilonewtons of a locked knot. Its scale is logarithmic,
/// and linear around zero:
///
///   place(v) = sign(v) log(1 + |v|/v0) / log(1 + full/v0),   v0 = full / 10000
///
/// `full` is the breaking force. For a material without one it is half of the stretching stiffness (the tension at a
/// strain of 50 %), but at most the capacity of the load cell and at least the tying pre-load. It is rounded up to 1, 2
/// or 5 times a power of ten. Curvature has a linear scale of curvature times rod radius, which ends at 1: a bend whose
/// radius is that of the rod.
class ColorScale {
 public:
  static ColorScale of_tension(const Material& material, const LoadCellOptions& cell);
  static ColorScale of_curvature();

  double full() const { return full_; }  ///< value at the red end of the scale
  double place(double value) const;      ///< place of a value on the scale, -1 to 1: 0 at zero, 1 at `full`
  std_msgs::ColorRGBA color(double value) const;
  ColorBar bar() const;  ///< message for displays that draw the scale beside the rod

 private:
  ColorScale(ColorBy what, double full) : what_(what), full_(full) {}
  double lowest() const;  ///< place of the lower end of the bar
  std_msgs::ColorRGBA at(double place) const;

  ColorBy what_;
  double full_;
};

}  // namespace knot_utm
