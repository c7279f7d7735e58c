#include "knot_utm/machine/end_tying.hpp"

#include <algorithm>
#include <sstream>

#include "knot_utm/record/command.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {

namespace {

constexpr double kTimeToSettle = 0.3;     // [s]
constexpr double kWaveToSettle = 17.0;    // waves of this length relax in a tenth of it [h]
constexpr double kGripStretch = 2.4;      // of a grip when it slips [h]
constexpr double kLetGoTime = 1.0 / 3.0;  // [s]
constexpr double kPullPatience = 90.0;    // not tied where the loads are not reached by then [s] ...
constexpr double kPullWay = 300.0;        // ... and the grips have gone this far [h]

}  // namespace

EndTying::EndTying(const Centreline& centreline, const Material& material, double preload, double rest_speed,
                   const TimeStep& stepper, Grips& grips)
    : stepper_(stepper),
      grips_(grips),
      groups_(centreline.tied),
      preload_(preload),
      radius_(thickest(material)),
      settling_drag_(settling_drag(material, kWaveToSettle * material.radius, kTimeToSettle)),
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

void EndTying::add_group() {
  for (const PulledEnd& end : groups_[pulled_groups_]) {
    const double load = end.fraction * preload_;
    pulling_.add(end.node, end.direction, load / (kGripStretch * radius_), load);
  }
  ++pulled_groups_;
}

/// What the upper grip holds goes over to the grip that pulls it.
void EndTying::pull_next_group() {
  const Points& x = stepper_.state().position;
  const std::vector<PulledEnd>& group = groups_[pulled_groups_];
  std::vector<double> before;
  for (const PulledEnd& end : group) before.push_back(pulling_.force_at(end.node, x) + held_with(end));
  add_group();
  for (std::size_t i = 0; i < group.size(); ++i) {
    pulling_.begin_with(group[i].node, before[i], x);
    if (group[i].held()) grips_.let_slip(group[i].node, group[i].held_next);
  }
}

/// Force of the upper grip on an end that it holds, outwards [N].
double EndTying::held_with(const PulledEnd& end) const {
  if (!end.held()) return 0.0;
  const StepReadings& readings = stepper_.readings();
  return std::max(0.0, readings.reaction(end.node)[2] + readings.reaction(end.held_next)[2]);
}

/// Of a grip, as it pulls or is let go [N].
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

void EndTying::hold(Boundary& boundary, double from, double to) const {
  if (stage_ == Stage::kSettling) {
    const double left = std::clamp(1.0 - (to - stage_begin_) / kTimeToSettle, 0.0, 1.0);
    boundary.extra_drag = settling_drag_ * left * left;
  }
  if (stage_ == Stage::kPulling || stage_ == Stage::kTied)
    pulling_.add_to(boundary, stage_ == Stage::kPulling ? speed_ * (to - from) : 0.0);
  if (stage_ != Stage::kRamp) return;
  for (std::size_t i = 0; i < pulling_.size(); ++i)
    boundary.forces.push_back({pulling_.grip(i).node, load(i, to) * pulling_.grip(i).direction});
}

void EndTying::follow(Phase, const Place& now, double dt) {
  const Points& x = stepper_.state().position;
  const double time = now.time;
  rest_.follow(stepper_.state().velocity, dt);
  switch (stage_) {
    case Stage::kSettling:
      if (time - stage_begin_ < kTimeToSettle) break;
      if (groups_.empty()) {
        enter(Stage::kTied, time);
        break;
      }
      pull_next_group();
      reached_ = -1.0;
      enter(Stage::kPulling, time);
      break;
    case Stage::kPulling: {
      pulling_.move(x, speed_ * dt);
      const bool all_slip = pulling_.all_slip(x);
      if (all_slip && reached_ < 0.0) reached_ = time;
      if (reached_ < 0.0) {
        judge_pull(time);
        break;
      }
      // A grip that sticks again is waited for no longer than for rest.
      if (!all_slip && time - reached_ <= rest_.patience()) break;
      if (!rest_.waited(time, reached_, "the ends reached their loads")) break;
      if (pulled_groups_ == groups_.size()) {
        enter(Stage::kTied, time);
        break;
      }
      pull_next_group();
      reached_ = -1.0;
      enter(Stage::kPulling, time);
      break;
    }
    case Stage::kRamp:
      if (time - stage_begin_ >= ramp_time_) enter(Stage::kRest, time);
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

void EndTying::judge_pull(double time) {
  const double elapsed = time - stage_begin_;
  if (elapsed <= kPullPatience || speed_ * elapsed <= kPullWay * radius_) return;
  const Points& x = stepper_.state().position;
  std::ostringstream message;
  message << "not tied: after " << elapsed << " s the ends are pulled with";
  for (std::size_t i = 0; i < pulling_.size(); ++i)
    message << (i == 0 ? " " : " and ") << pulling_.force(i, x) << " of " << pulling_.grip(i).slip_force << " N";
  not_tied_ = message.str();
}

void EndTying::state(Archive& archive) {
  archive.section("ENDT");
  archive.choice("stage of tying", stage_, Stage::kFree);
  int groups = static_cast<int>(pulled_groups_);
  archive.number("groups of pulled ends", groups, 0, static_cast<int>(groups_.size()));
  if (archive.loads()) {
    pulling_.clear();
    for (pulled_groups_ = 0; pulled_groups_ < static_cast<std::size_t>(groups);) add_group();
  }
  archive(pulling_, speed_, ramp_time_, stage_begin_, reached_, rest_, not_tied_);
  archive.list(ramp_from_);
  archive.require(stage_ != Stage::kRamp || ramp_from_.size() == pulling_.size(), "loads of the ends",
                  std::to_string(ramp_from_.size()));
}

}  // namespace knot_utm
