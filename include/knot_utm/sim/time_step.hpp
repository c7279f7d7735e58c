#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/step_readings.hpp"
#include "knot_utm/solver/newton.hpp"

namespace knot_utm {

/// Where the solution of a step that was not accepted failed: the node with the largest residual or, where Newton's
/// method converged, the one that moved the furthest; and the deepest contact of that node.
struct StepDiagnosis {
  int node = -1;                      ///< -1: none
  double arclength = 0.0;             ///< of the node, at rest [m]
  double residual = 0.0;              ///< of the node, divided by its tolerance scaling (scene.hpp) [N]
  double motion = 0.0;                ///< of the node in this step [m]
  bool in_contact = false;            ///< the members below are valid
  int roller = -1;                    ///< that it touches; -1: a strand
  double contact_arclengths[2] = {};  ///< of the two strands; on a roller the first only [m]
  double overlap = 0.0;               ///< [m]
  bool slides = false;                ///< friction is saturated there

  /// One line.
  std::string text() const;
};

/// How the increment of a time step is solved. kTangents is Newton's method with tangents. kTangentsAbandonedEarly uses
/// predicted tensions and pressures, and is abandoned early where a shorter step costs less. kSecants, for iterates
/// that run in a cycle, linearises friction by secants and, from there, by tangents; if that fails, secants are tried
/// again with each change halved, up to three times. The equations and their tolerance are the same in all of them.
enum class SolveStrategy { kTangents, kTangentsAbandonedEarly, kSecants };

/// How one time step went.
struct StepSummary {
  NewtonSummary newton;
  int by_half = 0;  ///< iterations that solved one half of a rod that is symmetric (StepSettings::half_turn)
  double largest_motion = 0.0;   ///< of a node [m]
  double largest_slip = 0.0;     ///< of the two points of a contact, touching or nearly, against each other [m]
  double largest_overlap = 0.0;  ///< of two strands, or of strand and roller [m]
  std::string reason;            ///< why it was not accepted; empty: it was
  StepDiagnosis diagnosis;       ///< of one that was not

  bool accepted() const { return reason.empty(); }
};

/// One implicit Euler step of a rod with contact and friction: find x at t + dt with
///
///   M (x - x_n - dt v_n)/dt^2 = -dE/dx + F_contact + F_friction + F_grips + M g - c lbar (x - x_n)/dt,
///
/// with the whole right-hand side taken at t + dt (backward Euler). Where the scene solves for twist, the angles of the
/// material frames are further unknowns with equations of their own (frame_terms.hpp). A step that is not accepted
/// changes nothing. Source: Hairer, Wanner 1996 (backward Euler method).
class TimeStep {
 public:
  virtual ~TimeStep() = default;

  /// `state.twist` empty: the scene does not solve for twist (three unknowns a node); else four, from the frames of the
  /// state (initialise_frames).
  static std::unique_ptr<TimeStep> make(const RodProperties& rod, const RodState& state, const StepSettings& settings);

  StepSummary step(const Boundary& boundary, double dt) { return step(boundary, dt, SolveStrategy::kTangents); }
  virtual StepSummary step(const Boundary& boundary, double dt, SolveStrategy strategy) = 0;

  /// Between two steps the edges of a rod of one material, without cuts, get these rest lengths [m], and its nodes
  /// these places, as if it were drawn so. Contacts still count arclengths and lengths as they were when the step was
  /// made. Stretching energy that this stores or frees goes to the next step's `StepWork::numerical`.
  void lay(const Eigen::VectorXd& rest_length, const Points& position);

  const RodProperties& rod() const { return rod_; }
  const RodState& state() const { return state_; }
  const StepSettings& settings() const { return settings_; }

  // They take effect in the next step and change `settings`, and are not saved by `state`.
  void set_gravity(const Vec3& gravity) { settings_.gravity = gravity; }  ///< g [m/s^2]
  void set_drag(double per_length) { settings_.drag = per_length; }       ///< c [N s/m^2]

  /// From now on the whole rod is solved, also where one half has stood for both (StepSettings::half_turn).
  virtual void solve_whole() {}

  /// From now on a step that was solved is refused, and changes nothing, where `judge` returns a reason for the
  /// positions and the length [s] that it would have.
  void refuse_by(std::function<std::string(const Points& end, double dt)> judge) { judge_ = std::move(judge); }

  // While `judge` is asked: what the solved step would have a node's holder, and a roller, bear [N].
  virtual Vec3 tried_reaction(int node) const = 0;
  virtual Vec3 tried_roller_force(int roller) const = 0;

  /// What the last accepted step did to everything around the rod, and where its work went.
  virtual const StepReadings& readings() const = 0;
  /// Tension of each edge [N].
  Eigen::VectorXd tension() const;

  /// Saves or loads the state after the last accepted step, on which the next one depends.
  virtual void state(Archive& archive);

 protected:
  TimeStep(const RodProperties& rod, const RodState& state, const StepSettings& settings = {})
      : rod_(rod), state_(state), settings_(settings), made_with_(rod) {}

  void set_lengths(const Eigen::VectorXd& rest_length);
  /// Takes the lengths of the rod anew.
  virtual void take_lengths() = 0;

  RodProperties rod_;
  RodState state_;
  StepSettings settings_;
  RodProperties made_with_;
  std::function<std::string(const Points& end, double dt)> judge_;
};

}  // namespace knot_utm
