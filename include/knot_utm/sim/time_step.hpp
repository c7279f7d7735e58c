#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/step_diagnosis.hpp"
#include "knot_utm/solver/newton.hpp"

namespace knot_utm {

/// How a time step is solved: by Newton's method as it stands, or, where that runs in circles, with friction
/// linearised by secants, shorter moves and more patience. The equations and their tolerance are the same.
enum class Solution { kTangents, kSecants };

/// How one time step went.
struct StepSummary {
  NewtonSummary newton;
  double largest_motion = 0.0;   ///< of a node [m]
  double largest_overlap = 0.0;  ///< of two strands, or of strand and roller [m]
  std::string reason;            ///< why it was not accepted; empty: it was
  StepDiagnosis diagnosis;       ///< of one that was not

  bool accepted() const { return reason.empty(); }
};

/// Where the solution of a step stands, for those who watch it.
struct Iterate {
  double residual = 0.0;      ///< the largest [N]
  double tolerance = 0.0;     ///< what it may be [N]
  int node = -1;              ///< whose it is; -1: of none, all are held
  bool spin = false;          ///< it is the torque on the edge behind the node, over the radius
  double share = 0.0;         ///< of the change that led here; 0: the prediction [-]
  double motion = 0.0;        ///< of the node that this moved the furthest [m]
  int active = 0;             ///< contacts in the next linear system
  int touching = 0;           ///< contacts that carry force
  bool in_contact = false;    ///< what follows means something: the deepest contact
  double overlap = 0.0;       ///< [m]
  double arclengths[2] = {};  ///< of its two strands at rest; on a roller the first only [m]
  int roller = -1;            ///< that it is on; -1: between strands
};

/// What can be read off the last accepted step. Contact has an energy from the first one on.
struct Energies {
  double stretching = 0.0, bending = 0.0, twisting = 0.0, contact = 0.0, kinetic = 0.0;  ///< [J]
  double elastic() const { return stretching + bending + twisting; }
  double total() const { return elastic() + contact + kinetic; }

  void state(Archive& archive) { archive(stretching, bending, twisting, contact, kinetic); }
};

struct ContactReading {
  int touching = 0;              ///< points of integration that carry force
  double normal_force = 0.0;     ///< sum of their normal forces [N]
  double largest_overlap = 0.0;  ///< between strands [m]
  /// Sum of x x g, the couple that friction exerts as it acts on the centrelines, which are apart by x. Where the
  /// strands' surfaces meet it would have none; the grips feel it. [N m]
  Vec3 couple = Vec3::Zero();

  void state(Archive& archive) { archive(touching, normal_force, largest_overlap, couple); }
};

/// Where the work of the last accepted step went [J]; an identity of the step's equations, to rounding, in which each
/// term has a formula of its own:
///
///   boundary = change of Energies::total() + friction + drag + numerical + reweighting + residual
///
/// with way x - x_n, E the elastic energies, F the forces of held nodes and rollers on the rod, and for every contact
/// its weight w, pressure p, slip s in the step, overlap D and energy e(D) per length:
///
///   boundary     sum 1/2 (F_n + F) . way, and what slipping grips, forces and gravity do at the end of the step
///   friction     sum w mu p z . s, all that is done against friction: what the presliding spring of a contact at rest
///                could give back, less than mu p w xi_s/2 each, counts as lost until it does
///   drag         sum c lbar |way|^2/dt
///   numerical    that of the implicit Euler step, which takes all forces at its end:
///                  sum 1/2 m |v - v_n|^2 + E_n - E + dE/dx . way + sum w [e(D_n) - e(D) - p n . s]
///                less 1/2 (F - F_n) . way, by which it takes the work of the boundary for too much
///   reweighting  contact energy at the last step's end less sum w e(D_n): weights follow the shape between two steps,
///                feet come and go, and what is stored in them changes without a force; negative where it grows
///   residual     what Newton's method left unbalanced on free nodes, times their way
///
/// An edge's spin counts as the nodes' motion does, with its own inertia, drag, torques and the trifle r_j
/// (frame_terms.hpp), which is numerical.
struct StepWork {
  double boundary = 0.0;
  double friction = 0.0;
  double drag = 0.0;
  double numerical = 0.0;
  double reweighting = 0.0;
  double residual = 0.0;

  StepWork& operator+=(const StepWork& other) {
    boundary += other.boundary;
    friction += other.friction;
    drag += other.drag;
    numerical += other.numerical;
    reweighting += other.reweighting;
    residual += other.residual;
    return *this;
  }

  void state(Archive& archive) { archive(boundary, friction, drag, numerical, reweighting, residual); }
};

/// One implicit Euler step of a rod with contact and friction: find x at t + dt with
///
///   M (x - x_n - dt v_n)/dt^2 = -dE/dx + F_contact + F_friction + F_grips + M g - c lbar (x - x_n)/dt,
///
/// all of the right-hand side taken at t + dt. Where the scene solves for twist, the angles of the material frames are
/// unknowns beside x, with equations of their own (frame_terms.hpp); where it does not, they cost nothing. A step that
/// is not accepted changes nothing.
class TimeStep {
 public:
  virtual ~TimeStep() = default;

  /// `state.twist` empty: the scene does not solve for twist (three unknowns a node); else four, from the frames of
  /// the state (initialise_frames). Throws InvalidInput where rod and state do not fit together.
  static std::unique_ptr<TimeStep> make(const RodProperties& rod, const RodState& state, const StepSettings& settings);

  StepSummary step(const Boundary& boundary, double dt) { return step(boundary, dt, Solution::kTangents); }
  virtual StepSummary step(const Boundary& boundary, double dt, Solution solution) = 0;

  const RodProperties& rod() const { return rod_; }
  const RodState& state() const { return state_; }
  const StepSettings& settings() const { return settings_; }

  /// From now on `watcher` is told of every iterate; none: nobody is.
  void watch(std::function<void(const Iterate&)> watcher) { watcher_ = std::move(watcher); }

  /// Force that the step's own equations need at a fixed node: what its holder exerts on the rod [N].
  virtual Vec3 reaction(int node) const = 0;
  /// Torque about an edge's tangent that the holder of its material frame exerts on the rod [N m].
  virtual double reaction_torque(int edge) const = 0;
  /// Force of the rod on a roller [N], and its moment about the roller's centre [N m]; zero before the first accepted
  /// step.
  virtual Vec3 roller_force(int roller) const = 0;
  virtual Vec3 roller_moment(int roller) const = 0;
  virtual Energies energies() const = 0;
  virtual ContactReading contact_reading() const = 0;
  virtual StepWork work() const = 0;
  /// Tension of each edge [N].
  Eigen::VectorXd tension() const;

  /// That of the last accepted step, on which the next one depends.
  virtual void state(Archive& archive);

 protected:
  TimeStep(const RodProperties& rod, const RodState& state, const StepSettings& settings = {})
      : rod_(rod), state_(state), settings_(settings) {}

  RodProperties rod_;
  RodState state_;
  StepSettings settings_;
  std::function<void(const Iterate&)> watcher_;
};

}  // namespace knot_utm
