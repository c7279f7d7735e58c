#pragma once

#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/sim/force_term.hpp"
#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {

struct RodProperties;

/// Forces and stiffness of a whole centreline: stretching (stretching.hpp) of every edge by the rod's law, and
/// isotropic bending (isotropic_bending.hpp) of every inner node. The two share the tangents.
class CentrelineTerms : public ForceTerm {
 public:
  /// Without `bends`, stretching only: bending about a curved rest shape needs frames. `rod` must outlive this.
  CentrelineTerms(const RodProperties& rod, bool bends);

  /// From now on the rod is cut at this edge, too: it has no tension, and does not bend at its ends.
  void part(int edge);

  /// Takes the lengths of the rod anew.
  void take_lengths();

  /// Begins a step. `predicts`: the geometric stiffness uses the predicted tensions, at first those at its start; else
  /// the present ones.
  void begin(const StepStart& start, bool predicts);
  /// Predicts the tensions after `factor` times a change of the nodes [m], with the stiffness that was added last.
  void predict(const std::vector<Lanes>& change, double factor);

  /// Adds the forces on every node [N], which depend on the trial positions x only. A stiffness that is added
  /// afterwards belongs to them.
  void add_forces(const StepStart& start, const Points& x, std::vector<Lanes>& force);

  /// Tension of every edge at the positions that were evaluated last [N].
  const std::vector<double>& tensions() const { return tension_; }
  /// Largest |tension| of an edge at that position [N].
  double largest_tension() const { return largest_tension_; }

  /// The largest |tension| of the one or two edges that end at a node [N].
  double largest_tension_at(int node) const {
    const std::size_t j = static_cast<std::size_t>(node);
    const double ahead = j < tension_.size() ? std::abs(tension_[j]) : 0.0;
    return j > 0 ? std::max(std::abs(tension_[j - 1]), ahead) : ahead;
  }

  /// Both energies at that position, and the change that their gradient there gives for an `increment` [m].
  struct Energy {
    double stretching = 0.0, bending = 0.0;  ///< [J]
    double along = 0.0;                      ///< dE/dx . increment [J]
  };
  Energy energy(const Points& increment) const;
  /// Adds the energies at the end of an accepted step, and the work of their forces in it.
  void account(const SolvedStep& step, StepAccount& account) const;

  /// Overwrites blocks (i, i) to (i, i+2) and their mirrors with the Hessian of both energies, so that nobody has to
  /// set them to zero. It is the first term to be called. Where tensions are predicted, the geometric stiffness
  /// T/|e| (1 - t t^T) uses the predicted ones. An edge that a change has turned by theta is longer by theta^2/2 of its
  /// length. In a rope the present tension is then too large by k_s theta^2/2 and would stiffen the edge against the
  /// next change. This is Newton's method with tensions as unknowns in addition to the positions. It is fast where
  /// strands are pulled; a rod that buckles needs the present tensions. Source: Magisano, Leonetti, Garcea 2017 (mixed
  /// integration points).
  template <int D>
  void add_stiffness(LinearSystem<D>& system) const;

 private:
  /// d2E/(de df) of the bending at one inner node between edges e and f: columns, with H_fe = H_ef^T.
  struct NodeHessian {
    Lanes ee[3], ef[3], fe[3], ff[3];
  };
  NodeHessian bending_hessian(std::size_t node) const;
  template <typename Law>
  void add_stretching_forces(const Law& law, std::size_t begin, std::size_t end, const Points& position,
                             std::vector<Lanes>& force);
  template <typename Law>
  void add_stretching_energy(const Law& law, std::size_t begin, std::size_t end, Energy& out) const;
  void add_bending_forces(std::vector<Lanes>& force);
  /// An edge in the position that was evaluated last.
  StretchedEdge stretched(std::size_t edge) const {
    return {stretching_stiffness_[edge], rod_.rest_length[static_cast<Eigen::Index>(edge)], stretch_[edge]};
  }

  const RodProperties& rod_;
  bool bends_;
  double largest_tension_ = 0.0;
  std::vector<double> stretching_stiffness_;  // k_s of every edge [N]; 0: cut
  std::vector<double> bending_stiffness_;     // k_b/lbar of every node [N m]; 0: at a cut edge
  std::vector<std::size_t> ends_of_cuts_;     // inner nodes
  // As isotropic_bending.hpp names them.
  std::vector<Lanes> tangent_;           // t of every edge
  std::vector<double> inverse_length_;   // 1/|e| [1/m]
  std::vector<double> stretch_;          // lambda
  std::vector<double> tension_, slope_;  // T, dT/dlambda [N]
  bool predicts_ = false;
  std::vector<double> predicted_tension_;  // [N]
  // c of every node, 1 of the ends; W' and W'' over k_b/lbar, four nodes side by side.
  std::vector<Lanes> cosine_, bending_slope_, bending_curve_;
};

}  // namespace knot_utm
