#pragma once

#include <optional>
#include <vector>

#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/half_turn.hpp"
#include "knot_utm/sim/options.hpp"

namespace knot_utm {

/// A node held at a place.
struct FixedNode {
  int node = 0;
  Vec3 position = Vec3::Zero();  ///< at the end of the step [m]
};

/// An edge whose material frame is held (only where the scene solves for twist).
struct FixedTwist {
  int edge = 0;
  double angle = 0.0;  ///< theta at the end of the step [rad]
};

struct NodeForce {
  int node = 0;
  Vec3 force = Vec3::Zero();  ///< [N]
};

/// A grip that pulls a node along a fixed direction by a spring, bears tension only, and slips at a set force:
///   f = min(max(k (X - x.d), 0), F_p) d.
/// Across d the node is free.
struct SlippingGrip {
  int node = 0;
  Vec3 direction = Vec3::UnitZ();  ///< d, unit
  double place = 0.0;              ///< X at the end of the step, along d [m]
  double stiffness = 2e4;          ///< k [N/m]
  double slip_force = 0.0;         ///< F_p [N]

  double force(const Vec3& node_position) const {
    const double stretched = stiffness * (place - direction.dot(node_position));
    return stretched < 0.0 ? 0.0 : (stretched > slip_force ? slip_force : stretched);
  }
  bool slips(const Vec3& node_position) const {
    return stiffness * (place - direction.dot(node_position)) >= slip_force;
  }
};

/// A spring that holds a node at a place, with a stiffness that may depend on the direction:
///   f = -K (x - X).
struct SpringHold {
  int node = 0;
  Vec3 place = Vec3::Zero();      ///< X at the end of the step [m]
  Mat3 stiffness = Mat3::Zero();  ///< K, symmetric, positive semidefinite [N/m]

  Vec3 force(const Vec3& node_position) const { return stiffness * (place - node_position); }
};

/// Everything outside the rod, as it stands at the end of a step.
struct Boundary {
  std::vector<Roller> rollers;
  std::vector<FixedNode> fixed_nodes;
  std::vector<FixedTwist> fixed_twists;
  std::vector<NodeForce> forces;
  std::vector<SlippingGrip> grips;
  std::vector<SpringHold> holds;
  double extra_drag = 0.0;  ///< in addition to StepSettings::drag [N s/m^2]
};

/// What a time step needs to know besides rod and boundary; constant during a run.
struct StepSettings {
  NormalLaw pressure_law;  ///< between strands, and on rollers
  Friction friction;       ///< between strands
  Friction roller_friction;
  /// Laws of the ropes behind the first one, where they are of another material (RodProperties::other_material): with
  /// the first one, among themselves, and on rollers.
  struct OtherLaws {
    PairLaws between, own, on_rollers;
    RollingResistance rolling_between, rolling_own;  ///< the latter on rollers, too
  };
  std::optional<OtherLaws> others;
  double friction_couple = 0.0;  ///< 1: friction acts at the surfaces (surface_contact.hpp); 0: on the centrelines [-]
  RollingResistance rolling;     ///< of the first rope's contacts; only where friction acts at the surfaces
  double weighting_time = 0.05;  ///< relaxation time of weighting factors (smooth_contact.hpp) [s]
  Vec3 gravity = Vec3::Zero();   ///< g [m/s^2]
  double drag = 0.0;             ///< c, force -c v per length [N s/m^2]
  bool spin_inertia = true;      ///< spin has inertia and drag (frame_terms.hpp)
  double residual = 0.0;         ///< tolerance of a node's residual [N]
  double residual_from_step = 0.0;          ///< in shorter steps it falls with their square, down to a thousandth [s]
  double residual_of_tension = 0.0;         ///< tolerance scaling: more by this fraction of the node's tension [-]
  double residual_at_little_tension = 0.0;  ///< small tension: tolerance at most this times the largest; 0: any [-]
  double newton_cap = 0.0;                  ///< longest movement of a node in one Newton iteration [m]
  double motion_limit = 0.0;                ///< longest movement of a node in one step [m]
  double overlap_limit = 0.0;               ///< deepest overlap of a step that may be accepted [m]
  double candidate_margin = 0.0;            ///< of the contact search [m]
  int max_iterations = 20;
  /// The half-turn that maps the rod onto itself as it begins. As long as it does, one half is solved at half the cost
  /// (half_rod.hpp). Empty: the whole rod is solved.
  std::optional<HalfTurn> half_turn;
};

}  // namespace knot_utm
