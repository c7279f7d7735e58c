#pragma once

#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "properties/scene.hpp"

namespace knot_utm::properties {

/// A whole number from 0 to 1000 as RapidCheck draws, prints and shrinks it; of the first scenes too any.
inline rc::Gen<int> random_number() { return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1001)); }

inline std::vector<int> random_numbers(std::size_t count) {
  return *rc::gen::container<std::vector<int>>(count, random_number());
}

inline double random_between(double low, double high) { return low + (high - low) * 1e-3 * *random_number(); }

inline Vec3 random_place(double size) {
  const double x = random_between(-size, size), y = random_between(-size, size), z = random_between(-size, size);
  return {x, y, z};
}

inline Motion random_motion(double far) {
  Vec3 axis = random_place(1.0);
  if (axis.norm() < 1e-3) axis = Vec3::UnitX();
  return {Eigen::AngleAxisd(random_between(-M_PI, M_PI), axis.normalized()).toRotationMatrix(), random_place(far)};
}

inline Units random_powers_of_two() {
  return {std::exp2(*rc::gen::inRange(-8, 9)), std::exp2(*rc::gen::inRange(-8, 9)),
          std::exp2(*rc::gen::inRange(-8, 9))};
}

inline Units random_units() {
  const double length = random_between(0.3, 3.0), force = random_between(0.3, 3.0), time = random_between(0.3, 3.0);
  return {length, force, time};
}

/// RapidCheck's own: within so much, or a message that says by how much not.
inline void near(double largest_difference, double error, const char* what) {
  if (!(largest_difference <= error))
    RC_FAIL(std::string(what) + ": off by " + std::to_string(largest_difference / error) + " of its error");
}

}  // namespace knot_utm::properties
