#pragma once

#include <optional>
#include <vector>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// Whether two rollers hold it, as they do a loop; else nodes are held, by clamps together with their neighbours.
bool rollers_hold(const SpecimenOptions& specimen, const MachineOptions& machine);
bool clamps_hold(const SpecimenOptions& specimen, const MachineOptions& machine);

/// What the machine holds the specimen by: two rollers in the loop of a fisherman's knot, or nodes, which clamps hold
/// two by two with their material frames. Where fixed posts and dead loads bear the specimen's lower end, its first
/// post is the lower grip. The lower grip stands; the upper one moves along +z by its displacement [m]: the
/// crosshead's, less what a compliant frame gives (frame.hpp).
class Grips {
 public:
  /// At displacement 0.
  Grips(const SpecimenOptions& specimen, const MachineOptions& machine, const Centreline& centreline,
        const Material& material);

  bool on_rollers() const { return !rollers_.empty(); }
  /// At both ends, so that the rod cannot turn about itself.
  bool hold_frames() const { return held_frames_.size() > 1; }

  /// Rollers and posts, held nodes and held frames, holds and dead loads of the boundary.
  /// While the loop is put on, by the fraction of this that is `left`, the rollers are pins that widen.
  void set(double displacement, double left, Boundary& boundary) const;

  /// The loop, off the rollers until now, is put on them: they come nearer to each other as far as it asks for.
  void put_on(const Points& loop, double displacement, double radius);

  /// From now on the middle of the loop's far side keeps its place between the rollers, where it is to be held.
  void hold_far_side(const Points& position, double displacement);

  /// Rollers that are driven turn from the first of these times on [s].
  void turn_rollers_from(double time);
  void turn_rollers(double time, std::vector<Roller>& rollers) const;

  void state(Archive& archive);

  /// Centres of rollers or of the post, or places of the nodes between which the specimen's length counts [m].
  Vec3 lower() const;
  Vec3 upper(double displacement) const;
  /// How far these are apart [m].
  double end_to_end(double displacement) const;

  /// Of the rod around a roller, half of it; 0 where nodes are held [m].
  double length_around(double radius) const;

  /// Whether a point of the rod's centreline lies on a roller, or within two radii of a node that is held.
  bool hold(double displacement, const Vec3& point, double radius) const;

  /// Force of the rod on each grip along z, tension positive [N]. On the lower one it is that on all posts and dead
  /// loads.
  double force_upper(const TimeStep& step) const;
  double force_lower(const TimeStep& step) const;

 private:
  bool on_posts() const { return !supports_.posts.empty(); }
  double half_way(double displacement) const;
  void narrow(double left, std::vector<Roller>& rollers) const;

  double narrower_ = 0.0;   // than the rollers, by which the loop was drawn [m]
  double clearance_ = 0.0;  // of narrower pins in the loop [m]
  double lift_ = 0.0;       // of the lower one while the loop is put on [m]
  std::vector<FixedNode> lower_nodes_, upper_nodes_;
  std::vector<FixedTwist> held_frames_;
  std::vector<Roller> rollers_;  // lower, upper
  Supports supports_;
  double roller_rate_ = 0.0;              // of driven ones [rad/s]
  std::optional<double> turning_from_;    // [s]
  std::optional<SpringHold> far_middle_;  // keeps the loop from going round on the rollers; from half-way
  bool holds_far_side_ = false;
};

}  // namespace knot_utm
