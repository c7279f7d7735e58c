#pragma once

#include <string>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/tying/tail_grips.hpp"

namespace knot_utm {

/// Ties the overhands of a loop off the rollers (doc/model.md, section 9): holds the standing part and the threaded
/// strand of each, and pulls its tail outwards by a grip that slips at the pre-load (TailGrips). Before, the sketched
/// shape settles. The loop is held by the straight part of its far side; its half circles and the side with the knots
/// are free. The clamps stand at set distances from the knots, on straight strands.
///
/// Release: the tails' pull goes to zero linearly and everything comes to rest; then the same with the reactions of the
/// clamps. Guides stay on the strands beyond the knots, which can then move along themselves only. If rest does not
/// come in time, the test goes on (RestWatch). Letting go, if the program pulls without a release: both go to zero
/// together and within a third of a second, without waiting for rest.
///
/// Putting on: within a third of a second the rollers take the loop while the far side is let go. The tails lie beside
/// the rollers. The guides stay until the slack is taken up; without them a slack strand that bends around a roller
/// would move a knot near it.
class TyingRig {
 public:
  struct Options {
    double preload = 0.0;         ///< F_p, at which the tail grips slip [N]
    double grip_stiffness = 2e4;  ///< [N/m]
    RestWatch::Options rest;
    TailGrips::Patience patience;
  };
  /// The end of a ramp leads to the next stage of this list, the end of kLettingGo to kReleased.
  enum class Stage {
    kIdle,
    kSettling,
    kPulling,
    kTied,
    kTailsRamp,
    kTailsRest,
    kClampsRamp,
    kClampsRest,
    kReleased,
    kLettingGo,
    kPuttingOn,
    kGuided,
    kGuidesRamp,
    kFree
  };

  TyingRig(const Centreline& centreline, const RodProperties& rod, const Options& options);

  void tie(double speed, double time, const Points& position);
  void release(double duration, double time);
  void let_go(const TimeStep& stepper, double time);
  void put_on(const TimeStep& stepper, double time);
  void take_guides_off(const TimeStep& stepper, double time);

  double extra_drag(double to) const;  ///< in a step until this time [N s/m^2]

  /// Adds its clamps and grips at time `to` to the boundary of a step from time `from` [s].
  void hold(Boundary& boundary, double from, double to) const;

  /// Follows an accepted step: lets grips slip, judges rest, goes on to the next stage.
  void follow(const TimeStep& stepper, double time, double dt);

  Stage stage() const { return stage_; }
  bool tied() const { return stage_ == Stage::kTied; }
  bool released() const { return stage_ == Stage::kReleased; }
  bool puts_on() const { return stage_ == Stage::kPuttingOn; }
  bool guides() const { return stage_ == Stage::kGuided; }
  /// Whether the loop is still off the rollers.
  bool off_rollers() const { return stage_ != Stage::kIdle && stage_ < Stage::kPuttingOn; }
  /// Whether the rollers have it, or begin to take it.
  bool has_been_put_on() const { return stage_ >= Stage::kPuttingOn; }
  /// Message about what had not come to rest when the test went on; empty: nothing.
  const std::string& not_equilibrated() const { return rest_.not_equilibrated(); }
  /// Why the knots cannot be tied; empty: they can.
  const std::string& not_tied() const { return not_tied_; }

  /// A rod with other lengths of its straight strands.
  struct Laid {
    Eigen::VectorXd rest_length;  ///< [m]
    Points position;              ///< [m]
  };
  /// The loop with both strands between the knots longer by `apart` and the rod beyond the knots longer by `beyond`
  /// [m]; negative: shorter, as far as the edges allow. Only edges that run straight, or around the rollers, change.
  /// The knots and their tails move along z as they are, and the rod beyond them along itself, so that little is
  /// stretched.
  Laid longer(double apart, double beyond, const RodProperties& rod, const RodState& state) const;

  /// Fraction of the time of putting the loop on that is left.
  double left_to_put_on(double time) const;

  /// Nodes between the tails, once the loop is put on.
  int loop_begin() const { return loop_begin_; }
  int loop_end() const { return loop_end_; }

  /// Node in the standing part of each knot, in the order of the centreline's knots.
  std::vector<int> standing_nodes() const;

  double tail_force(int knot) const { return tail_force_[static_cast<std::size_t>(knot)]; }  ///< [N]

  /// Excess length of a knot [m]: length of rod from the clamp of its standing part to the end of its tail, less the
  /// distance of both.
  double excess_length(int knot, const RodState& state) const;
  /// Middle of a knot: the centroid of the bending energy of its own strand, from standing part to tail.
  Vec3 knot_middle(int knot, const RodProperties& rod, const RodState& state) const;

  void state(Archive& archive);

 private:
  struct Clamp {
    int node;
    Vec3 position;
    Vec3 reaction;
    bool guides;  // becomes a guide once the knot is released
  };
  struct Knot {
    Vec3 outwards;
    int tail_node;
    int standing_node;
    double reach;  ///< largest reach outwards from its middle once it is tight [m]
  };
  void attach_grips();
  /// From the outermost guide at the second knot to the outermost one at the first.
  NodeRange beyond_knots() const;
  /// The outermost node of a knot from which its tail runs on.
  int tail_begin(int knot, const TimeStep& stepper) const;
  SpringHold guide(const Clamp& clamp) const;
  void hold_knots(Boundary& boundary, double ramp) const;
  void enter(Stage stage, double time);

  Options options_;
  double radius_;         // h [m]
  double shortest_edge_;  // least length of an edge after longer() [m]
  Settling settling_;
  double putting_on_drag_;  // [N s/m^2]
  std::vector<Knot> knots_;
  std::vector<Clamp> clamps_;
  std::vector<Clamp> far_side_;
  int loop_begin_ = 0, loop_end_ = 0;
  TailGrips grips_;
  RestWatch rest_;
  std::vector<double> tail_force_;
  std::vector<double> ramp_from_;
  Stage stage_ = Stage::kIdle;
  double speed_ = 0.0, ramp_time_ = 1.0, stage_begin_ = 0.0;
  std::string not_tied_;
};

}  // namespace knot_utm
