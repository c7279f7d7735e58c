#pragma once

#include "knot_utm/specimen/centreline.hpp"

namespace knot_utm {

/// An open overhand knot in a rod along z, with its ends at the origin and at (0, 0, end_to_end). The end goes `turns`
/// times through the loop, which gives the (2, 2 turns + 1) torus knot once the ends are joined outside.
///
/// Two strands wind around each other by (2 turns + 1) half turns over a braid of length 2 pi 12^(1/4) sqrt(h R) a
/// full turn (Jawed, Dieleman, Audoly, Reis 2015), and a loop with two half circles of radius R joins its ends. R
/// follows from the excess length, length - end_to_end, and grows with it.
struct OverhandShape {
  double radius = 3.175e-3;     ///< h [m]
  int turns = 1;                ///< 1 to 4
  double length = 1.0;          ///< of the rod [m]
  double end_to_end = 0.7;      ///< distance of the rod's ends [m]
  double edge_length = 0.0032;  ///< target [m]
  double refinement = 1.0;  ///< edges in the middle, of which the tight knot is made, are shorter by this factor [-]
};

/// Throws InvalidInput (specimen.*) where the excess length is too short for the knot or too long for the rod.
Centreline overhand(const OverhandShape& shape);

}  // namespace knot_utm
