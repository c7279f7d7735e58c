#pragma once

#include <vector>

#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {

/// Four inner nodes that follow each other along the rod, side by side. Each has an edge vector e before it and f
/// behind it, u and v being their unit tangents.
struct FourPairs {
  FourVectors u, v;
  Lanes over_e, over_f;  ///< 1/|e|, 1/|f| [1/m]
};

/// What the energy of a node depends on: e, theta_e, f, theta_f, in this order. These are the components of each.
inline constexpr int kOfE = 0, kThetaE = 3, kOfF = 4, kThetaF = 7;

/// First derivatives of a function of each node [N], and [N m] for the angles.
struct FourSlopes {
  Lanes of[8];

  FourSlopes& operator+=(const FourSlopes& o) {
    for (int r = 0; r < 8; ++r) of[r] += o.of[r];
    return *this;
  }
};
inline FourSlopes operator*(const Lanes& factor, FourSlopes slopes) {
  for (Lanes& each : slopes.of) each *= factor;
  return slopes;
}

/// Second derivatives of a function of each node [N/m], [N] and [N m]: symmetric, of which [r][c] with r <= c is used.
struct FourCurves {
  Lanes of[8][8];

  const Lanes& at(int r, int c) const { return r <= c ? of[r][c] : of[c][r]; }
};

/// Terms of the edge f of each node alone, as FrameTerms::EdgeStiffness has them.
struct FourEdges {
  FourVectors sweep;  ///< the vector w of the antisymmetric matrix w x [N/m]
  Lanes spin;
  FourVectors lean;
};

/// Subtracts slopes of `count` nodes, of which the first has number `first`, from forces of nodes and torques on their
/// spins. By e = x_i - x_{i-1} and f = x_{i+1} - x_i, dE/dx is -dE/de of the node before, dE/df of the one behind, and
/// dE/de - dE/df of the node between them.
void subtract_slopes(const FourSlopes& slopes, int first, int count, std::vector<Lanes>& force);

/// Adds second derivatives of `count` nodes to the matrix, and those of their edges f.
void add_curves(const FourCurves& curves, const FourEdges& edges, int first, int count, StepMatrix<4>& matrix);

}  // namespace knot_utm
