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

/// Two pins along y, the lower and the upper one, that stand in the loop and clear its rod by `clearance` [m]. The loop
/// lies about the plane across y. Each pin is as wide as the loop allows, but no wider than `widest` [m], and as far
/// out. Empty: there is no room in one half of the loop.
std::vector<Pin> pins_in(const Points& loop, double widest, double clearance);

/// Gives a roller the place and the radius of its pin while the fraction `left` of the way from one to the other
/// remains.
void widen(const Pin& pin, double left, Roller& roller);

/// The grips of the machine: two rollers in the loop of a fisherman's knot, or held nodes. A clamp holds two nodes and
/// the material frame between them. Where fixed posts and dead loads bear the specimen's lower end, its first post is
/// the lower grip, and a pin in a loop may be the upper one. The lower grip stands still. The upper one moves along +z
/// by its displacement [m], which is that of the crosshead less the deflection of a compliant frame (frame.hpp). It may
/// let ends slip along z while a knot is tied, and then holds them where they are.
class Grips {
 public:
  /// At displacement 0.
  Grips(const SpecimenOptions& specimen, const MachineOptions& machine, const Centreline& centreline,
        const Material& material);

  bool on_rollers() const { return !rollers_.empty(); }
  /// Whether the upper clamp can be turned: the strands that it holds leave it along the load axis.
  bool clamp_turns() const { return !turns_by_.empty(); }
  /// Turns that clamp about the load axis, to which set() left it unturned [rad]: the frames in it, and where it holds
  /// several strands their places around the middle of them.
  void turn_clamp(double turn, Boundary& boundary) const;
  /// Torque of this clamp on the rod about that axis [N m]; NaN where it cannot be turned, or the rod has no twist.
  double torque(const TimeStep& step) const;
  /// Whether frames are held at both ends, so that the rod cannot turn about itself.
  bool hold_frames() const { return held_frames_.size() > 1; }

  /// Sets rollers and posts, held nodes and frames, holds and dead loads of the boundary. While the loop is put on, of
  /// which the fraction `left` remains, the rollers are pins that widen.
  void set(double displacement, double left, Boundary& boundary) const;

  /// Puts the loop, which was off the rollers until now, on them. They first come as near to each other as the loop
  /// needs. A loop that lies across the rollers' places, as one that was much stretched while it was tied, is put on
  /// over pins that begin where it leaves room. False: it leaves none, or too little for the rollers.
  bool put_on(const Points& loop, double displacement, double radius);

  /// Adds the weights that hang on the rod, `part` of each, to the boundary.
  void hang(double part, Boundary& boundary) const;
  /// After an accepted step that had this part of them.
  void follow_weights(double part) { hung_ = part; }

  /// From now on the middle of the loop's far side is held half-way between the rollers, if the method says so.
  void hold_far_side(const Points& position, double displacement);

  /// The upper grip only guides this end from now on, so that it slips along z.
  void let_slip(int node, int next);
  /// After an accepted step: where the ends that slip are, and what something else pulls them with [N].
  void follow_slipping(const Points& position, double displacement, double pulled_with);
  /// Holds what slipped where it was last.
  void hold_again() { slipping_.clear(); }
  bool slips(int node) const;

  void state(Archive& archive);

  /// Centres of the rollers or of the post, or places of the held nodes: the ends of the specimen's length [m].
  Vec3 lower() const;
  Vec3 upper(double displacement) const;
  /// Distance of these [m].
  double end_to_end(double displacement) const;

  /// Length of rod that moves with the upper grip: half a turn around a roller or a pin, or what is held [m].
  double length_moved(double radius) const;

  /// Whether a point of the rod's centreline lies on a roller, or within two radii of a node that is held.
  bool hold(double displacement, const Vec3& point, double radius) const;

  /// Force of the rod on each grip along z, tension positive [N]. That on the upper grip includes its pins and what
  /// pulls ends that slip in it, that on the lower grip all posts, dead loads and weights.
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

  double narrower_ = 0.0;     // how much narrower than on the rollers the loop was sketched [m]
  double clearance_ = 0.0;    // of narrower pins in the loop [m]
  double length_held_ = 0.0;  // by the upper grip [m]
  double lift_ = 0.0;         // of the lower one while the loop is put on [m]
  std::vector<Pin> pins_;     // lower, upper; empty: the rollers' own places are free
  std::vector<FixedNode> lower_nodes_, upper_nodes_;
  std::vector<int> slipping_;            // upper ones that are guided only
  Mat3 guides_ = Mat3::Zero();           // stiffness [N/m]
  double pulled_with_ = 0.0;             // what slips, in the last accepted step [N]
  std::vector<FixedTwist> held_frames_;  // the last ones those of the upper clamp
  std::vector<double> turns_by_;         // 1 or -1, as its edges point up or down; empty: it is not to be turned
  Vec3 turns_around_ = Vec3::Zero();     // the middle of its strands, at displacement 0
  std::vector<Roller> rollers_;          // lower, upper
  Supports supports_;
  std::vector<NodeForce> weights_;
  double hung_ = 0.0;                     // part of them in the last accepted step
  std::optional<SpringHold> far_middle_;  // keeps the loop from turning on the rollers; relative to half-way
  bool holds_far_side_ = false;
};

struct Material;

/// A body that holds or bears the specimen, for pictures: a cylinder for a roller, a post or a piece of a ring, a block
/// for a clamp or another holder of a node.
struct GripBody {
  bool goes_up = false;           ///< moves with the upper grip; else it stands still
  Vec3 from_grip = Vec3::Zero();  ///< of its middle, from the middle of the upper grip, or of the lower one [m]
  double cylinder_radius = 0.0;   ///< 0: a block [m]
  Vec3 axis = Vec3::UnitY();      ///< of a cylinder
  Vec3 half_box(double h) const;  ///< half the edges of its bounding box beside a rod of radius h [m]
  double piece = 0.0;             ///< length of a cylinder that is a piece of a ring; 0: of another one [m]
  /// Half the length with which a cylinder is drawn [m].
  double half_length(double h) const { return piece > 0.0 ? 0.5 * piece : 6.0 * h; }
};

/// The lower grip first, then the upper one, then posts other than those that are grips, and the other pieces of rings.
std::vector<GripBody> grip_bodies(const SpecimenOptions& specimen, const MachineOptions& machine,
                                  const Material& material);

}  // namespace knot_utm
