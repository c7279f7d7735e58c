#pragma once

#include <vector>

#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/bending_law.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/stencil.hpp"
#include "knot_utm/sim/four_nodes.hpp"

namespace knot_utm {

/// Bending by material curvatures (bending.hpp) at all inner nodes, by the rod's bending law: a part of FrameTerms.
///
/// Both curvatures of a node have one form, which is linear in the directors p and q of its two edges. With the moment
/// M of the law, curvature terms of the Hessian are therefore those of a single curvature, whose directors are the sums
/// weighted by the moment,
///
///   P = M_1 m1_e + M_2 m2_e,   Q = M_1 m1_f + M_2 m2_f,   P' = M_1 m2_e - M_2 m1_e,   Q' alike
///
/// and the tangent T of the law adds sum_kl T_kl dkappa_k dkappa_l^T. Four nodes that follow each other are computed
/// side by side, but for the law, which may branch. What the law gives is computed once for every trial position, with
/// the forces. The first of a group of four is inner node 4 g + 1.
class FrameBending {
 public:
  /// `rod` must outlive this.
  explicit FrameBending(const RodProperties& rod);

  /// From the next step on the rod is cut at this edge, too: at its ends it does not bend.
  void part(int edge) { cuts_.push_back(edge); }

  /// Begins a step of length dt [s] from a state, which must outlive it.
  void begin(const RodState& start, double dt);

  /// Evaluates all nodes, and adds dW/d(e, theta_e, f, theta_f) to their slopes. `pairs` are their edges, and
  /// `director` holds the d1 of edges in fours, `angle` their theta. These two lists have room for four more edges
  /// behind the last group.
  void evaluate(const std::vector<FourPairs>& pairs, const std::vector<FourVectors>& director,
                const std::vector<double>& angle, std::vector<FourSlopes>& slopes);

  /// Adds the linear model of what was evaluated last: its stiffness.
  void add_stiffness(const FourPairs& pair, std::size_t group, FourCurves& curves) const;
  /// Adds to the right-hand side the difference of the model's forces from those of the law (BendingResponse).
  void add_beyond(std::vector<Lanes>& right) const;
  /// What add_stiffness adds of an inner node, by the formulas of bending.hpp. Slow: the oracle of tests.
  StencilMatrix hessian(const FourPairs& pair, int i) const;

  /// Energies of the positions evaluated last [J].
  struct Energy {
    double stored = 0.0, dissipated = 0.0;
  };
  Energy energy() const;

  /// Writes what the law remembers; `tension`: of every edge [N].
  void commit(const std::vector<double>& tension, RodState& state) const;

 private:
  /// m1 and m2 of both edges of four nodes.
  struct FourDirectors {
    FourVectors p[2], q[2];
  };
  struct FourNodes {
    Lanes c, s, s_c, s_cc;  // cosine of the turning angle; s(c) and its derivatives
    FourVectors v_u, u_v;   // v - c u, u - c v
    FourSlopes slope[2];    // of both curvatures
    Lanes moment[2];        // M
    Lanes tangent[3];       // T_11, T_12, T_22
    Lanes beyond[2];        // BendingResponse::beyond
    bool jumps;             // one of them has a `beyond`
  };

  void set_directors(const std::vector<FourPairs>& pairs, const std::vector<FourVectors>& director,
                     const std::vector<double>& angle);
  FourDirectors directors(std::size_t group) const;
  static void set_curvatures(const FourPairs& pair, const FourDirectors& directors, FourNodes& four, Lanes bend[2]);
  template <typename Laws>
  void respond(const Laws& law_of, const Lanes bend[2], std::size_t group);

  const RodProperties& rod_;
  int own_;                // numbers that the law keeps of a node
  std::vector<int> cuts_;  // edges
  // All are empty until the first step that needs them: a rod that is straight at rest has no use for them.
  std::vector<FourVectors> m1_, m2_;  // material directors of the edges
  std::vector<FourNodes> fours_;
  std::vector<BendingNode> nodes_;  // of every inner node, that of node i at i
};

}  // namespace knot_utm
