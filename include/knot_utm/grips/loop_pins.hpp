#pragma once

#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/scene.hpp"

namespace knot_utm {

/// A pin in a slack loop that becomes one of its rollers: while the loop is put on, it moves to the roller's place and
/// widens to the roller's radius.
struct Pin {
  Vec3 place = Vec3::Zero();  ///< where it begins [m]
  double radius = 0.0;        ///< with which it begins [m]

  void state(Archive& archive) { archive(place, radius); }
};

/// Two pins along y, the lower and the upper one, that stand in the loop and clear its rod by `clearance` [m]. The loop
/// lies about the plane across y. Each pin is as wide as the loop allows, but no wider than `widest` [m], and as far
/// out. Empty: there is no room in one half of the loop.
std::vector<Pin> pins_in(const Points& loop, double widest, double clearance);

/// Gives a roller the place and the radius of its pin while the fraction `left` of the way from one to the other
/// remains.
void widen(const Pin& pin, double left, Roller& roller);

}  // namespace knot_utm
