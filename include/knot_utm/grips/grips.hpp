#pragma once

#include <optional>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

class TimeStep;

/// A pin in a slack loop that becomes one of its rollers: while the loop is put on, it moves to the roller's place and
/// widens to the roller's radius.
struct Pin {
  Vec3 place = Vec3::Zero();  ///< where it begins [m]
  double radius = 0.0;        ///< with which it begins [m]

  void state(Archive& archive) { archive(place, radius); }
};

/// The lower and the upper pin for a loop, with axes along y, that clear its rod by `clearance` [m]. The loop lies near
/// a plane normal to y. Each pin is as wide as the loop allows, at most `widest` [m], and then as far out as it allows.
/// Empty: one half of the loop has no room.
std::vector<Pin> pins_in(const Points& loop, double widest, double clearance);

/// Moves and narrows a roller towards its pin: `left` is the fraction of the way from pin to roller that remains.
void widen(const Pin& pin, double left, Roller& roller);

/// The grips of the machine: two rollers in the loop of a fisherman's knot, or held nodes. A clamp holds two nodes and
/// the material frame between them. If fixed posts and dead loads bear the specimen's lower end, its first post is the
/// lower grip; a pin in a loop may likewise be the upper one. The lower grip stands still. The upper one moves along +z
/// by its displacement [m], that of the crosshead less the deflection of a compliant frame (frame.hpp). While a knot is
/// tied it may let ends slip along z; afterwards it holds them where they are.
class Grips {
 public:
  /// With the upper grip at displacement 0.
  Grips(const SpecimenOptions& specimen, const MachineOptions& machine, const Centreline& centreline,
        const Material& material);

  bool on_rollers() const { return !rollers_.empty(); }
  /// Whether the upper clamp can be turned: the strands that it holds leave it along the load axis.
  bool clamp_turns() const { return !turns_by_.empty(); }
  /// Turns the upper clamp in a boundary from set() about the load axis [rad]: the frames in it and, if it holds
  /// several strands, their places around the middle of them.
  void turn_clamp(double turn, Boundary& boundary) const;
  /// Torque of the upper clamp on the rod about the load axis [N m]; NaN: it cannot be turned, or the rod has no twist.
  double torque(const TimeStep& step) const;
  /// Whether frames are held at both ends, so that the rod cannot turn about itself.
  bool hold_frames() const { return held_frames_.size() > 1; }

  /// Sets rollers and posts, held nodes and frames, springs and dead loads of the boundary. While a loop is put on, the
  /// rollers are pins that widen; `left` is the fraction of that time which remains.
  void set(double displacement, double left, Boundary& boundary) const;

  /// Begins to put the loop on the rollers, which first move as near to each other as it needs. If the loop lies across
  /// the places of the rollers, as after much stretch while it was tied, they begin as pins where it leaves room.
  /// False: there is no room, or too little for the rollers.
  bool put_on(const Points& loop, double displacement, double radius);

  /// Adds the fraction `part` of the weights that hang on the rod to the boundary.
  void hang(double part, Boundary& boundary) const;
  /// To be called after an accepted step with this fraction of them.
  void follow_weights(double part) { hung_ = part; }

  /// Holds the middle of the loop's far side half-way between the rollers from now on, if the method asks for it.
  void hold_far_side(const Points& position, double displacement);

  /// Lets this end slip along z: the upper grip only guides it from now on.
  void let_slip(int node, int next);
  /// To be called after an accepted step: follows the ends that slip. `pulled_with`: sum of the forces that pull them
  /// [N].
  void follow_slipping(const Points& position, double displacement, double pulled_with);
  /// Holds the ends that slipped at their last places.
  void hold_again() { slipping_.clear(); }
  bool slips(int node) const;

  void state(Archive& archive);

  /// Ends of the specimen's length: centres of the rollers or posts, or places of held nodes [m].
  Vec3 lower() const;
  Vec3 upper(double displacement) const;
  /// Distance between lower and upper [m].
  double end_to_end(double displacement) const;

  /// Length of rod that moves with the upper grip: half a turn around a roller or pin, or the length that it holds [m].
  double length_moved(double radius) const;

  /// Whether a grip holds this point of the rod's centreline: it lies on a roller, or within two radii of a held node.
  bool hold(double displacement, const Vec3& point, double radius) const;

  /// Force of the rod on each grip along z, tension positive [N]. The force on the upper grip includes its pins and the
  /// forces on ends that slip in it; that on the lower grip includes all posts, dead loads and weights.
  double force_upper(const TimeStep& step) const;
  double tried_force_upper(const TimeStep& step) const;  ///< of the step that is judged (TimeStep::refuse_by)
  double force_lower(const TimeStep& step) const;

 private:
  bool on_posts() const { return lower_nodes_.empty() && !supports_.posts.empty(); }
  bool on_pins() const { return upper_nodes_.empty() && !supports_.pins.empty(); }
  template <typename RollerForce, typename Reaction>
  double sum_upper(double pulled_with, RollerForce roller_force, Reaction reaction) const;
  double half_way(double displacement) const;
  void narrow(double left, std::vector<Roller>& rollers) const;
  bool comes_near(const Points& loop, double displacement, double radius);
  bool put_on_pins(const Points& loop, double displacement, double radius);

  double narrower_ = 0.0;     // radius of the loop on the rollers, less that of the sketch [m]
  double clearance_ = 0.0;    // by which pins are narrower than the loop allows [m]
  double length_held_ = 0.0;  // length of rod in the upper grip [m]
  double lift_ = 0.0;         // by which the lower roller begins higher [m]
  std::vector<Pin> pins_;     // lower, upper; empty: the rollers' own places are free
  std::vector<FixedNode> lower_nodes_, upper_nodes_;
  std::vector<int> slipping_;            // nodes that the upper grip only guides
  Mat3 guides_ = Mat3::Zero();           // stiffness [N/m]
  double pulled_with_ = 0.0;             // force on ends that slip, in the last accepted step [N]
  std::vector<FixedTwist> held_frames_;  // those of the upper clamp come last
  std::vector<double>
      turns_by_;  // 1 or -1 for each of its edges, which points up or down; empty: it is not to be turned
  Vec3 turns_around_ = Vec3::Zero();  // middle of its strands, at displacement 0 [m]
  std::vector<Roller> rollers_;       // lower, upper
  Supports supports_;
  std::vector<NodeForce> weights_;
  double hung_ = 0.0;                   // fraction of the weights in the last accepted step
  std::vector<SpringHold> far_middle_;  // keep the loop from turning on the rollers; relative to half-way
  bool holds_far_side_ = false;
};

struct Material;

/// A body that holds or bears the specimen, for pictures: a cylinder stands for a roller, a post or a piece of a ring,
/// a block for a clamp or a held node.
struct GripBody {
  bool goes_up = false;           ///< moves with the upper grip; else it stands still
  Vec3 from_grip = Vec3::Zero();  ///< place of its middle relative to the middle of its grip [m]
  double cylinder_radius = 0.0;   ///< 0: a block [m]
  Vec3 axis = Vec3::UnitY();      ///< of a cylinder
  Vec3 half_box(double h) const;  ///< half the edges of its bounding box beside a rod of radius h [m]
  double piece = 0.0;             ///< length, of a piece of a ring; 0: it is none [m]
  /// Half the length of a cylinder in a picture [m].
  double half_length(double h) const { return piece > 0.0 ? 0.5 * piece : 6.0 * h; }
};

/// The lower grip, the upper one, then all posts that are no grips, and the other pieces of rings.
std::vector<GripBody> grip_bodies(const SpecimenOptions& specimen, const MachineOptions& machine,
                                  const Material& material);

}  // namespace knot_utm
