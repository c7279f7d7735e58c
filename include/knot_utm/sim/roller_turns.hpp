#pragma once

#include <Eigen/LU>
#include <vector>

#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/solver/block_matrix.hpp"

namespace knot_utm {

/// The rotations psi of free rollers as unknowns in addition to those of the rod. With K the rod's own matrix,
///
///     | K  C | |dq  |   |f  |       C = -df/dpsi       [N/rad], [N m/rad] on spins
///     | R  D | |dpsi| = |tau|,      R = -dtau/dq       [N], [N m/rad] of spins
///                                   D = -dtau/dpsi + I/dt^2  [N m/rad]
///
/// K^-1 C takes one more pair of substitutions for each roller. What is left is a system with one row for each free
/// roller (bordering). A scene without free rollers pays nothing. Source: Nocedal, Wright 2006 (block elimination).
///
/// A contact with gap x, force g and s = a x (1 - lambda) x (roller_contact.hpp) contributes
///
///     -dtau/dq = s.dg/dq + (1 - lambda) (g x a).dx/dq,      -dtau/dpsi = s.dg/dpsi.
class RollerTurns {
 public:
  /// To be called before the contacts of a linear system are added; `nodes`: number of the rod's nodes.
  void begin(const std::vector<Roller>& rollers, const RollerContact& contact, int nodes, double dt);
  bool empty() const { return free_.empty(); }

  /// The unbalanced torque on a roller, including its inertia [N m].
  static double unbalanced(const std::vector<Roller>& rollers, const RollerContact& contact, int roller, double dt);
  /// The largest of these over the radius of its roller [N].
  static double largest_unbalanced(const std::vector<Roller>& rollers, const RollerContact& contact, double dt);

  void add(const ContactPoint& contact, const RollerModel& model);
  void add(const ContactPoint& contact, const SurfacePoint& surface, const SurfaceModel& model,
           const SectionTurns& turns, bool soft = false);
  /// Marks the rows of the rod's matrix that prescribe an unknown: those whose lane of `keep` is 0.
  void hold(int node, const Lanes& keep);

  /// Solves; `change`: right-hand side, then dq. False where the matrix is singular.
  template <int D>
  bool solve(BlockMatrix<D>& matrix, std::vector<Lanes>& change);

  /// Largest motion of a roller's surface by the last solution [m].
  double largest_motion() const;
  /// Turns the rollers by `factor` times the last solution.
  void move(RollerContact& contact, double factor) const;

  /// What the equation of one free roller adds to the system.
  struct Border {
    int roller = 0;
    double radius = 0.0;                  ///< [m]
    std::vector<Lanes> column, row;       ///< C and R, of every node
    double diagonal = 0.0, torque = 0.0;  ///< D; tau with the pressures of the linear models [N m]
    double change = 0.0;                  ///< dpsi [rad]
  };
  /// What the n-th free roller adds.
  const Border& border(std::size_t n) const { return borders_[n]; }

 private:
  Border* border_of(const ContactPoint& contact);

  std::vector<Border> borders_;  // as many as were ever free, for their memory
  std::vector<std::size_t> free_;
  // The reduced system; members, so that a solve allocates nothing.
  Eigen::MatrixXd left_;
  Eigen::VectorXd right_, turns_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

extern template bool RollerTurns::solve(BlockMatrix<3>&, std::vector<Lanes>&);
extern template bool RollerTurns::solve(BlockMatrix<4>&, std::vector<Lanes>&);

}  // namespace knot_utm
