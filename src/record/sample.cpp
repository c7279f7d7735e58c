#include "knot_utm/record/sample.hpp"

namespace knot_utm {

// In the order of the journal's version 3: another one is another version (src/io/journal.cpp).

void Command::state(Archive& archive) {
  archive(sequence, time, displacement, velocity, step);
  archive.choice("phase", phase, Phase::kDone);
  archive(speed, duration, balance, read_cell);
}

void Sample::state(Archive& archive) {
  archive(sequence, time);
  archive.choice("phase", phase, Phase::kDone);
  archive(displacement, extension, end_to_end, knot_distance, load, balance_offset, force_upper, force_lower,
          tail_force, excess_length, max_penetration, normal_force, contacts, fastest_node, stretching_energy,
          bending_energy, twisting_energy, contact_energy, kinetic_energy, grip_work, dissipation, friction_loss,
          numerical_dissipation, reweighting_loss, moment_imbalance, steps, rejected_steps, newton_iterations);
  archive.choice("knot type", knot_type, KnotType::kCrossed);
  archive.choice("status", status, BenchStatus::kFailed);
  archive(message, highest_load, lowest_load, break_arclength);
  archive.choice("place of the break", break_place, BreakPlace::kGrip);
  archive(knots_force, knot_on_roller, raw_extension);
}

}  // namespace knot_utm
