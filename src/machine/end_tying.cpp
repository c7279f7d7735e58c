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
                   const TimeStep& stepper, const Grips& grips)
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
    let_go(command.phase == Phase::kRelease ? command.duration : kLetGoTime, now.time);
  }
}

void EndTying::add_group() {
  for (const PulledEnd& end : groups_[pulled_groups_]) {
    const double load = end.fraction * preload_;
    pulling_.add(end.node, end.direction, load / (kGripStretch * radius_), load);
  }
  ++pulled_groups_;
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
  const double left = std::clamp(1.0 - (to - stage_begin_) / ramp_time_, 0.0, 1.0);
  for (std::size_t i = 0; i < pulling_.size(); ++i)
    boundary.forces.push_back({pulling_.grip(i).node, left * ramp_from_[i] * pulling_.grip(i).direction});
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
      add_group();
      pulling_.begin_at(x);
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
      if (!rest_.waited(time, reached_, "the free ends reached their loads")) break;
      if (pulled_groups_ == groups_.size()) {
        enter(Stage::kTied, time);
        break;
      }
      const std::size_t before = pulling_.size();
      add_group();
      pulling_.begin_at(x, before);
      reached_ = -1.0;
      enter(Stage::kPulling, time);
      break;
    }
    case Stage::kRamp:
      if (time - stage_begin_ >= ramp_time_) enter(Stage::kRest, time);
      break;
    case Stage::kRest:
      if (rest_.waited(time, stage_begin_, "the free ends were released")) enter(Stage::kFree, time);
      break;
    case Stage::kIdle:
    case Stage::kTied:
    case Stage::kFree:
      break;
  }
}

bool EndTying::done(Phase phase) const {
  return phase == Phase::kTie ? stage_ == Stage::kTied : stage_ == Stage::kFree;
}

void EndTying::judge_pull(double time) {
  const double elapsed = time - stage_begin_;
  if (elapsed <= kPullPatience || speed_ * elapsed <= kPullWay * radius_) return;
  const Points& x = stepper_.state().position;
  std::ostringstream message;
  message << "not tied: after " << elapsed << " s the free ends are pulled with";
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
  archive.require(stage_ != Stage::kRamp || ramp_from_.size() == pulling_.size(), "loads of the free ends",
                  std::to_string(ramp_from_.size()));
}

}  // namespace knot_utm
