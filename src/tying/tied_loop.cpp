#include "knot_utm/tying/tied_loop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/tying/before_tying.hpp"

namespace knot_utm {
namespace {

constexpr double kMet = 0.2;         // tolerance of the taut load [of it]
constexpr double kMuch = 0.5;        // load from which the crosshead is slower [of the taut load]
constexpr double kSlow = 0.25;       // factor of the speed from that load on, and at each reversal
constexpr double kMostBack = 3.0;    // the crosshead goes no further back behind where it began [h]
constexpr double kKnotsMoved = 0.3;  // change of the knot distance from which the knots slide [h]

}  // namespace

void TakeUpSlack::begin(double load, double displacement, double knot_distance) {
  *this = TakeUpSlack(taut_, radius_);
  begin_ = displacement;
  knot_distance_ = knot_distance;
  follow(load, displacement, knot_distance);
  moved_ = false;
}

void TakeUpSlack::follow(double load, double displacement, double knot_distance) {
  if (done_) return;
  const double sense = load < taut_ ? 1.0 : -1.0;
  const bool slid = sense > 0.0 && std::abs(knot_distance - knot_distance_) > kKnotsMoved * radius_;
  const bool in_vain = sense < 0.0 && displacement < begin_ - kMostBack * radius_;
  done_ = std::abs(load - taut_) <= kMet * taut_ || slid || in_vain;
  if (sense < 0.0) knot_distance_ = knot_distance;
  if (moved_ && sense != sense_) finest_ *= kSlow;
  moved_ = true;
  sense_ = sense;
  fraction_ = std::min(finest_, sense > 0.0 && load > kMuch * taut_ ? kSlow : 1.0);
}

void TakeUpSlack::state(Archive& archive) {
  archive(sense_, fraction_, finest_, begin_, knot_distance_, moved_, done_);
}

namespace {

constexpr double kGripStretch = 2.4;    // of a tail's grip when it slips [h]
constexpr double kTautLoad = 0.03;      // load of a taut loop [k_b/h^2]
constexpr double kNear = 0.005;         // relative deviation of e and L up to which a loop is at its marks [-]
constexpr int kMostSets = 4;            // a taut loop is set to its marks no more often
constexpr double kSetTime = 1.0 / 3.0;  // of one setting, at least [s]
constexpr double kSliding = 4.0;        // rate at which e is set over the crosshead's speed, at most
constexpr double kEndOfSetting = 1e-9;  // a setting is over if less time is left [s]
constexpr double kFarthest = 0.4;       // of e: a release moves knots that hold by less (tight silicone by 0.27)
constexpr double kSlid = 0.5;      // by which knots have come nearer in the pull from which the whole rod is solved [h]
constexpr double kOpenCoil = 3.0;  // radius from which a coil, 2 (R + h) wide, reaches into the straight strands [h]
constexpr double kOpened = 0.05;   // of e: knots that came nearer by more have opened (as in motion_pattern.cpp)
constexpr const char* kNoRoom =
    "mount: the loop as it was tied and released leaves no room for the rollers; choose a larger specimen.end_to_end, "
    "a smaller specimen.preload or a smaller machine.roller_diameter";

TyingRig::Options tying_options(const SpecimenOptions& specimen, const Material& material, double creep_speed) {
  TyingRig::Options out;
  out.preload = tying_load(specimen, material);
  out.rest.speed = std::max(specimen_scales(material).rest_speed, creep_speed);
  out.grip_stiffness = out.preload / (kGripStretch * material.radius);
  return out;
}

}  // namespace

TiedLoop::TiedLoop(const SpecimenOptions& specimen, const Material& material, const Centreline& centreline,
                   double creep_speed, TimeStep& stepper, Grips& grips)
    : stepper_(stepper),
      grips_(grips),
      radius_(material.radius),
      sets_to_marks_(coil_radius(material, tying_load(specimen, material)) < kOpenCoil * material.radius),
      knot_distance_(specimen.knot_distance),
      end_to_end_(specimen.end_to_end),
      rig_(centreline, stepper.rod(), tying_options(specimen, material, creep_speed)),
      touch_(rig_.standing_nodes(), material.core_radius(), centreline.windings()),
      slack_(kTautLoad * specimen_scales(material).force, material.radius) {}

void TiedLoop::enter(const Command& command, const Place& now) {
  const Phase phase = command.phase;
  if (phase == Phase::kTie) rig_.tie(command.speed, now.time, stepper_.state().position);
  if (phase == Phase::kRelease) {
    rig_.release(command.duration, now.time);
  } else if (rig_.tied()) {
    rig_.let_go(stepper_, now.time);
  } else if (rig_.released() && !rests(phase)) {
    put_on(now);
  } else if (rig_.guides() && phase != Phase::kMount) {
    rig_.take_guides_off(stepper_, now.time);
  }
  if (phase != Phase::kMount) return;
  speed_ = command.speed;
  at_marks_ = false;
  begin_on_slack(now);
}

void TiedLoop::put_on(const Place& now) {
  tied_distance_ = knot_distance();
  rig_.put_on(stepper_, now.time);
  const auto loop = stepper_.state().position.middleCols(rig_.loop_begin(), rig_.loop_end() - rig_.loop_begin() + 1);
  if (!grips_.put_on(loop, now.grip, radius_)) not_mounted_ = kNoRoom;
}

/// Begins to make straight strands longer or shorter so that e and L are met, as if the loop had been sketched so:
/// neither of them affects how a knot is tied and released. Knots that came nearer by themselves have opened, and are
/// left as they are. False: there is nothing to set.
bool TiedLoop::set_to_marks(const Place& now) {
  const double distance = knot_distance(), apart = knot_distance_ - distance;
  const double further = grips_.on_rollers() ? end_to_end_ - grips_.end_to_end(now.grip) : 0.0;
  const bool opened = distance < (1.0 - kOpened) * (sets_ == 0 ? tied_distance_ : knot_distance_) ||
                      std::abs(apart) > kFarthest * knot_distance_;
  const bool near = std::abs(apart) < kNear * knot_distance_ && std::abs(further) < kNear * end_to_end_;
  if (!sets_to_marks_ || opened || near || sets_ == kMostSets) return false;
  ++sets_;
  set_end_ = now.time + std::max({kSetTime, std::abs(further) / speed_, std::abs(apart) / (kSliding * speed_)});
  set_speed_ = further / (set_end_ - now.time);
  apart_ = apart;
  further_ = further;
  return true;
}

void TiedLoop::leave(Phase phase, const Place& now) {
  // What the knots and the load do while they are let go is not the slack's.
  if (rig_.released() && phase != Phase::kRelease && !rests(phase)) put_on(now);
  if (rig_.guides() && phase != Phase::kMount) rig_.take_guides_off(stepper_, now.time);
}

/// Edges are laid longer or shorter just before the step that solves them: whatever is read between two steps, and the
/// judgement of a break, is of a rod that has been solved.
void TiedLoop::prepare(const Place& now) {
  if (unlaid_ == 0.0) return;
  const double dt = std::exchange(unlaid_, 0.0), left = set_end_ - now.time;
  const double part = left > kEndOfSetting ? dt / (left + dt) : 1.0;
  const TyingRig::Laid laid =
      rig_.longer(part * apart_, part * (2.0 * further_ - apart_), stepper_.rod(), stepper_.state());
  stepper_.lay(laid.rest_length, laid.position);
  apart_ -= part * apart_;
  further_ -= part * further_;
  if (part == 1.0) set_end_ = 0.0;
  if (rig_.guides()) follow_mounting(now, false);
}

void TiedLoop::follow(Phase phase, const Place& now, double dt) {
  const bool puts_on = rig_.puts_on();
  rig_.follow(stepper_, now.time, dt);
  if (setting()) unlaid_ = dt;
  // From here on weight, if there is any, would make the slack loop turn around the rollers.
  if (puts_on && rig_.guides()) grips_.hold_far_side(stepper_.state().position, now.grip);
  if (phase == Phase::kMount && rig_.guides() && unlaid_ == 0.0) follow_mounting(now, puts_on);
  if (farthest_ > 0.0 || (moves(phase) && phase != Phase::kMount)) solve_whole_once_they_slide();
  touch_.follow(stepper_);
}

/// Two knots that slide do not do so alike: the symmetric motion is possible, but grows apart. Knots that hold move
/// apart as the rod between them stretches.
void TiedLoop::solve_whole_once_they_slide() {
  const double distance = knot_distance();
  farthest_ = std::max(farthest_, distance);
  if (farthest_ - distance > kSlid * radius_) stepper_.solve_whole();
}

void TiedLoop::follow_mounting(const Place& now, bool puts_on) {
  if (puts_on || setting()) return begin_on_slack(now);
  slack_.follow(load_on_both(), now.displacement, knot_distance());
  at_marks_ = slack_.done() && !set_to_marks(now);
}

void TiedLoop::begin_on_slack(const Place& now) { slack_.begin(load_on_both(), now.displacement, knot_distance()); }

void TiedLoop::hold(Boundary& boundary, double from, double to) const {
  if (rig_.off_rollers()) {
    boundary.rollers.clear();
    boundary.holds.clear();
  }
  for (Roller& roller : boundary.rollers) {
    roller.first_node = rig_.loop_begin();
    roller.last_node = rig_.loop_end();
  }
  if (rig_.stage() != TyingRig::Stage::kIdle) rig_.hold(boundary, from, to);
}

double TiedLoop::held_length(double from, double to) const {
  double length = grips_.end_to_end(0.0);
  // A loop that is off the rollers does not load the grip.
  if (rig_.stage() == TyingRig::Stage::kIdle || rig_.off_rollers()) return length;
  Boundary held;
  rig_.hold(held, from, to);
  for (const FixedNode& node : held.fixed_nodes) length = std::min(length, grips_.upper(0.0)[2] - node.position[2]);
  return length;
}

double TiedLoop::mounting_velocity(double speed) const {
  // The crosshead stands while the loop is put on.
  if (!rig_.guides()) return 0.0;
  return setting() ? set_speed_ : speed * slack_.velocity();
}

bool TiedLoop::done(Phase phase) const {
  return forms(phase) ? rig_.tied() || rig_.released() : rig_.guides() && at_marks_;
}

double TiedLoop::load_on_both() const { return std::min(grips_.force_upper(stepper_), grips_.force_lower(stepper_)); }

double TiedLoop::knot_distance() const {
  const RodProperties& rod = stepper_.rod();
  const RodState& state = stepper_.state();
  return (rig_.knot_middle(0, rod, state) - rig_.knot_middle(1, rod, state)).norm();
}

void TiedLoop::read(Sample& sample) const {
  for (std::size_t k = 0; k < sample.tail_force.size(); ++k) {
    sample.tail_force[k] = rig_.tail_force(static_cast<int>(k));
    sample.excess_length[k] = rig_.excess_length(static_cast<int>(k), stepper_.state());
  }
  sample.knot_distance = knot_distance();
  sample.knots_force = touch_.between_knots();
  sample.knot_on_roller = touch_.on_rollers();
}

void TiedLoop::state(Archive& archive) {
  archive.section("LOOP");
  archive(rig_, touch_, slack_, set_end_, set_speed_, apart_, further_, unlaid_, speed_, tied_distance_, sets_,
          farthest_, at_marks_);
}

double marks_of(const SpecimenOptions& specimen, const Program& program) {
  return specimen.to_be_tied && has_step<MountStep>(program) ? specimen.knot_distance : 0.0;
}

}  // namespace knot_utm
