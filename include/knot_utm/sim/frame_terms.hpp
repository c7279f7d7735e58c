#pragma once

#include <vector>

#include "knot_utm/contact/surface_contact.hpp"
#include "knot_utm/numeric/block.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/bending.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/half_turn.hpp"
#include "knot_utm/rod/stencil.hpp"
#include "knot_utm/rod/twisting.hpp"
#include "knot_utm/sim/force_term.hpp"
#include "knot_utm/sim/four_nodes.hpp"
#include "knot_utm/sim/frame_bending.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {

/// The terms of material frames in one implicit step: the angle theta_j of every edge as an unknown in addition to the
/// nodes' positions, twisting, bending where the rod has a natural curvature, and inertia and drag of spin.
///
///   I_j (theta_j - theta_j^n - dt omega_j^n)/dt^2 + (c h^2 l_j/dt + r_j) (theta_j - theta_j^n) = -dE/dtheta_j + T_j
///
///   theta_j  angle of the material against the reference frame of edge j at the end of the step  [rad]
///   theta_j^n, omega_j^n   angle and rate at its beginning  [rad], [rad/s]
///   I_j      rho pi h^4/2 l_j, polar moment of inertia      [kg m^2]
///   c        viscous drag per length, as for the positions: it acts on the rod's surface, whose speed is h omega and
///            whose lever is h [N s/m^2]
///   r_j      0, or where spin has neither inertia nor drag a regularisation, a small fraction of k_t/l_j, so that a
///            rod that is free to turn stays where it is [N m]
///   E        of twist at every inner node (twisting.hpp) and, where the rod has a natural curvature,
///            bending.hpp [J]; a rod that is straight at rest bends as without frames (isotropic_bending.hpp)
///   T_j      torque of the holder of a held frame about the tangent [N m]
///
/// StepSettings::spin_inertia says whether I and c count. Without them twist is in equilibrium at the end of every
/// step. A rod that is straight at rest and whose ends are free to turn then has no twist at any time, and moves
/// exactly as one without frames. With them it has some twist while it moves, until the waves of twist have decayed.
///
/// The reference frame of a trial position is that of the step's beginning, transported from tangent t^n to tangent t
/// edge by edge. It therefore does not depend on the path of the iterations, and theta - theta^n is the rotation of the
/// rod about itself. Forces are -dE/dx at fixed spin of the material frames. Because transport depends on the path of a
/// tangent, these forces have no potential beyond one step. With g the gradient, H the symmetric Hessian of the
/// energies on the stencils and s_j the spin of edge j, their exact derivative is
///
///   dg = H (dx, ds) + 1/2 dE/dtheta_j t_j x de_j/|e_j|^2 on (x_{j+1}; minus that on x_j)
///   ds_j = dtheta_j + lean_j . de_j,    lean_j = -(t_j^n x t_j)/((1 + t_j^n . t_j) |e_j|)
///
/// where lean comes from the area that the transport from t^n sweeps as t moves. Newton's method therefore solves for
/// spins s in place of angles. Its matrix is not symmetric, but exact. The reference twist of a trial position is that
/// of the step's beginning plus an angle. It is the angle by which a frame turns when it is transported from t_f^n once
/// around the tangents t_f, t_e, t_e^n of the two edges of a node. It follows from a product of four quaternions (1 +
/// a.b, a x b), without transporting a frame, and without an arctangent while it is small. d1 is transported once in
/// each step. Where friction acts at the rod's surface, its couples exert torques on the spins (surface_contact.hpp).
/// Friction on the centreline does not turn the rod about itself. Source: Bergou et al. 2010, sections 3 and 4; Jawed,
/// Novelia, O'Reilly 2018, chapters 4 to 7; the derivative along the moving frame our own.
class FrameTerms : public ForceTerm {
 public:
  /// The unknowns x_{i-1}, s_{i-1}, x_i, s_i, x_{i+1}, s_{i+1} of an inner node; the last one takes no part.
  using NodeStiffness = Eigen::Matrix<double, 12, 12>;

  /// Terms of one edge beyond those of its nodes.
  struct EdgeStiffness {
    Mat3 sweep;   ///< the part of d(dE/de)/de that comes from the path of the tangent, antisymmetric [N/m]
    double spin;  ///< of inertia, drag and r: d(torque)/dtheta [N m]
    Vec3 lean;    ///< dtheta = ds - lean . de [1/m]
  };

  /// `rod` must outlive this. Of the half of a rod which is its own `image`, turns() are those of all edges.
  FrameTerms(const RodProperties& rod, const StepSettings& settings, const HalfTurn* image = nullptr);

  /// From now on the rod is cut at this edge, too: at its ends nothing twists or bends.
  void part(int edge);

  /// Takes the lengths of the rod anew for what it twists by; its spin keeps the inertia and the drag that it had.
  void take_lengths();

  /// Begins a step, whose state must have frames. Held angles begin at their prescribed values, all others at a
  /// prediction from their rates.
  void begin(const StepStart& start, bool predicts);

  /// The angles of a half of the rod, and of its images.
  void mirror(const FrameTerms& half, const HalfTurn& image);

  /// Adds forces [N] (lanes 0 to 2 of every node) and torques [N m] (lane 3: of the edge behind the node) at trial
  /// positions. A stiffness that is read afterwards belongs to these positions.
  void add_forces(const StepStart& start, const Points& x, std::vector<Lanes>& force);

  /// Adds -d(force, torque)/d(x, s).
  void add_stiffness(LinearSystem<4>& system) const;

  /// The same node by node and edge by edge, from the formulas of twisting.hpp and bending.hpp: of the elastic terms at
  /// inner node i, 1 <= i <= N-2, and of edge j. Slow: the oracle that tests compare add_stiffness with.
  NodeStiffness node_stiffness(int i) const;
  EdgeStiffness edge_stiffness(int j) const;

  /// The lean of edge j, as FrameTerms says [1/m].
  Vec3 lean(int j) const { return to_vec3(lean_[static_cast<std::size_t>(j)]); }

  /// Spins of the edges in this step, at the trial positions; only where friction acts at the surface.
  const SectionTurns& turns() const { return turns_; }

  /// Whether the angle is prescribed. That of the last node, which has no edge behind it, always is.
  bool held(int edge) const { return held_[static_cast<std::size_t>(edge)] != 0; }

  /// The largest factor of at most 1 with which the change (dx, ds) turns no angle further than allowed in one
  /// iteration.
  double largest_factor(const std::vector<Lanes>& change) const;
  void move(const std::vector<Lanes>& change, double factor);

  /// Energies of the trial evaluated last; `increment` [m]: displacement of its nodes in the step.
  struct Energy {
    double twisting = 0.0, bending = 0.0;  ///< bending where the rod has a natural curvature [J]
    double plastic = 0.0;                  ///< dissipated by bending [J]
    double along = 0.0;                    ///< dE/d(x, s) . (increment, turn) [J]
    double residual = 0.0;                 ///< torques on free edges times their turn [J]
    double drag = 0.0;                     ///< c h^2 l_j omega_j^2 dt [J]
    double rest = 0.0;                     ///< r_j turn^2 [J]
    double inertia = 0.0;                  ///< 1/2 I_j (omega_j - omega_j^n)^2 [J]
    double kinetic = 0.0;                  ///< [J]
    Vec3 moment = Vec3::Zero();            ///< of inertia, drag and r_j, about the edges' tangents [N m]
  };
  Energy energy(const Points& increment, const std::vector<Lanes>& force) const;
  /// Adds the energies at the end of an accepted step, and the work of forces and torques in it.
  void account(const SolvedStep& step, StepAccount& account) const;
  /// Kinetic energy of spin at these rates [rad/s]; [J].
  double kinetic_energy(const Eigen::VectorXd& rate) const { return 0.5 * inertia_.dot(rate.cwiseAbs2()); }

  /// Writes angles, rates, frames and what the bending law remembers into the state whose positions were evaluated
  /// last; `tension`: of every edge [N].
  void write(const std::vector<double>& tension, RodState& state);

 private:
  /// Twist of four inner nodes.
  struct FourTwists {
    FourVectors binormal;       // b, as twisting.hpp has it
    Lanes over_chi, stiffness;  // 1/chi; d2E/dm2 [N m]
    Lanes moment;               // dE/dm [N m]
  };

  void set_tangents(const Points& position);
  void set_twist();
  FourSlopes twist_slopes(std::size_t group) const;
  FourCurves twist_curves(std::size_t group) const;
  FourEdges edges_behind(std::size_t group) const;
  void add_first_edge(StepMatrix<4>& matrix) const;
  void carry_directors();
  void add_elastic_forces(std::vector<Lanes>& force);
  int nodes_of(std::size_t group) const;  // how many of the four there are
  void set_turn(std::size_t edge, double turned);
  void turn_images();

  /// Stiffnesses of inner node i are zero where it ends a cut edge.
  TwistingInput twisting_input(int i) const;
  double twist(int i) const;  // m of inner node i
  double angle_change(const std::vector<Lanes>& change, int edge) const;

  const RodProperties& rod_;
  FrameBending bending_;     // where the rod is curved at rest
  Eigen::VectorXd inertia_;  // I_j
  Eigen::VectorXd drag_;     // c h^2 l_j [N m s]
  Eigen::VectorXd rest_;     // r_j
  bool curved_ = false;      // at rest, as the step begins
  std::vector<int> cuts_;    // edges
  bool rolls_;               // turns_ are asked for
  const HalfTurn* image_;
  const RodState* start_ = nullptr;
  double dt_ = 0.0;
  std::vector<char> held_;  // N
  // These lists hold a value for each edge or node. They have room for three more behind the last entry, because they
  // are computed four at a time.
  std::vector<Lanes> start_tangent_;     // t^n
  std::vector<Lanes> edge_, tangent_;    // e_j, t_j of the trial positions
  std::vector<double> inverse_length_;   // 1/|e_j|
  std::vector<Lanes> lean_;              // lean_j
  SectionTurns turns_;                   // in this step
  std::vector<double> stiffness_;        // k_t/lbar of every node, 0 at a cut edge [N m]
  std::vector<double> angle_;            // theta_j
  std::vector<double> spin_;             // d(torque)/dtheta_j of inertia, drag and r_j in this step [N m]
  std::vector<double> kept_spin_;        // I_j omega_j^n/dt [N m]
  std::vector<double> start_twist_;      // m_ref of every node as the step began
  std::vector<double> reference_twist_;  // m_ref of every node
  std::vector<double> torque_;           // dE/dtheta_j [N m]
  // Group g of these lists is edges 4 g to 4 g + 3, or inner nodes 4 g + 1 to 4 g + 4. Those of edges have one more.
  std::vector<FourVectors> start_fours_, tangent_fours_;  // t^n, t
  std::vector<FourVectors> start_director_, director_;    // d1_j; of a rod that is straight at rest once a step
  std::vector<FourPairs> start_pairs_, pairs_;            // without lengths in start_pairs_
  std::vector<FourTwists> twists_;
  std::vector<FourSlopes> slopes_;  // of the elastic energy
};

}  // namespace knot_utm
