#include "knot_utm/tying/tying.hpp"

#include <algorithm>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/tying/tail_grips.hpp"
#include "knot_utm/tying/tied_loop.hpp"

namespace knot_utm {
namespace {

/// Ties a knot between the machine's grips by pulling at its ends, in the groups of its drawing
/// (Centreline::pull_groups). The sketched shape first settles under a strong drag that fades. Then each group is
/// pulled in turn by grips that move at a set speed and slip at their fraction of the pre-load: free ends outwards as
/// sketched; ends in the upper grip along z, and that grip only guides them from then on. The lower grip stands still.
/// Earlier groups stay at their load, unless a later group pulls at the same end with another one. A group is done once
/// all grips slip and everything is at rest. A knot without an end to pull at only settles, and the crosshead tightens
/// it.
///
/// Release: all loads go to zero linearly, and everything comes to rest; then the upper grip holds its ends where they
/// are. If the program pulls a knot without a release, the upper grip holds them at once, and the loads of the free
/// ends go to zero within a third of a second.
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
  /// Weights are put on gradually as the knot is let go.
  double weight_borne(double time) const override;
  double held_length(double, double) const override { return grips_.end_to_end(0.0); }
  bool done(Phase phase) const override;
  const std::string& gave_up() const override { return not_tied_; }
  const std::string& not_equilibrated() const override { return rest_.not_equilibrated(); }
  void state(Archive& archive) override;

 private:
  static constexpr double kGripStretch = 2.4;      // of a grip when it slips [h]
  static constexpr double kLetGoTime = 1.0 / 3.0;  // [s]

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

EndTying::EndTying(const Centreline& centreline, const Material& material, double preload, double rest_speed,
                   const TimeStep& stepper, Grips& grips)
    : stepper_(stepper),
      grips_(grips),
      groups_(centreline.pull_groups),
      preload_(preload),
      radius_(thickest(material)),
      settling_(material),
      rest_({rest_speed}) {}

void EndTying::enter(Stage stage, double time) {
  stage_ = stage;
  stage_begin_ = time;
  rest_.begin();
}

void EndTying::enter(const Command& command, const Place& now) {
  if (command.phase == Phase::kTie) {
    speed_ = command.speed;
    enter(Stage::kSettling, now.time);
  } else if (stage_ == Stage::kTied) {
    if (command.phase == Phase::kRelease) return let_go(command.duration, now.time);
    let_go(kLetGoTime, now.time);
    for (std::size_t i = 0; i < pulling_.size(); ++i)
      if (grips_.slips(pulling_.grip(i).node)) ramp_from_[i] = 0.0;
    grips_.hold_again();
  }
}

void EndTying::add(const PulledEnd& end) {
  const double load = end.fraction * preload_;
  pulling_.add(end.node, end.direction, load / (kGripStretch * radius_), load);
}

/// Without a next group the knot is tied. A grip begins with the force that the upper grip had on its end.
void EndTying::pull_next_group(double time) {
  if (pulled_groups_ == groups_.size()) return enter(Stage::kTied, time);
  const Points& x = stepper_.state().position;
  for (const PulledEnd& end : groups_[pulled_groups_]) {
    const double before = pulling_.force_at(end.node, x) + held_with(end);
    add(end);
    pulling_.begin_with(end.node, before, x);
    if (end.held()) grips_.let_slip(end.node, end.held_next);
  }
  ++pulled_groups_;
  pulling_.begin_pull();
  enter(Stage::kPulling, time);
}

/// Force of the upper grip on an end that it holds, outwards [N].
double EndTying::held_with(const PulledEnd& end) const {
  if (!end.held()) return 0.0;
  const StepReadings& readings = stepper_.readings();
  return std::max(0.0, readings.reaction(end.node)[2] + readings.reaction(end.held_next)[2]);
}

/// Load of a grip as it pulls or is let go [N].
double EndTying::load(std::size_t grip, double time) const {
  if (stage_ == Stage::kRamp) return std::clamp(1.0 - (time - stage_begin_) / ramp_time_, 0.0, 1.0) * ramp_from_[grip];
  const bool pulls = stage_ == Stage::kPulling || stage_ == Stage::kTied;
  return pulls ? pulling_.force(grip, stepper_.state().position) : 0.0;
}

double EndTying::weight_borne(double time) const {
  if (stage_ == Stage::kRamp) return std::clamp((time - stage_begin_) / ramp_time_, 0.0, 1.0);
  return stage_ == Stage::kRest || stage_ == Stage::kFree ? 1.0 : 0.0;
}

void EndTying::follow_slipping(const Place& now) {
  double sum = 0.0;
  for (std::size_t i = 0; i < pulling_.size(); ++i)
    if (grips_.slips(pulling_.grip(i).node)) sum += load(i, now.time);
  grips_.follow_slipping(stepper_.state().position, now.grip, sum);
}

void EndTying::let_go(double duration, double time) {
  ramp_time_ = duration;
  ramp_from_.clear();
  for (std::size_t i = 0; i < pulling_.size(); ++i) ramp_from_.push_back(pulling_.force(i, stepper_.state().position));
  enter(Stage::kRamp, time);
}

double EndTying::extra_drag(double to) const {
  return stage_ == Stage::kSettling ? settling_.drag(to - stage_begin_) : 0.0;
}

void EndTying::hold(Boundary& boundary, double from, double to) const {
  if (stage_ == Stage::kPulling || stage_ == Stage::kTied)
    pulling_.add_to(boundary, stage_ == Stage::kPulling ? speed_ * (to - from) : 0.0);
  if (stage_ != Stage::kRamp) return;
  for (std::size_t i = 0; i < pulling_.size(); ++i)
    boundary.forces.push_back({pulling_.grip(i).node, load(i, to) * pulling_.grip(i).direction});
}

void EndTying::follow(Phase, const Place& now, double dt) {
  const Points& x = stepper_.state().position;
  const double time = now.time, elapsed = time - stage_begin_;
  rest_.follow(stepper_.state().velocity, dt);
  switch (stage_) {
    case Stage::kSettling:
      if (Settling::over(elapsed)) pull_next_group(time);
      break;
    case Stage::kPulling:
      pulling_.move(x, speed_ * dt);
      if (pulling_.pull_is_over(x, time, rest_)) {
        pull_next_group(time);
        break;
      }
      not_tied_ = pulling_.lost_patience({}, x, elapsed, speed_ * elapsed / radius_);
      break;
    case Stage::kRamp:
      if (elapsed >= ramp_time_) enter(Stage::kRest, time);
      break;
    case Stage::kRest:
      if (!rest_.waited(time, stage_begin_, "the ends were released")) break;
      grips_.hold_again();
      enter(Stage::kFree, time);
      break;
    case Stage::kIdle:
    case Stage::kTied:
    case Stage::kFree:
      break;
  }
  follow_slipping(now);
}

bool EndTying::done(Phase phase) const {
  return phase == Phase::kTie ? stage_ == Stage::kTied : stage_ == Stage::kFree;
}

void EndTying::state(Archive& archive) {
  archive.section("ENDU");  // "ENDT" had itself when the grips slipped
  archive.choice("stage of tying", stage_, Stage::kFree);
  int groups = static_cast<int>(pulled_groups_);
  archive.number("groups of pulled ends", groups, 0, static_cast<int>(groups_.size()));
  if (archive.loads()) {
    pulling_.clear();
    pulled_groups_ = static_cast<std::size_t>(groups);
    for (std::size_t i = 0; i < pulled_groups_; ++i)
      for (const PulledEnd& end : groups_[i]) add(end);
  }
  archive(pulling_, speed_, ramp_time_, stage_begin_, rest_, not_tied_);
  archive.list(ramp_from_);
  archive.require(stage_ != Stage::kRamp || ramp_from_.size() == pulling_.size(), "loads of the ends",
                  std::to_string(ramp_from_.size()));
}

}  // namespace

std::unique_ptr<Tying> make_tying(const SpecimenOptions& specimen, const Material& material,
                                  const Centreline& centreline, double creep_speed, TimeStep& stepper, Grips& grips) {
  if (knot_of(specimen).about().loop)
    return std::make_unique<TiedLoop>(specimen, material, centreline, creep_speed, stepper, grips);
  if (!specimen.to_be_tied) return nullptr;
  const double rest_speed = std::max(specimen_scales(material).rest_speed, creep_speed);
  return std::make_unique<EndTying>(centreline, material, tying_load(specimen, material), rest_speed, stepper, grips);
}

}  // namespace knot_utm
