#include "knot_utm/program/loading_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "knot_utm/program/course.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {

EndedBy BenchStep::ended(const Sample& now, CrossheadCourse&) {
  const bool done = now.status == BenchStatus::kPhaseDone || now.status == BenchStatus::kNotEquilibrated;
  return done ? EndedBy::kProgram : EndedBy::kNotYet;
}

void TieStep::check(const StepPlace& place) const {
  if (place.index != 0) place.misplaced("can only be the first step");
  place.needs(place.can_be_tied);
}

void ReleaseStep::check(const StepPlace& place) const {
  if (place.index != 1 || !place.program[0].as<TieStep>()) place.misplaced("can only stand right after tie");
}

void MountStep::check(const StepPlace& place) const {
  place.needs(place.loops);
  for (std::size_t i = 0; i < place.index; ++i)
    if (moves(place.program[i]->phase()))
      place.misplaced("can only stand before the first step that moves the crosshead");
}

void MountStep::steer(const Sample&, CrossheadCourse& course) { course.move(speed); }

void PreloadStep::keys(fields::Fields& f, double) {
  f.required_number("load", load, {1e-6, 1e8, "N"});
  speed_key(f);
  f.says("load rate; experimental").optional_number("load_rate", load_rate, kLoadRates, "none");
  f.flag("balance", balance);
}

void PreloadStep::steer(const Sample& now, CrossheadCourse& course) {
  course.move(balancing_  ? 0.0
              : load_rate ? course.velocity_at_load_rate(now, *load_rate, speed, load)
                          : course.speed_to_load(now, load, speed, true));
}

EndedBy PreloadStep::ended(const Sample& now, CrossheadCourse& course) {
  if (!balancing_ && !reached(balanced_load(now), load, 1.0, kLoadTolerance * load)) return EndedBy::kNotYet;
  if (balancing_ || !balance) return EndedBy::kLoad;
  balancing_ = true;
  course.balance();
  return EndedBy::kNotYet;
}

void BalanceStep::begin(const Sample&, CrossheadCourse& course) { course.balance(); }

double BalanceStep::usual_duration(const CrossheadCourse& course) const { return course.period(); }

void PullStep::keys(fields::Fields& f, double usual_extension) {
  speed_key(f);
  f.says("load rate; experimental").optional_number("load_rate", load_rate, kLoadRates, "none");
  f.section("until", [&](fields::Fields& u) {
    u.says(
         "extension; `auto`: 37.8 radii, or 0.7 `knot_distance` if more; overhand `length`/10; straight `length`/25; "
         "file 12.6 radii; capstan 1.5 radii of its bend")
        .optional_number("extension", until.extension, {1e-6, 100.0, "m"}, "none", usual_extension);
    u.optional_number("load", until.load, {1e-6, 1e8, "N"}, "none");
    u.optional_number("time", until.time, {1e-3, 1e6, "s"}, "none");
    u.flag("break", until.broken);
  });
}

void PullStep::check(const StepPlace& place) const {
  if (!until.extension && !until.load && !until.time && !until.broken)
    throw InvalidInput::missing(place.key() + ".until", "one or more of extension, load, time and break");
}

void PullStep::begin(const Sample&, CrossheadCourse& course) {
  if (!load_rate) course.move(speed);
}

void PullStep::steer(const Sample& now, CrossheadCourse& course) {
  if (load_rate) {
    const double end = until.load.value_or(fields::kInfinity);
    course.move(course.velocity_at_load_rate(now, *load_rate, speed, end));
  } else if (until.load) {
    const double velocity = course.speed_to_load(now, *until.load, speed, false);
    if (velocity != course.velocity()) course.move(velocity);
  }
}

EndedBy PullStep::ended(const Sample& now, CrossheadCourse& course) {
  if (until.extension && now.extension >= *until.extension) return EndedBy::kExtension;
  if (until.load && reached(balanced_load(now), *until.load, 1.0, kLoadTolerance * *until.load)) return EndedBy::kLoad;
  return until.time && course.over(*until.time) ? EndedBy::kProgram : EndedBy::kNotYet;
}

double PullStep::usual_duration(const CrossheadCourse& course) const {
  const double by_speed = until.extension.value_or(course.most_travel()) / speed;
  const double by_load = load_rate ? until.load.value_or(course.most_load()) / *load_rate : by_speed;
  return std::min({by_speed, by_load, until.time.value_or(by_speed)});
}

void HoldStep::keys(fields::Fields& f, double) {
  f.required_number("duration", duration, {1e-3, 1e6, "s"});
  f.choice("control", hold_load, std::array{"extension", "load"});
  f.says("load; with `control: load`", "as it is").optional_number("load", held_load, {-1e8, 1e8, "N"}, "auto");
  if (hold_load || f.lists_all()) speed_key(f);
}

void HoldStep::check(const StepPlace& place) const {
  if (!held_load || hold_load) return;
  const std::string key = place.key() + ".load", load = format_number(*held_load);
  throw InvalidInput::sentence(key, key + " is " + load + ", but has an effect only with control: load; leave it out");
}

void HoldStep::begin(const Sample&, CrossheadCourse& course) {
  if (held_load) course.keep_load(*held_load);
}

void HoldStep::steer(const Sample& now, CrossheadCourse& course) {
  if (hold_load) course.move(course.velocity_at_load(now, speed));
}

void CycleStep::keys(fields::Fields& f, double) {
  f.low_high("extension", extension, {-100.0, 100.0, "m"});
  f.low_high("load", load, {-1e8, 1e8, "N"});
  speed_key(f);
  f.says("count; 0: no limit").integer("count", cycles, 0, 1000000);
  f.optional_number("time", time, {1e-3, 1e6, "s"}, "none");
}

void CycleStep::check(const StepPlace& place) const {
  const std::string key = place.key();
  if (extension.has_value() == load.has_value()) {
    const std::string has = load ? "both extension and load" : "neither extension nor load";
    throw InvalidInput::sentence(key, key + " has " + has + ": give one of them");
  }
  if (cycles == 0 && !time) throw InvalidInput::sentence(key, key + " has no end: give count, time or both");
}

double CycleStep::target() const {
  const fields::LowHigh& turns = extension ? *extension : *load;
  return outwards_ ? turns.high : turns.low;
}

void CycleStep::begin(const Sample&, CrossheadCourse&) {
  outwards_ = true;
  turns_ = 0;
}

void CycleStep::steer(const Sample& now, CrossheadCourse& course) {
  if (extension) return course.move(course.velocity_to_extension(target() - now.extension, speed));
  const double velocity = course.speed_to_load(now, target(), speed, true);
  course.move(outwards_ ? velocity : -velocity);
}

EndedBy CycleStep::ended(const Sample& now, CrossheadCourse& course) {
  const double sense = outwards_ ? 1.0 : -1.0;
  if (extension ? reached(now.extension, target(), sense, course.extension_tolerance(speed))
                : reached(balanced_load(now), target(), sense, kLoadTolerance * (load->high - load->low))) {
    outwards_ = !outwards_;
    course.forget_stiffness();
    ++turns_;
    if (cycles > 0 && turns_ >= 2 * cycles) return EndedBy::kProgram;
  }
  return time && course.over(*time) ? EndedBy::kProgram : EndedBy::kNotYet;
}

double CycleStep::usual_duration(const CrossheadCourse&) const {
  const double distance = extension ? extension->high - extension->low : kUsualDistance;
  const double whole = 2.0 * distance * cycles / speed;
  return cycles > 0 ? std::min(whole, time.value_or(whole)) : time.value_or(whole);
}

void ReturnStep::keys(fields::Fields& f, double) {
  speed_key(f);
  f.number("extension", extension, {-100.0, 100.0, "m"});
  f.optional_number("load", load, {-1e8, 1e8, "N"}, "none");
}

void ReturnStep::steer(const Sample& now, CrossheadCourse& course) {
  const double inwards = std::min(0.0, course.velocity_to_extension(extension - now.extension, speed));
  course.move(load ? std::max(inwards, -course.speed_to_load(now, *load, speed, true)) : inwards);
}

EndedBy ReturnStep::ended(const Sample& now, CrossheadCourse& course) {
  if (now.extension <= extension + course.extension_tolerance(speed)) return EndedBy::kExtension;
  const bool met = load && reached(balanced_load(now), *load, -1.0, kLoadTolerance * std::abs(course.begin_load()));
  return met ? EndedBy::kLoad : EndedBy::kNotYet;
}

double ReturnStep::usual_duration(const CrossheadCourse& course) const {
  return std::max(0.0, course.last().displacement - extension) / speed;
}

void TwistStep::keys(fields::Fields& f, double) {
  f.says("turns; of the upper clamp with all strands in it, right-handed about up")
      .required_number("turns", turns, {-1e4, 1e4, "-"});
  f.number("rate", rate, {1e-6, 10.0, "1/s"});
  f.optional_number("torque", torque, {1e-12, 1e6, "N m"}, "none");
  f.choice("control", hold_load, std::array{"extension", "load"});
  if (hold_load || f.lists_all()) speed_key(f);
}

void TwistStep::check(const StepPlace& place) const {
  if (!place.turns) place.misplaced("needs an upper grip that is a clamp on strands which form no loop");
  if (turns == 0.0) throw InvalidInput(place.key() + ".turns", format_number(turns), "other than 0");
}

/// The last of its periods turns by what is left.
void TwistStep::steer(const Sample& now, CrossheadCourse& course) {
  const double left = 2.0 * M_PI * turns - (now.turn - course.begin_turn()), most = 2.0 * M_PI * rate * course.period();
  course.turn(std::clamp(left, -most, most) / course.period());
  if (hold_load) course.move(course.velocity_at_load(now, speed));
}

EndedBy TwistStep::ended(const Sample& now, CrossheadCourse& course) {
  const double sense = turns > 0.0 ? 1.0 : -1.0, whole = 2.0 * M_PI * turns;
  if (reached(now.turn - course.begin_turn(), whole, sense, kTurnTolerance)) return EndedBy::kProgram;
  return torque && reached(now.torque, sense * *torque, sense, 0.0) ? EndedBy::kLoad : EndedBy::kNotYet;
}

double TwistStep::usual_duration(const CrossheadCourse&) const { return std::abs(turns) / rate; }

void FollowStep::check(const StepPlace& place) const {
  if (record.empty()) throw InvalidInput::missing(place.key() + ".record", "a curve.csv, or the folder of a run");
}

void FollowStep::steer(const Sample&, CrossheadCourse& course) {
  course.move((travel(course.time(1)) - travel(course.time())) / course.period());
}

double FollowStep::travel(double time) const {
  const auto after = std::lower_bound(recorded.begin(), recorded.end(), time,
                                      [](const RecordedPlace& row, double at) { return row.time < at; });
  if (after == recorded.begin()) return 0.0;
  if (after == recorded.end()) return recorded.back().displacement - recorded.front().displacement;
  const RecordedPlace &from = *(after - 1), &to = *after;
  const double fraction = (time - from.time) / (to.time - from.time);
  return from.displacement + fraction * (to.displacement - from.displacement) - recorded.front().displacement;
}

}  // namespace knot_utm
