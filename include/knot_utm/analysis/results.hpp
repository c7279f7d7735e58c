#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"
#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/analysis/sample_readings.hpp"
#include "knot_utm/record/ended_by.hpp"

namespace knot_utm {

/// The work of the grips and what became of it [J]. Each part is computed by its own formula (StepWork).
struct EnergyParts {
  double work = 0.0;         ///< of the grips on the specimen
  double stored = 0.0;       ///< change of the energies of stretching, bending, twisting and contact
  double kinetic = 0.0;      ///< change of the kinetic energy
  double friction = 0.0;     ///< loss by friction
  double plastic = 0.0;      ///< loss in bends that yield or whose fibres slide
  double drag = 0.0;         ///< loss by viscous drag
  double numerical = 0.0;    ///< loss by the time integration; negative: it added energy
  double reweighting = 0.0;  ///< loss by changes of the contacts' weights

  double losses() const { return friction + plastic + drag + numerical + reweighting; }
  double gap() const { return work - stored - kinetic - losses(); }  ///< 0 if the balance is exact
};

/// The parts of the energy balance between two samples.
EnergyParts energy_between(const Sample& from, const Sample& to);

/// The change of F while the crosshead stood still.
struct Relaxation {
  double from;  ///< F at the beginning of the hold, positive [N]
  double to;    ///< F at its end [N]

  double lost() const { return (from - to) / from; }  ///< fraction of F [-]
};

/// How much longer a specimen is than its gauge length, loaded and unloaded again.
///
/// Symbols: L_0 gauge length, the distance between the grips where the specimen is first pulled; L_1 that at the
/// outermost place of the last cycle, L_2 that where this cycle ends [m]. All elongations are shares [-]. With the load
/// at its lower end other than zero, "residual" includes what that load stretches beyond L_0.
struct Elongations {
  double total = 0.0;     ///< (L_1 - L_0)/L_0
  double residual = 0.0;  ///< (L_2 - L_0)/L_0, what has not come back
  double elastic = 0.0;   ///< (L_1 - L_2)/L_0, what has: total = elastic + residual
  double working = 0.0;   ///< (L_1 - L_2)/L_2, of the specimen that is bedded in, over its own length
};

/// The results of a test: every measured key of result.yaml. A value that the test does not have is empty.
///
/// Symbols: s extension, e knot distance, L end-to-end distance, F true force on the upper grip, s_l lock extension.
/// The load is the reading of the load cell. Balancing sets it to zero at what the mounted specimen already carries, so
/// F = load + balance_offset, apart from the errors of the cell. "The pull" means the samples of phases that pull which
/// reach a new largest s, up to a break.
struct Results {
  MotionPattern motion_pattern = MotionPattern::kNone;
  double motion_pattern_confidence = 0.0;  ///< 0 to 1; see MotionPatternTracker
  EndedBy ended_by = EndedBy::kNotYet;

  /// Readings of the load, from the readings of the cell alone, as they stand in curve.csv. `compare` finds the same
  /// from that file. The peak force also counts a rod that parted while nothing was pulled. A knot that came undone, or
  /// that was still sliding at the end, has no stiffness here.
  CurveReadings curve;

  // The same of the true force, at the same readings and over the same extensions [N]. Less balance_offset they equal
  // those of the load, apart from the errors of the cell.
  std::optional<double> true_plateau_force;
  std::optional<double> true_breakaway_force;
  std::optional<double> true_peak_force;  ///< empty where nothing was pulled, or only compressed
  std::optional<double> true_jump_force;
  std::optional<double> true_force_after_jump;

  // A specimen that is no loop of two knots may have these (Snap).
  std::optional<double> snap_extension;  ///< s at which it snapped into another shape [m]
  std::optional<double> snap_drop;       ///< by how much F fell then [N]

  /// The pull has readings, and F was never above a thousandth of the largest |F| in it: what rest leaves is no
  /// tension.
  bool never_in_tension = false;

  std::optional<double> plateau_slope;   ///< mean of de/ds over the plateau [-]; -2: rigid sliding on rollers
  std::optional<double> lock_extension;  ///< s_l, found from the knot distance: sliding became stretching there [m]
  std::optional<double> first_contact_extension;  ///< s at which the coils of the two knots first touch each other [m]
  /// s at which a roller first presses on a knot or its tail with 5 % of F or more [m]
  std::optional<double> roller_touched_at;
  std::optional<double> balance_offset;   ///< F at which the cell reads zero, as the pull begins [N]
  std::optional<double> break_extension;  ///< s at which the rod parted, if it was loaded by then [m]
  std::optional<double> break_arclength;  ///< arclength of the place where it parted, from the first node [m]
  BreakPlace break_place = BreakPlace::kNone;
  /// "sliding", "stretching" or "untangling then fracture", "fracture", or "untangling" (came undone); empty: none
  std::string failure_mode;

  // Readings of the pull. Its origin is the state from which it began (pull_readings.hpp).
  std::optional<double> steady_force;       ///< mean of F over the second half of the extension, where F is steady [N]
  std::optional<double> peak_extension;     ///< s at the reading with the largest load [m]
  std::optional<double> energy_to_peak;     ///< work up to the peak [J]
  std::optional<double> energy_to_break;    ///< work up to the break, where the rod broke [J]
  std::optional<double> chord_stiffness;    ///< from 10 % to 50 % of the peak [N/m]
  std::optional<double> secant_stiffness;   ///< from the origin to the peak [N/m]
  std::optional<double> tangent_stiffness;  ///< where the pull is steepest [N/m]

  std::optional<Relaxation> relaxation;  ///< of the last hold under load in which the crosshead stood still

  // Readings of the last step that cycles (pull_readings.hpp).
  std::size_t cycles = 0;                  ///< number of closed cycles
  std::optional<double> hysteresis;        ///< of the last closed cycle [J]
  std::optional<Elongations> elongations;  ///< of the last closed cycle

  std::optional<double> gauge_length;         ///< distance between the grips where the specimen is first pulled [m]
  std::optional<double> elongation_at_break;  ///< (L - L_0)/L_0, L where the rod parted, L_0 the gauge length [-]

  std::optional<double> untangled_at;    ///< time at which the knot came undone [s]; see MotionPatternTracker
  KnotType knot_type = KnotType::kKept;  ///< at the end of the test; see KnotWatch
  std::string not_equilibrated;          ///< empty: tying and release ended at rest; else what still moved
  std::optional<GripForces> at_start;    ///< where they differ most as the pull begins (forces_at_start)

  std::optional<double> peak_torque;    ///< largest magnitude once the clamp has been turned [N m]
  double tension_at_peak_torque = 0.0;  ///< [N]
  double span_at_peak_torque = 0.0;     ///< between the grips [m]

  double largest_thrust = 0.0;          ///< on the upper grip, of a rod that is compressed more than bent [N]
  double span_at_largest_thrust = 0.0;  ///< between the grips [m]

  double max_penetration = 0.0;  ///< largest overlap of the whole test [fraction of radius]
  /// largest difference of the forces on the two grips in the pull, over the peak force [-]
  std::optional<double> force_balance_error;

  /// Largest ratio of the size of the sum of all moments at the grips to the force [m], over the readings of the pull
  /// whose force is more than half of its median. A slack loop that swings bears nearly no force, so its readings are
  /// left out. The ratio would be zero in equilibrium without inertia, drag and gravity. Friction also contributes
  /// where the sections take only a part of its couple (ContactReading::couple).
  std::optional<double> moment_arm;

  /// Largest |work of the grips - change of stored and kinetic energy - losses| since the first sample, divided by the
  /// largest size that any of these three reaches [-]. The losses are those by friction, by bends that yield, by drag,
  /// by the time integration and by changed contact weights, each computed by its own formula.
  std::optional<double> energy_balance_error;
  std::optional<EnergyParts> energy;     ///< balance from the beginning of the pull to the break or the end of the test
  std::optional<double> kinetic_energy;  ///< at the break or the end of the test, where something was pulled [J]

  // The knot once it is tied and released. Where nothing is tied, these are readings at the beginning of the pull.
  std::optional<double> tied_knot_distance;  ///< e [m]
  PerKnot tied_excess_length;                ///< of each knot [m]; NaN: not read
  PerKnot final_excess_length;               ///< the same at the end of the test [m]
  PerKnot tail_slip;                         ///< rod length by which each free end ran into the knot in the pull [m]
  PerKnot knot_reading_begin;                ///< what the knot's file reads, where the pull begins [m]
  PerKnot knot_reading_end;                  ///< where it was last known in the pull [m]
  std::optional<double> knot_distance;       ///< e as the pull begins [m]
  /// MotionPatternTracker::opened_when_mounted [m]
  std::optional<double> opened_when_mounted;
  RateShares rate;            ///< how far the pull is from a quasi-static one
  double fastest_node = 0.0;  ///< largest speed of a node in the pull, until the knots lock [m/s]

  std::uint64_t steps = 0;
  std::uint64_t rejected_steps = 0;
  std::uint64_t newton_iterations = 0;
  double solved_by_half = 0.0;  ///< share of these that solved one half of a symmetric rod [-]
  double simulated_time = 0.0;  ///< [s]
};

/// Evaluates a whole test. `samples` are all accepted time steps, and `readings` those of them that the load cell read.
/// Readings after a break do not count. `on_rollers`: rollers hold the loop, not two of its nodes. `hung`: weight that
/// hangs on the rod [N]. `marks`: as of the tracker [m]. `steps`: the step of the program of each sample, which tells
/// two holds in a row apart; empty: phases tell where a step ends.
Results analyse(const std::vector<Sample>& samples, const std::vector<Sample>& readings, EndedBy ended_by,
                bool on_rollers, double hung = 0.0, double marks = 0.0, const std::vector<int>& steps = {});

}  // namespace knot_utm
