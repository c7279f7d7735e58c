#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/program/program.hpp"

/// The steps of the test proper, once the specimen is prepared.
namespace knot_utm {

/// When a pull ends: at the first condition that holds.
struct Until {
  std::optional<double> extension;  ///< s reaches it [m]
  std::optional<double> load;       ///< the balanced force reaches it [N]
  std::optional<double> time;       ///< time since the step began reaches it [s]
  bool broken = false;  ///< `break: true`: the rod breaks; a break ends the whole test even where this is false
};

/// `pull`: moves outwards at `speed`, or so that the load grows at `load_rate`, until the first sample that meets one
/// of `until`. It may pass an extension by the motion in one period.
struct PullStep : Step {
  std::optional<double> load_rate;  ///< of load instead of extension [N/s]
  Until until;

  PullStep() : Step("pull", kMoves | kLoads | kPulls | kCanBreak, "at the first of `until`") {}
  void keys(fields::Fields& f, double usual_extension) override;
  void check(const StepPlace& place) const override;
  void begin(const Sample& now, CrossheadCourse& course) override;
  void steer(const Sample& now, CrossheadCourse& course) override;
  EndedBy ended(const Sample& now, CrossheadCourse& course) override;
  double usual_duration(const CrossheadCourse& course) const override;
};

/// `hold`: stands still, or keeps a load, for `duration`, rounded up to whole periods.
struct HoldStep : Step {
  bool hold_load = false;           ///< the load, not the crosshead
  std::optional<double> held_load;  ///< at this load [N]; unset: at that of the step's beginning

  HoldStep() : Step("hold", kRests | kCanBreak, "when the time is over") {}
  void keys(fields::Fields& f, double usual_extension) override;
  void check(const StepPlace& place) const override;
  bool loads() const override { return hold_load && held_load.value_or(0.0) > 0.0; }
  void begin(const Sample& now, CrossheadCourse& course) override;
  void steer(const Sample& now, CrossheadCourse& course) override;
};

/// `cycle`: moves out to the upper turning point, in to the lower one, and so on at `speed`, until the last of `cycles`
/// or for `time`. Extensions are reached exactly; on a compliant frame, within a thousandth of the motion in one
/// period.
struct CycleStep : Step {
  std::optional<fields::LowHigh> extension;  ///< turns between extensions [m] ...
  std::optional<fields::LowHigh> load;       ///< ... or loads [N]
  int cycles = 0;                            ///< 0: until `time` is over
  std::optional<double> time;                ///< [s]

  CycleStep() : Step("cycle", kMoves | kLoads | kPulls | kCanBreak, "after `count` cycles or `time`") {}
  void keys(fields::Fields& f, double usual_extension) override;
  void check(const StepPlace& place) const override;
  void begin(const Sample& now, CrossheadCourse& course) override;
  void steer(const Sample& now, CrossheadCourse& course) override;
  EndedBy ended(const Sample& now, CrossheadCourse& course) override;
  double usual_duration(const CrossheadCourse& course) const override;

 private:
  double target() const;  ///< the next turning point

  bool outwards_ = true;  // on the way to the upper turning point
  int turns_ = 0;         // so far
};

/// `return`: moves inwards at `speed` until the extension is `extension`, or the load `load`. It reaches an extension
/// as exactly as a cycle does.
struct ReturnStep : Step {
  double extension = 0.0;      ///< [m]
  std::optional<double> load;  ///< [N]

  ReturnStep() : Step("return", kMoves, "at the first of both, inwards") {}
  void keys(fields::Fields& f, double usual_extension) override;
  void steer(const Sample& now, CrossheadCourse& course) override;
  EndedBy ended(const Sample& now, CrossheadCourse& course) override;
  double usual_duration(const CrossheadCourse& course) const override;
};

/// `twist`: turns the upper clamp about the load axis by `turns` at `rate`, while the crosshead stands or keeps the
/// load with which the step begins; ends earlier where the torque of the clamp reaches `torque`
/// in the sense of the turn, as a command reads it.
struct TwistStep : Step {
  double turns = 0.0;            ///< from where it begins; right-handed about the axis, which points up [-]
  double rate = 0.5;             ///< magnitude [1/s]
  std::optional<double> torque;  ///< magnitude [N m]
  bool hold_load = false;        ///< the load, not the crosshead

  TwistStep() : Step("twist", kMoves, "at the first of both") {}
  void keys(fields::Fields& f, double usual_extension) override;
  void check(const StepPlace& place) const override;
  void steer(const Sample& now, CrossheadCourse& course) override;
  EndedBy ended(const Sample& now, CrossheadCourse& course) override;
  double usual_duration(const CrossheadCourse& course) const override;
};

/// Place of the crosshead at a time, from the record of another test.
struct RecordedPlace {
  double time = 0.0, displacement = 0.0;  ///< since the record began [s], [m]
};

/// `follow`: repeats the motion of a record from its present place, until the record ends.
struct FollowStep : Step {
  std::string record;                   ///< the file of the record
  std::vector<RecordedPlace> recorded;  ///< its rows once the file has been read, times ascending from 0

  FollowStep() : Step("follow", kMoves | kLoads | kPulls, "with the record") {}
  void keys(fields::Fields& f, double) override {
    f.says(
         "record; of the crosshead: a `curve.csv`, which [`import_instron`](results.md#raw-data) makes of raw data, or "
         "the folder of a run")
        .file("record", record);
  }
  void check(const StepPlace& place) const override;
  void steer(const Sample& now, CrossheadCourse& course) override;
  double usual_duration(const CrossheadCourse&) const override { return recorded.empty() ? 0.0 : recorded.back().time; }

 private:
  double travel(double time) const;  ///< of the crosshead in the record, linear between two rows [m]
};

}  // namespace knot_utm
