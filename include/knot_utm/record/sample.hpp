#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/program.hpp"

namespace knot_utm {

/// What the crosshead does until `time`. The physics answers each command with the sample of the same time.
struct Command {
  std::uint64_t sequence = 0;  ///< counts commands from 0; the answering sample carries the same number
  double time = 0.0;           ///< [s]
  double displacement = 0.0;   ///< crosshead displacement at `time`, moving linearly since the last command [m]
  double velocity = 0.0;       ///< of the crosshead [m/s]
  int step = 0;                ///< index of the program's step; -1 before the first
  Phase phase = Phase::kIdle;
  double speed = 0.0;      ///< of the step: tie: speed of the tail grips [m/s]
  double duration = 0.0;   ///< of the step: release [s]
  bool balance = false;    ///< zero the load cell and the extension before moving on
  bool read_cell = false;  ///< `time` is a sampling instant of the load cell: `load` is its reading

  void state(Archive& archive);
};

/// How the physics stands after a command.
enum class BenchStatus {
  kRunning,          ///< the phase goes on
  kPhaseDone,        ///< tie, release, mount: its end condition is met
  kNotEquilibrated,  ///< tie, release: goes on as if at rest, which did not come in time; `message` says what moves
  kBroken,           ///< the rod parted; `message` says where
  kFailed            ///< the physics gave up; `message` says why
};

/// Whether the specimen is the knot that it began as.
enum class KnotType {
  kKept,
  kChanged,  ///< it came undone, or is another one now
  kCrossed   ///< the rod ran through itself
};

/// Where a rod parted.
enum class BreakPlace {
  kNone,    ///< it is whole
  kStrand,  ///< where it lies free
  kKnot,    ///< where another strand lies against it
  kGrip     ///< on a roller, or where a clamp or node holds it
};

/// One reading of the whole bench, at the physics' own accuracy but for `load`.
struct Sample {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t sequence = 0;
  double time = 0.0;  ///< [s]
  Phase phase = Phase::kIdle;
  double displacement = 0.0;     ///< of the crosshead [m]
  double extension = 0.0;        ///< s [m], growth of L since balance
  double end_to_end = 0.0;       ///< L [m]
  double knot_distance = kNone;  ///< e [m]; NaN: no two knots
  double load = 0.0;             ///< as the cell reads it at a sampling instant, else the balanced true force [N]
  double balance_offset = 0.0;   ///< true force on the upper grip that the cell reads as zero [N]
  double force_upper = 0.0;      ///< true force on the upper grip [N]
  double force_lower = 0.0;      ///< true force on the lower grip [N]
  double tail_force[2] = {kNone, kNone};     ///< tail grips while tying [N]
  double excess_length[2] = {kNone, kNone};  ///< rod length hidden in each knot [m]
  double max_penetration = 0.0;              ///< deepest contact [fraction of radius]
  double normal_force = 0.0;                 ///< sum over all rod-rod contacts [N]
  int contacts = 0;                          ///< contact points that carry force
  double fastest_node = 0.0;                 ///< [m/s]
  double stretching_energy = 0.0;            ///< [J]
  double bending_energy = 0.0;               ///< [J]
  double twisting_energy = 0.0;              ///< [J]
  double contact_energy = 0.0;               ///< [J]
  double kinetic_energy = 0.0;               ///< [J]
  double grip_work = 0.0;                    ///< done by grips and fixtures since the start [J]
  double dissipation = 0.0;                  ///< by friction and drag since the start [J]
  double friction_loss = 0.0;                ///< of which by friction [J]
  double numerical_dissipation = 0.0;        ///< by the time steps since the start [J]
  double reweighting_loss = 0.0;             ///< of contact energy as weights changed since the start [J]
  double moment_imbalance = 0.0;     ///< size of the sum of all moments on the rod, inertia and drag among them [N m]
  std::uint64_t steps = 0;           ///< time steps since the start
  std::uint64_t rejected_steps = 0;  ///< of which thrown away
  std::uint64_t newton_iterations = 0;  ///< since the start
  /// Balanced true force on the upper grip: largest and least of the command's time steps, of a time step its own [N].
  double highest_load = 0.0, lowest_load = 0.0;
  double break_arclength = kNone;  ///< of the place where the rod parted, from its first node [m]; NaN: it is whole
  BreakPlace break_place = BreakPlace::kNone;
  KnotType knot_type = KnotType::kKept;
  BenchStatus status = BenchStatus::kRunning;
  std::string message;
  double knots_force = kNone;  ///< between the coils of the two knots, the sum of normal forces [N]; NaN: no two knots
  double knot_on_roller = kNone;  ///< of rollers on the knots or their tails [N]; NaN: no two knots
  double raw_extension = kNone;   ///< travel of the crosshead since balance [m]; NaN: a rigid frame, on which it is s

  void state(Archive& archive);
};

}  // namespace knot_utm
