#pragma once

#include <knot_utm/ColorBar.h>
#include <std_msgs/ColorRGBA.h>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/rod/material.hpp"

namespace knot_utm {

/// What the colours of the rod show. Of tension: blue in compression, light grey where there is none, yellow to red.
/// Of curvature: light grey where it is straight, yellow to red.
enum class ColorBy { kTension, kCurvature };

/// The colour of a value. The scale is chosen once for a test, so that a colour means the same from tying to break.
///
/// Tension spans decades, from the newtons of sliding to the kilonewtons of a locked knot. Its scale is logarithmic,
/// but linear around zero:
///
///   place(v) = sign(v) log(1 + |v|/v0) / log(1 + full/v0),   v0 = full / 10000
///
/// `full` is the breaking force. A material without one has half its stretching stiffness instead (a strain of 50 %),
/// no more than the load cell's capacity and no less than the tying pre-load. It is rounded up to 1, 2 or 5 times a
/// power of ten. Curvature times the rod's radius has a linear scale that ends at 1: bent to a circle as wide as the
/// rod is thick.
class ColorScale {
 public:
  static ColorScale of_tension(const Material& material, const LoadCellOptions& cell);
  static ColorScale of_curvature();

  double full() const { return full_; }  ///< value at the red end
  double place(double value) const;      ///< -1 to 1: 0 at zero, 1 at `full`
  std_msgs::ColorRGBA color(double value) const;
  ColorBar bar() const;  ///< for those who draw the colours beside the rod

 private:
  ColorScale(ColorBy what, double full) : what_(what), full_(full) {}
  double lowest() const;  ///< place of the bar's lower end

  ColorBy what_;
  double full_;
};

}  // namespace knot_utm
