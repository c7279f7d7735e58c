#include "knot_utm/machine/testing_machine.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "knot_utm/breaking/break_watch.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/machine/frame.hpp"
#include "knot_utm/machine/load_cell.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_readings.hpp"
#include "knot_utm/specimen/knot_watch.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/tying/tying.hpp"

namespace knot_utm {
namespace {

constexpr double kShortestStep = 0.01;  // a run gives up below this step, if it is shorter than usual [bending time]

constexpr double kAimedMotion = 0.6;  // of the fastest node, in a step [h]
constexpr double kAimedSlip = 0.4;    // of strands on each other, in a step [h]

// A shape that is pulled as it was sketched settles first, under a drag that fades as that of the tying rig does.
constexpr double kSettlingTime = 1.0;   // [s]
constexpr double kSettlingWave = 40.0;  // waves of this length relax in a tenth of that time [h]

constexpr double kNearBreak = 1e-3;    // least step towards a break that is near [longest step]
constexpr double kLeastPassed = 1e-2;  // force by which the grip may pass the balance of forces [k_b/h^2]

// A load at which the crosshead stops may be passed by this share of it, but by no less than what follows, and never in
// steps so short that nothing could be done about it.
constexpr double kStopPassed = 1e-3;
constexpr double kLeastStopPassed = 1e-4;  // [k_b/h^2]
constexpr double kNearStop = 1e-5;         // [longest step]

/// `grip`: displacement of the upper grip [m].
BreakPlace place_of_break(const TimeStep& stepper, const Grips& grips, double grip, int edge) {
  const Points& position = stepper.state().position;
  if (lies_in_knot(stepper.rod(), position, edge)) return BreakPlace::kKnot;
  const Vec3 middle = 0.5 * (position.col(edge) + position.col(edge + 1));
  return grips.hold(grip, middle, stepper.rod().material_at(edge).radius) ? BreakPlace::kGrip : BreakPlace::kStrand;
}

}  // namespace

struct TestingMachine::Impl {
  SpecimenOptions specimen;
  Centreline centreline;
  Material scaled;  // the material with the density of the mass that is accelerated (with_scaled_inertia)
  MachineOptions machine;
  PhysicsOptions physics;
  Grips grips;
  Frame frame;
  std::unique_ptr<TimeStep> stepper;
  StepControl control{StepControl::Options{}};
  LoadCell cell;
  std::optional<RodBreak> breaks;             // if the rod can part
  std::unique_ptr<Tying> tying;               // if the specimen is a loop or is to be tied
  std::optional<KnotWatch> watch;             // if the type of the knot is followed
  std::optional<FreeEnds> free_ends;          // if the knot's file leaves ends free
  std::optional<KnotReadings> knot_readings;  // if the knot's file asks for some
  Boundary boundary;

  double longest_step = 0.0;  // [s]
  double time = 0.0;
  double displacement = 0.0;  // of the crosshead [m]
  double grip = 0.0;          // displacement of the upper grip; the same on a rigid frame [m]
  double turn = 0.0;          // of the upper clamp [rad]
  struct {
    double travel = 0.0, grip = 0.0;  // displacements of crosshead and upper grip at its end [m]
    double drag = 0.0;                // of the rod's motion [N s/m^2]
    double borne_before = 0.0;        // force on the upper grip at its beginning, on a compliant frame [N]
  } tried;                            // the time step that is being made
  struct {
    double sense = 1.0, load = Sample::kNone;  // of the motion, 1 is outwards; balanced load [N]
    double last = 0.0;                         // balanced load at rest after the last accepted step [N]
    std::optional<double> place;               // displacement at which the crosshead stands since [m]
  } stop;                                      // of the crosshead within a command (Command::stop_load)
  double extension_zero = 0.0, raw_extension_zero = 0.0;
  Vec3 gravity;   // that gives the accelerated mass its true weight [m/s^2]
  StepWork work;  // of all accepted steps
  std::vector<Sample> substeps;
  std::string message;
  int parted_edge = -1;  // -1: none
  int step_index = -1;
  BreakPlace break_place = BreakPlace::kNone;
  Phase phase = Phase::kIdle;
  BenchStatus status = BenchStatus::kRunning;
  bool pulled = false;  // the program has had a step that moves the crosshead, other than mounting

  Impl(const SpecimenOptions& specimen_, const Material& material, const MachineOptions& machine_,
       const PhysicsOptions& physics_)
      : specimen(specimen_),
        centreline(specimen_centreline(specimen_, material, machine_, physics_)),
        scaled(with_scaled_inertia(material, physics_, slack_of(specimen_, centreline))),
        machine(machine_),
        physics(physics_),
        grips(specimen_, machine_, centreline, scaled),
        frame(machine_.stiffness, scaled, bearing_strands(specimen_), grips.length_moved(material.radius)),
        cell(machine_.load_cell) {
    const Eigen::Index nodes = centreline.points.cols();
    Eigen::VectorXd rest(nodes - 1);
    for (Eigen::Index i = 0; i + 1 < nodes; ++i)
      rest[i] = (centreline.points.col(i + 1) - centreline.points.col(i)).norm();
    if (centreline.half_turn) rest = (0.5 * (rest + rest.reverse())).eval();
    RodState state;
    state.position = centreline.points;
    state.velocity = Points::Zero(3, nodes);
    RodProperties rod =
        scaled.other ? make_rod(scaled, *scaled.other, rest, centreline.cuts) : make_rod(scaled, rest, centreline.cuts);
    if (bends_on_frames(scaled)) remember_bends(rod, &state);
    give_rest_shape(specimen, rod, &state);
    if (solves_for_twist(state)) initialise_frames(&state);
    StepSettings settings = step_settings(specimen, scaled, machine, physics);
    // The weight is that of the rod's own mass, not of the accelerated one.
    gravity = settings.gravity = physics.gravity / inertia_factor(material, physics, slack_of(specimen, centreline));
    settings.half_turn = centreline.half_turn;
    stepper = TimeStep::make(rod, state, settings);
    double bending_time = specimen_scales(scaled).own_time;
    if (scaled.other) bending_time = std::min(bending_time, specimen_scales(*scaled.other).own_time);
    StepControl::Options options;
    options.longest = options.first = longest_step = tolerances(physics, specimen, scaled).longest_step;
    // A sketched shape springs apart at once, so that the first step has to be short.
    if (!knot_of(specimen).about().straight) options.first = std::min(bending_time, options.longest);
    options.motion = kAimedMotion * thinnest(scaled);
    options.slip = kAimedSlip * thinnest(scaled);
    options.shortest = std::min(options.shortest, kShortestStep * bending_time);
    control = StepControl(options);
    tying = make_tying(specimen, scaled, centreline, settings.friction.creep_speed(), *stepper, grips);
    if (!centreline.free_ends.empty()) free_ends.emplace(centreline, stepper->rod());
    if (!centreline.readings.empty()) knot_readings.emplace(centreline, stepper->rod());
    if (type_is_followed(specimen))
      watch.emplace(tying ? tying->standing_nodes() : std::vector<int>(), scaled.core_radius(), centreline.points,
                    centreline.windings());
    if (can_part(scaled)) breaks.emplace(scaled, *stepper, kNearBreak * options.longest);
    stepper->refuse_by([this](const Points& end, double dt) { return refuse(end, dt); });
    extension_zero = grips.end_to_end(grip);
  }

  /// A specimen that is to be tied gets its weight gradually as it is released: otherwise it would swing, and its knots
  /// could jump open.
  double weight_borne(double at_time) const {
    return specimen.to_be_tied && tying ? tying->weight_borne(at_time) : 1.0;
  }

  void apply_weight(double at_time) {
    stepper->set_gravity(weight_borne(at_time) * gravity);
    grips.hang(weight_borne(at_time), boundary);
  }

  /// `auto`: yes if the rod is curved at rest or remembers its bends; also if it does not stay straight and either
  /// frames are held at both ends, or friction acts at the surface and rolls strands, or sections are soft. A rod whose
  /// ends can turn freely has no twist where friction acts on its centreline.
  bool solves_for_twist(const RodState& state) const {
    switch (physics.twist) {
      case TwistMode::kOn:
        return true;
      case TwistMode::kOff:
        return false;
      case TwistMode::kAuto:
        break;
    }
    return state.curved_at_rest() ||
           ((grips.hold_frames() || scaled.is_soft() || friction_rolls(scaled, machine, physics)) &&
            !knot_of(specimen).about().straight);
  }

  /// Time and places of crosshead and upper clamp at the beginning of a command.
  struct Start {
    double time, displacement, turn;
  };

  const Boundary& boundary_at(const Command& command, double from, double to, const Start& start) {
    if (tying) tying->prepare({from, displacement, grip});
    const double whole = command.time - start.time;
    const double fraction = whole > 0.0 ? std::min(1.0, (to - start.time) / whole) : 1.0;
    const double travel = mounts()     ? displacement + tying->mounting_velocity(command.speed) * (to - from)
                          : stop.place ? *stop.place
                                       : start.displacement + fraction * (command.displacement - start.displacement);
    tried.travel = travel;
    // This depends on the last accepted state only: a step that is tried again begins with the same force.
    if (!frame.rigid()) tried.borne_before = grips.force_upper(*stepper);
    boundary.extra_drag = drag_of_settling(to) + (tying ? tying->extra_drag(to) : 0.0);
    tried.drag = drag() + boundary.extra_drag;
    tried.grip = frame.grip_after(grip, travel, tried.borne_before, held_length(from, to), to - from, tried.drag);
    grips.set(tried.grip, tying ? tying->left_to_put_on(to) : 0.0, boundary);
    grips.turn_clamp(start.turn + fraction * (command.turn - start.turn), boundary);
    apply_weight(to);
    boundary.grips.clear();
    if (tying) tying->hold(boundary, from, to);
    return boundary;
  }

  /// Length of the strands between the upper grip and what holds them below, as mounted [m].
  double held_length(double from, double to) const {
    return tying ? tying->held_length(from, to) : grips.end_to_end(0.0);
  }

  /// The stored energy of a sketched shape is an artefact of the sketch, and would throw it about. A straight rod has
  /// none, and a specimen that is to be tied settles in the rig.
  double drag_of_settling(double at_time) const {
    if (knot_of(specimen).about().straight || specimen.to_be_tied || at_time >= kSettlingTime) return 0.0;
    const double left = 1.0 - at_time / kSettlingTime;
    return settling_drag(scaled, kSettlingWave * scaled.radius, kSettlingTime) * left * left;
  }

  /// `auto`: the drag that brings the specimen to rest. Its share in the forces of a loop, of a straight rod or of a
  /// rod on posts is far below a thousandth. The force of a loose knot between clamps may be as small as the drag on
  /// its length, so such a knot has no drag from the first pull on.
  double drag() const {
    const KnotDescription& knot = knot_of(specimen).about();
    const bool sketched_knot = knot.may_hold_a_knot() && !knot.loop;
    const auto to_rest = [&](const RodMaterial& rope) { return drag_to_rest(rope, knot.loop); };
    const double usual = scaled.other ? std::max(to_rest(scaled), to_rest(*scaled.other)) : to_rest(scaled);
    return physics.drag.value_or(pulled && sketched_knot ? 0.0 : usual);
  }

  void enter_step(const Command& command) {
    step_index = command.step;
    phase = command.phase;
    pulled |= moves(phase) && phase != Phase::kMount;
    status = BenchStatus::kRunning;
    if (tying) tying->enter(command, place());
  }

  /// Whether the crosshead takes up the slack of a loop by itself.
  bool mounts() const { return tying && phase == Phase::kMount; }

  Tying::Place place() const { return {time, displacement, grip}; }

  bool parted() const { return parted_edge >= 0; }
  /// A step that could not be made leaves contacts behind that belong to no accepted step.
  bool knows_contacts() const { return status != BenchStatus::kFailed && status != BenchStatus::kBroken; }

  /// Why a step that was solved is to be tried again, shorter; empty: it is accepted.
  std::string refuse(const Points& end, double dt) const {
    if (breaks)
      if (std::string why = breaks->refuse(*stepper, end, dt); !why.empty()) return why;
    const double force = grips.tried_force_upper(*stepper), length = held_length(time, time + dt);
    const double at_rest = force + frame.still_to_come(tried.grip, tried.travel, force, length);
    if (may_stop() && beyond_stop(cell.balanced(at_rest)) > stop_tolerance() && dt > kNearStop * longest_step)
      return "the load passed that at which the crosshead stops";
    const bool passed = frame.passed_balance(tried.grip - grip, tried.grip, tried.travel, force, length, dt, tried.drag,
                                             kLeastPassed * unit_force());
    return passed ? "the grip passed the balance of the forces of specimen and frame" : "";
  }

  double unit_force() const { return scaled.bending_stiffness / (scaled.radius * scaled.radius); }  // k_b/h^2 [N]

  bool may_stop() const { return !stop.place && !mounts() && std::isfinite(stop.load); }
  double beyond_stop(double load) const { return stop.sense * (load - stop.load); }
  double stop_tolerance() const { return std::max(kStopPassed * std::abs(stop.load), kLeastStopPassed * unit_force()); }

  /// Balanced load, with what is still to come of the frame once the crosshead stands [N].
  double load_at_rest(double at_time) const {
    const double force = grips.force_upper(*stepper);
    return cell.balanced(force + frame.still_to_come(grip, displacement, force, held_length(at_time, at_time)));
  }

  /// After an accepted step: stops the crosshead at its load. If it is not there yet, the next step ends no later than
  /// it would be at the present rate.
  void judge_stop(double at_time, double dt) {
    if (!may_stop()) return;
    const double load = load_at_rest(at_time);
    const double rate = stop.sense * (load - std::exchange(stop.last, load)) / dt, left = -beyond_stop(load);
    if (left <= 0.0) stop.place = displacement;
    if (left > 0.0 && rate > 0.0) control.at_most((left + 0.5 * stop_tolerance()) / rate);
  }

  /// After an accepted step: judges whether the rod parts. If not, the next step ends no later than it would part at
  /// the present rate.
  void judge_break(double dt) {
    if (!breaks) return;
    const std::optional<Exposure> reached = breaks->judge(*stepper, dt);
    if (!reached) return control.at_most(breaks->next());
    message = not_by_tension(*reached, grips.force_upper(*stepper), grips.force_lower(*stepper));
    if (message.empty()) return part(*reached);
    status = BenchStatus::kFailed;
    control.halt();
  }

  void part(const Exposure& reached) {
    parted_edge = reached.edge;
    break_place = place_of_break(*stepper, grips, grip, parted_edge);
    status = BenchStatus::kBroken;
    message = breaks->describe(*stepper, reached, break_place);
    control.halt();
  }

  /// Ends the test if the specimen cannot be tied or mounted, and returns whether it did.
  bool give_up_tying() {
    if (!tying || tying->gave_up().empty()) return false;
    status = BenchStatus::kFailed;
    message = tying->gave_up();
    return true;
  }

  void judge_phase() {
    if (parted()) return;
    if (give_up_tying()) return;
    if (!ends_by_itself(phase) || (tying && !tying->done(phase))) return;
    status = BenchStatus::kPhaseDone;
    if (phase == Phase::kMount || !tying || tying->not_equilibrated().empty()) return;
    status = BenchStatus::kNotEquilibrated;
    message = tying->not_equilibrated();
  }

  Sample read(const Command& command, double at_time) const {
    Sample s;
    s.sequence = command.sequence;
    s.time = at_time;
    s.phase = phase;
    s.displacement = displacement;
    s.end_to_end = grips.end_to_end(grip);
    s.extension = s.end_to_end - extension_zero;
    if (!frame.rigid()) s.raw_extension = displacement - raw_extension_zero;
    s.turn = turn;
    s.torque = grips.torque(*stepper);
    s.force_upper = grips.force_upper(*stepper);
    s.force_lower = grips.force_lower(*stepper);
    s.load = s.highest_load = s.lowest_load = cell.balanced(s.force_upper);
    s.balance_offset = cell.offset();
    s.tail_force = s.excess_length = PerKnot::unknown(static_cast<std::size_t>(knot_of(specimen).about().knots));
    if (one_knot_in_line(specimen)) {
      const Points& x = stepper->state().position;
      const Eigen::Index edges = stepper->rod().edges();
      s.excess_length = {(x.rightCols(edges) - x.leftCols(edges)).colwise().norm().sum() - s.end_to_end};
    }
    if (tying) tying->read(s);
    if (free_ends && knows_contacts()) s.tail_length = free_ends->lengths(stepper->readings());
    const ContactReading contact = stepper->readings().contact();
    s.max_penetration = contact.largest_overlap / thinnest(scaled);
    s.normal_force = contact.normal_force;
    s.contacts = contact.touching;
    s.fastest_node = std::sqrt(stepper->state().velocity.colwise().squaredNorm().maxCoeff());
    const Energies energies = stepper->readings().energies();
    s.stretching_energy = energies.stretching;
    s.bending_energy = energies.bending;
    s.twisting_energy = energies.twisting;
    s.contact_energy = energies.contact;
    s.kinetic_energy = energies.kinetic;
    s.grip_work = work.boundary;
    s.dissipation = work.friction + work.drag + work.plastic;
    s.friction_loss = work.friction;
    s.plastic_loss = work.plastic;
    s.numerical_dissipation = work.numerical;
    s.reweighting_loss = work.reweighting;
    s.moment_imbalance = stepper->readings().loads().moment.norm();
    s.steps = control.counters().steps;
    s.rejected_steps = control.counters().rejected;
    s.newton_iterations = control.counters().iterations;
    s.half_iterations = control.counters().by_half;
    if (watch) s.knot_type = watch->type();
    if (parted()) s.break_arclength = break_arclength(*stepper, parted_edge);
    s.break_place = break_place;
    s.status = status;
    s.message = message;
    return s;
  }

  void state(Archive& archive) {
    archive.section("BNCP");  // "BNCO" counted no iterations by half, "BNCN" let parted ends recoil, "BNCM" had no turn
                              // of the upper clamp
    archive.number("parted edge", parted_edge, -1, static_cast<int>(stepper->rod().edges()) - 1);
    archive.choice("place of the break", break_place, BreakPlace::kGrip);
    if (breaks) archive(*breaks);
    archive(time, displacement, turn, grip, extension_zero, raw_extension_zero, step_index, work, message);
    archive.choice("phase", phase, last_phase());
    archive(pulled);
    archive.choice("status", status, BenchStatus::kFailed);
    archive.require(parted() == (status == BenchStatus::kBroken), "status of a rod that parted",
                    break_place_name(break_place));
    archive(control, cell, *stepper, grips);
    if (!frame.rigid()) archive(frame);
    archive.same("tying", tying ? 1 : 0);
    archive.same("knot", watch ? 1 : 0);
    if (tying) archive(*tying);
    if (watch) archive(*watch);
    if (free_ends) archive(*free_ends);
    if (archive.loads()) substeps.clear();
  }

  /// Steps on from `start` towards the command, as far as `end` [s]. Empty, or why it gave up.
  std::string advance(const Command& command, const Start& start, double end) {
    const double whole = command.time - start.time;
    const double speed = whole > 0.0 ? (command.displacement - start.displacement) / whole : 0.0;
    return control.advance(
        *stepper, time, end,
        [&](double from, double to) -> const Boundary& { return boundary_at(command, from, to, start); },
        [&](double to, double dt, const StepSummary&) {
          displacement = mounts() || stop.place ? tried.travel
                         : to < command.time    ? start.displacement + speed * (to - start.time)
                                                : command.displacement;
          turn =
              to < command.time ? start.turn + (to - start.time) / whole * (command.turn - start.turn) : command.turn;
          const double moved = tried.grip - grip;
          grip = frame.rigid() ? displacement : tried.grip;
          if (!frame.rigid())
            frame.follow(moved, grips.force_upper(*stepper) - tried.borne_before, held_length(to - dt, to));
          work += stepper->readings().work();
          const double apart = grips.end_to_end(grip);
          if (tying) tying->follow(phase, {to, displacement, grip}, dt);
          grips.follow_weights(weight_borne(to));
          if (free_ends) free_ends->follow(stepper->readings().contact().normal_force > 0.0);
          extension_zero += grips.end_to_end(grip) - apart;  // rod that slips through the upper grip is no extension
          judge_break(dt);
          substeps.push_back(read(command, to));
          judge_stop(to, dt);
        });
  }

  /// Enters the step of a command. False: the test has failed or ended, and the rod stays as it is.
  bool may_go_on(const Command& command) {
    if (status == BenchStatus::kFailed || status == BenchStatus::kBroken) return false;
    if (command.step != step_index) enter_step(command);
    if (command.turn == turn || grips.clamp_turns()) return !give_up_tying();
    status = BenchStatus::kFailed;
    message = "the upper clamp cannot be turned: the rod leaves it across the load axis";
    return false;
  }

  Sample respond(const Command& command) {
    substeps.clear();
    if (!may_go_on(command)) {
      substeps.push_back(read(command, time));
      return substeps.back();
    }
    stepper->set_drag(drag());
    if (command.balance) {
      cell.balance(grips.force_upper(*stepper));
      extension_zero = grips.end_to_end(grip);
      raw_extension_zero = displacement;
    }
    stop = {command.velocity < 0.0 ? -1.0 : 1.0, command.stop_load, load_at_rest(time), {}};
    if (may_stop() && beyond_stop(stop.last) >= 0.0) stop.place = displacement;
    const std::string gave_up = advance(command, {time, displacement, turn}, command.time);
    if (!parted() && !gave_up.empty()) {
      status = BenchStatus::kFailed;
      message = gave_up;
    }
    if (!parted() && status != BenchStatus::kFailed) {
      if (!mounts() && !stop.place) displacement = command.displacement;
      if (frame.rigid()) grip = displacement;
      if (tying) tying->leave(phase, place());
      judge_phase();
    }
    if (watch && !parted()) watch->follow(stepper->state().position);
    Sample last = read(command, time);
    if (knot_readings && knows_contacts()) last.knot_readings = knot_readings->at(stepper->state().position);
    if (command.read_cell && status != BenchStatus::kFailed) last.load = cell.read(last.force_upper);
    for (const Sample& step : substeps) {
      last.highest_load = std::max(last.highest_load, step.highest_load);
      last.lowest_load = std::min(last.lowest_load, step.lowest_load);
    }
    if (substeps.empty())
      substeps.push_back(last);
    else
      substeps.back() = last;
    return last;
  }
};

TestingMachine::TestingMachine(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                               const PhysicsOptions& physics)
    : impl_(std::make_unique<Impl>(specimen, material, machine, physics)) {}
TestingMachine::~TestingMachine() = default;
TestingMachine::TestingMachine(TestingMachine&&) noexcept = default;
TestingMachine& TestingMachine::operator=(TestingMachine&&) noexcept = default;

Sample TestingMachine::respond(const Command& command) { return impl_->respond(command); }
const std::vector<Sample>& TestingMachine::substeps() const { return impl_->substeps; }
const Centreline& TestingMachine::drawn() const { return impl_->centreline; }
const RodProperties& TestingMachine::rod() const { return impl_->stepper->rod(); }
const RodState& TestingMachine::state() const { return impl_->stepper->state(); }
Vec3 TestingMachine::lower_grip() const { return impl_->grips.lower(); }
Vec3 TestingMachine::upper_grip() const { return impl_->grips.upper(impl_->grip); }
double TestingMachine::time() const { return impl_->time; }
double TestingMachine::longest_step() const { return impl_->longest_step; }
Eigen::VectorXd TestingMachine::tension() const {
  if (impl_->parted()) return Eigen::VectorXd::Constant(rod().edges(), Sample::kNone);
  return impl_->stepper->tension();
}
std::vector<ContactForce> TestingMachine::contact_forces() const {
  return impl_->knows_contacts() ? impl_->stepper->readings().contact_forces() : std::vector<ContactForce>();
}
Eigen::VectorXd TestingMachine::contact_load() const {
  if (!impl_->knows_contacts()) return {};
  return impl_->stepper->readings().normal_forces().cwiseQuotient(rod().voronoi_length);
}
void TestingMachine::state(Archive& archive) { impl_->state(archive); }

}  // namespace knot_utm
