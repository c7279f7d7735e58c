#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/record/phase.hpp"

namespace knot_utm {

/// No crosshead and no tail grip of a method moves faster, nor does any testing machine [m/s].
inline constexpr double kFastestCrosshead = 0.5;

/// When a step ends: at the first condition that holds.
struct Until {
  std::optional<double> extension;  ///< s reaches it [m]
  std::optional<double> load;       ///< the balanced force reaches it [N]
  std::optional<double> time;       ///< time since the step began reaches it [s]
  bool broken = false;  ///< `break: true`: a break occurs; a break ends the whole test even where this is false
};

/// Two turning points of a cycle, the lower one first.
struct TurningPoints {
  double low = 0.0, high = 0.0;
};

/// Place of the crosshead at a time, from the record of another test.
struct RecordedPlace {
  double time = 0.0, displacement = 0.0;  ///< since the record began [s], [m]
};

/// How a user says that the raw data of a record are to be read (raw/raw_options.hpp); empty where nothing is said.
struct RecordWords {
  std::string columns, units, specimen, invert;
};

/// One step of the test program.
struct ProgramStep {
  Phase phase = Phase::kIdle;
  double speed = 0.0033;  ///< of the crosshead; where a load is asked for, the highest [m/s]; tie: of the tail grips
  double duration = 0.0;  ///< release: ramp and rest; hold: how long [s]
  double load = 0.0;      ///< preload: the load at which it ends [N]
  std::optional<double> load_rate;  ///< preload, pull: of load instead of extension [N/s]
  bool balance = true;              ///< preload: then load and extension are zero
  Until until;
  bool hold_load = false;                        ///< hold: the load, not the crosshead
  std::optional<double> held_load;               ///< hold: at this load [N]; unset: at that of the step's beginning
  std::optional<TurningPoints> extension_turns;  ///< cycle: between extensions [m] ...
  std::optional<TurningPoints> load_turns;       ///< ... or loads [N]
  int cycles = 0;                                ///< cycle: so many; 0: until `until.time` is over
  double return_extension = 0.0;                 ///< return: to this extension [m]
  std::string record;                            ///< follow: the file of the record
  RecordWords words;                             ///< and how it is read
  std::vector<RecordedPlace> recorded;           ///< and what it says once it has been read, times ascending from 0
};

using Program = std::vector<ProgramStep>;

/// Index of the step that is meant by a number from 0, or by a name that only one step has ("pull"); else nothing.
std::optional<int> step_called(const Program& program, const std::string& name);

}  // namespace knot_utm
