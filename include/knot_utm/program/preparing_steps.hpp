#pragma once

#include <optional>

#include "knot_utm/program/program.hpp"

namespace knot_utm {

/// A step that the machine does by itself, until it answers that it is done.
class BenchStep : public Step {
 public:
  EndedBy ended(const Sample& now, CrossheadCourse& course) override;

 protected:
  using Step::Step;
};

/// `tie`: the rig pulls the tails at `speed`; the crosshead stands.
struct TieStep : BenchStep {
  TieStep()
      : BenchStep("tie", kPrepares | kForms | kEndsByItself,
                  "when both grips slip at the pre-load and all is at rest") {
    speed = 0.01;
  }
  void keys(fields::Fields& f, double) override {
    f.says("speed; of the tail grips", "3.15 radii/s").scaled_number("speed", speed, kSpeeds);
  }
  void check(const StepPlace& place) const override;
  double usual_duration(const CrossheadCourse&) const override { return 10.0; }
};

/// `release`: the tails are let go in `duration`; the crosshead stands.
struct ReleaseStep : BenchStep {
  ReleaseStep() : BenchStep("release", kPrepares | kForms | kEndsByItself, "when nothing is held and all is at rest") {
    duration = 3.0;
  }
  void keys(fields::Fields& f, double) override { f.number("duration", duration, {1e-3, 1e4, "s"}); }
  void check(const StepPlace& place) const override;
};

/// `mount`: a loop is put on the rollers, and the crosshead moves outwards at `speed` to take up its slack.
struct MountStep : BenchStep {
  MountStep()
      : BenchStep("mount", kPrepares | kEndsByItself | kMoves,
                  "with the knots at `knot_distance` and `end_to_end`, and a load of 0.03 k_b/h²") {}
  void keys(fields::Fields& f, double) override { speed_key(f); }
  void check(const StepPlace& place) const override;
  void steer(const Sample& now, CrossheadCourse& course) override;
  double usual_duration(const CrossheadCourse&) const override { return kUsualDistance / speed; }
};

/// `preload`: moves outwards at `speed`, or so that the load grows at `load_rate`, until the load is `load`; then
/// balances, standing still for one command, if `balance` says so.
struct PreloadStep : Step {
  double load = 0.0;                ///< [N]
  std::optional<double> load_rate;  ///< of load instead of extension [N/s]
  bool balance = true;

  PreloadStep() : Step("preload", kPrepares | kMoves | kLoads | kCanBreak, "at the load") {}
  void keys(fields::Fields& f, double usual_extension) override;
  void begin(const Sample&, CrossheadCourse&) override { balancing_ = false; }
  void steer(const Sample& now, CrossheadCourse& course) override;
  EndedBy ended(const Sample& now, CrossheadCourse& course) override;
  double usual_duration(const CrossheadCourse&) const override { return kUsualDistance / speed; }

 private:
  bool balancing_ = false;  // the load is reached
};

/// `balance`: stands still for one command, which zeroes load cell and extension.
struct BalanceStep : Step {
  BalanceStep() : Step("balance", kPrepares, "at once, load and extension set to zero") {}
  void begin(const Sample& now, CrossheadCourse& course) override;
  double usual_duration(const CrossheadCourse& course) const override;
};

}  // namespace knot_utm
