#include "knot_utm/program/preparing_steps.hpp"

#include "knot_utm/program/course.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

EndedBy BenchStep::ended(const Sample& now, CrossheadCourse&) {
  const bool done = now.status == BenchStatus::kPhaseDone || now.status == BenchStatus::kNotEquilibrated;
  return done ? EndedBy::kProgram : EndedBy::kNotYet;
}

void TieStep::keys(fields::Fields& f, double) { f.scaled_number("speed", speed, kSpeeds); }

void TieStep::check(const StepPlace& place) const {
  if (place.index != 0) place.misplaced("can only be the first step");
  place.needs(place.tied);
}

void ReleaseStep::keys(fields::Fields& f, double) { f.number("duration", duration, {1e-3, 1e4, "s"}); }

void ReleaseStep::check(const StepPlace& place) const {
  if (place.index != 1 || !place.program[0].as<TieStep>()) place.misplaced("can only stand right after tie");
}

void MountStep::keys(fields::Fields& f, double) { f.scaled_number("speed", speed, kSpeeds); }

void MountStep::check(const StepPlace& place) const {
  place.needs(place.loops);
  for (std::size_t i = 0; i < place.index; ++i)
    if (moves(place.program[i]->phase()))
      place.misplaced("can only stand before the first step that moves the crosshead");
}

void MountStep::steer(const Sample& now, CrossheadCourse& course) { course.move(now, speed); }

void PreloadStep::keys(fields::Fields& f, double) {
  f.required_number("load", load, {1e-6, 1e8, "N"});
  f.scaled_number("speed", speed, kSpeeds);
  f.optional_number("load_rate", load_rate, kLoadRates, "none");
  f.flag("balance", balance);
}

void PreloadStep::steer(const Sample& now, CrossheadCourse& course) {
  course.move(now, balancing_  ? 0.0
                   : load_rate ? course.velocity_at_load_rate(now, *load_rate, speed, load)
                               : course.speed_to_load(now, load, speed, true));
}

EndedBy PreloadStep::ended(const Sample& now, CrossheadCourse& course) {
  if (!balancing_ && !reached(balanced_load(now), load, 1.0, kMetLoad * load)) return EndedBy::kNotYet;
  if (balancing_ || !balance) return EndedBy::kLoad;
  balancing_ = true;
  course.balance();
  return EndedBy::kNotYet;
}

void BalanceStep::begin(const Sample&, CrossheadCourse& course) { course.balance(); }

double BalanceStep::usual_duration(const CrossheadCourse& course) const { return course.period(); }

}  // namespace knot_utm
