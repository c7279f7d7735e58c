#pragma once

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/bending.hpp"
#include "knot_utm/rod/twisting.hpp"

namespace knot_utm {

struct RodProperties;
struct RodState;

/// Elastic energy of a whole rod [J], the sum over its edges and inner nodes:
///   E = sum_j E_s(e_j) + sum_i E_b(i) + sum_i E_t(i)
///   E_s  stretching.hpp
///   E_b  isotropic_bending.hpp where the rod is straight at rest, else W of its bending law (bending_law.hpp). Of a
///        bend that has yet to yield, as in a rod that is drawn bent, it has what that will dissipate
///   E_t  twisting.hpp, where the state has a frame
///
/// All by the laws of the rod.
struct ElasticEnergy {
  double stretching = 0.0;  ///< [J]
  double bending = 0.0;     ///< [J]
  double twisting = 0.0;    ///< [J], 0 where the state has no twist
  double total() const { return stretching + bending + twisting; }
};

/// State and rod must fit together (require_fits). A state without twist members is taken as twist-free; its rod is
/// then naturally straight and untwisted.
ElasticEnergy elastic_energy(const RodProperties& rod, const RodState& state);

/// Tension of every edge [N], N-1 values, positive where the edge is longer than at rest; of a cut one none.
Eigen::VectorXd edge_tension(const RodProperties& rod, const RodState& state);

/// What inner node i, 1 <= i <= N-2, contributes to the bending and the twisting energy of a rod whose state has a
/// frame. The reference frame of `state` must belong to its positions (transport_frames).
struct InnerNode {
  Vec3 e;          ///< x_i - x_{i-1} [m]
  Vec3 f;          ///< x_{i+1} - x_i [m]
  Directors on_e;  ///< material directors of edge i-1
  Directors on_f;  ///< material directors of edge i
  double twist;    ///< m_i [rad]
  BendingInput bending;
  TwistingInput twisting;
};
InnerNode inner_node(const RodProperties& rod, const RodState& state, Eigen::Index i);

}  // namespace knot_utm
