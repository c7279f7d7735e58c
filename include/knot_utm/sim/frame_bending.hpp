#pragma once

#include <vector>

#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/bending_law.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/stencil.hpp"

namespace knot_utm {

template <int D>
class StepMatrix;
template <int D>
struct LinearSystem;

/// Bending by material curvatures (bending.hpp) at all inner nodes, by the rod's bending law: a part of FrameTerms.
///
/// Both curvatures of a node have one form, which is linear in the directors p and q of its two edges. With the moment
/// M of the law, gradient and curvature terms of the Hessian are therefore those of a single curvature, whose directors
/// are the sums weighted by the moment,
///
///   P = M_1 m1_e + M_2 m2_e,   Q = M_1 m1_f + M_2 m2_f,   P' = M_1 m2_e - M_2 m1_e,   Q' alike
///
/// and the tangent T of the law adds sum_kl T_kl dkappa_k dkappa_l^T. What the law gives is computed once for every
/// trial position, with the forces.
class FrameBending {
 public:
  /// `rod` must outlive this.
  explicit FrameBending(const RodProperties& rod);

  /// From now on the rod has parted at an edge: at its ends it does not bend.
  void part(int edge) { parted_ = edge; }

  /// Begins a step: its next evaluation is its first.
  void begin() { first_trial_ = true; }

  /// Evaluates all nodes for a step of length dt [s] from a state. `tangent` and `inverse_length` are those of the
  /// edges, `director` their d1, `angle` their theta.
  void evaluate(const RodState& start, double dt, const std::vector<Lanes>& tangent,
                const std::vector<double>& inverse_length, const Points& director, const std::vector<double>& angle);

  /// Adds forces and torques as FrameTerms::add_forces, but the torques to `torque`, too, as dE/dtheta_j.
  void add_forces(std::vector<Lanes>& force, std::vector<double>& torque) const;
  /// Adds the linear model of what was evaluated last: its stiffness, and the difference of its forces from those of
  /// the law to the right-hand side (BendingResponse).
  void add_stiffness(LinearSystem<4>& system) const;
  /// What add_stiffness adds of an inner node, by the formulas of bending.hpp. Slow: the oracle of tests.
  StencilMatrix hessian(int i) const;

  /// Energies of the positions evaluated last, for the displacement of the nodes [m] and the angles of the edges now
  /// and at the start of the step [rad].
  struct Energy {
    double stored = 0.0, dissipated = 0.0;  ///< [J]
    double along = 0.0;                     ///< dW/d(x, theta) . (increment, turn) [J]
  };
  Energy energy(const Points& increment, const std::vector<double>& angle, const Eigen::VectorXd& start) const;

  /// Writes what the law remembers; `tension`: of every edge [N].
  void commit(const std::vector<double>& tension, RodState& state) const;

 private:
  /// The derivatives of a curvature, or of the energy, in the unknowns of the nodes i-1, i, i+1: positions in the first
  /// three lanes, the angle of the edge behind the node in the last.
  struct Slope {
    Lanes node[3];
  };
  /// One curvature, or a sum of both with weights.
  struct Curvature {
    Lanes p, q, dp, dq;
  };
  struct Node {
    double c, s, s_c, s_cc;  // cosine of the turning angle; s(c) and its derivatives
    double over_e, over_f;   // 1/|e|, 1/|f| [1/m]
    Lanes u, v;
    BendingNode bend;
    BendingResponse law;
    Slope slope[2];  // of both curvatures
  };

  static Slope slope(const Node& node, const Curvature& k);
  Curvature first(int i) const;
  Curvature second(int i) const;
  Curvature both(int i) const;
  static void add_curvature_terms(const Node& node, const Curvature& k, StepMatrix<4>& matrix, int i);

  const RodProperties& rod_;
  int own_;          // numbers that the law keeps of a node
  int parted_ = -2;  // edge; no node ends this one
  bool first_trial_ = true;
  // Both are empty until the first evaluation: a rod that is straight at rest has no use for them.
  std::vector<Lanes> m1_, m2_;  // material directors of every edge
  std::vector<Node> nodes_;     // of every inner node, that of node i at i
};

}  // namespace knot_utm
