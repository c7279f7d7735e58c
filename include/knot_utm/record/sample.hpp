#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/record/per_knot.hpp"

namespace knot_utm {

/// State of the simulation after a command.
enum class BenchStatus {
  kRunning,          ///< the phase goes on
  kPhaseDone,        ///< tie, release, mount: its end condition is met
  kNotEquilibrated,  ///< tie, release: rest did not come in time and the test goes on; `message` says what moves
  kBroken,           ///< the rod parted; `message` says where
  kFailed            ///< the simulation gave up; `message` says why
};

/// One reading of the whole bench. Only `load` has the errors of the load cell. The meaning, the unit and the allowed
/// values of each field stand in record/sample_fields.hpp.
struct Sample {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  ///< for a value that does not exist
  std::uint64_t sequence = 0;
  double time = 0.0;
  Phase phase = Phase::kIdle;
  double displacement = 0.0;
  double extension = 0.0;
  double end_to_end = 0.0;
  double knot_distance = kNone;
  double load = 0.0;
  double balance_offset = 0.0;
  double force_upper = 0.0;
  double force_lower = 0.0;
  PerKnot tail_force;
  PerKnot excess_length;
  PerKnot tail_length;
  double max_penetration = 0.0;
  double normal_force = 0.0;
  int contacts = 0;
  double fastest_node = 0.0;
  double stretching_energy = 0.0;
  double bending_energy = 0.0;
  double twisting_energy = 0.0;
  double contact_energy = 0.0;
  double kinetic_energy = 0.0;
  double grip_work = 0.0;
  double dissipation = 0.0;
  double friction_loss = 0.0;
  double plastic_loss = 0.0;
  double numerical_dissipation = 0.0;
  double reweighting_loss = 0.0;
  double moment_imbalance = 0.0;
  std::uint64_t steps = 0;
  std::uint64_t rejected_steps = 0;
  std::uint64_t newton_iterations = 0;
  KnotType knot_type = KnotType::kKept;
  BenchStatus status = BenchStatus::kRunning;
  std::string message;
  double highest_load = 0.0;
  double lowest_load = 0.0;
  double break_arclength = kNone;
  BreakPlace break_place = BreakPlace::kNone;
  double knots_force = kNone;
  double knot_on_roller = kNone;
  double raw_extension = kNone;
  double turn = 0.0;
  double torque = kNone;
  PerKnot knot_readings;
  std::uint64_t half_iterations = 0;

  void state(Archive& archive);
};

/// The force on the upper grip less that which the cell reads as zero [N]. Steps that end, turn or are controlled by a
/// load use it instead of readings, so that the cell's errors and sampling rate do not change a test.
inline double balanced_load(const Sample& sample) { return sample.force_upper - sample.balance_offset; }

}  // namespace knot_utm
