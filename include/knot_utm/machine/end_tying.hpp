#pragma once

#include <string>
#include <vector>

#include "knot_utm/machine/grips.hpp"
#include "knot_utm/machine/tying.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/rest_watch.hpp"
#include "knot_utm/specimen/settling.hpp"
#include "knot_utm/specimen/tail_grips.hpp"

namespace knot_utm {

struct Material;

/// Ties a knot between the machine's grips by pulling at its ends, as a drawing says (Centreline::tied). The drawn
/// shape first settles under a strong drag that fades. Then each group of ends is pulled in turn by grips that move at
/// a set speed and slip at their part of the pre-load: free ends outwards as they were drawn, and those of the upper
/// grip, which lets them slip from then on, along z. The lower grip stands still. Earlier groups are held at their
/// part, or pulled again to another. A group's turn ends once all of them slip and everything is at rest. A knot
/// without an end to pull at only settles, and the crosshead pulls it tight.
///
/// Release: all these loads go to zero linearly, and everything comes to rest; then the upper grip holds its ends where
/// they are. Where the program pulls a knot that it did not release, the upper grip holds them at once, and the loads
/// of the free ends go to zero within a third of a second.
class EndTying final : public Tying {
 public:
  /// `preload`: F_p [N]. `rest_speed`: slower than this a node is at rest [m/s]. `stepper` and `grips` must outlive
  /// this object.
  EndTying(const Centreline& centreline, const Material& material, double preload, double rest_speed,
           const TimeStep& stepper, Grips& grips);

  void enter(const Command& command, const Place& now) override;
  void follow(Phase phase, const Place& now, double dt) override;
  void hold(Boundary& boundary, double from, double to) const override;
  double extra_drag(double to) const override;
  /// All that hangs on the rod is borne little by little as the knot is let go.
  double weight_borne(double time) const override;
  double held_length(double, double) const override { return grips_.end_to_end(0.0); }
  bool done(Phase phase) const override;
  const std::string& gave_up() const override { return not_tied_; }
  const std::string& not_equilibrated() const override { return rest_.not_equilibrated(); }
  void state(Archive& archive) override;

 private:
  enum class Stage { kIdle, kSettling, kPulling, kTied, kRamp, kRest, kFree };

  void enter(Stage stage, double time);
  void add(const PulledEnd& end);
  void pull_next_group(double time);
  double load(std::size_t grip, double time) const;
  void follow_slipping(const Place& now);
  double held_with(const PulledEnd& end) const;
  void let_go(double duration, double time);

  const TimeStep& stepper_;
  Grips& grips_;
  std::vector<std::vector<PulledEnd>> groups_;
  double preload_, radius_;
  Settling settling_;
  TailGrips pulling_;
  std::size_t pulled_groups_ = 0;
  RestWatch rest_;
  Stage stage_ = Stage::kIdle;
  double speed_ = 0.0, ramp_time_ = 1.0, stage_begin_ = 0.0;
  std::vector<double> ramp_from_;  // loads of the grips as they are let go [N]
  std::string not_tied_;
};

}  // namespace knot_utm
