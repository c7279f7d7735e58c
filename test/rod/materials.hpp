#pragma once

#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// Materials of Table 1 of the source paper as tests use them: elastic, with friction on the centrelines. A test of
/// friction at the surface sets the couple.
inline Material table1(double density, double k_s, double k_b, double k_t, double mu) {
  Material out;
  out.radius = 3.175e-3;
  out.density = density;
  out.stretching_stiffness = k_s;
  out.bending_stiffness = k_b;
  out.twisting_stiffness = k_t;
  out.friction_coefficient = mu;
  out.friction_couple = 0.0;
  return out;
}

inline Material nylon() { return table1(1150.0, 7.34e4, 4.31e-5, 4.31e-5, 0.46); }
inline Material polypropylene() { return table1(900.0, 3.9e4, 1.18e-4, 1.18e-4, 0.63); }
inline Material pink_vps() { return table1(1150.0, 1.70, 4.34e-6, 2.893e-6, 0.54); }

}  // namespace knot_utm
