#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"
#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/analysis/rate_shares.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// Where the work of the grips went [J] (StepWork).
struct EnergyParts {
  double work = 0.0;
  double stored = 0.0;  ///< change of stretching, bending, twisting and contact energy
  double kinetic = 0.0;
  double friction = 0.0;
  double plastic = 0.0;  ///< of bends that yield (bending_law: plastic)
  double drag = 0.0;
  double numerical = 0.0;
  double reweighting = 0.0;

  double losses() const { return friction + plastic + drag + numerical + reweighting; }
  double gap() const { return work - stored - kinetic - losses(); }
};

/// What happened between two samples.
EnergyParts energy_between(const Sample& from, const Sample& to);

/// What became of F while the crosshead stood still.
struct Relaxation {
  double from;  ///< F where the hold begins, which is positive [N]
  double to;    ///< and where it ends [N]

  double lost() const { return (from - to) / from; }  ///< fraction of F [-]
};

/// What a test says: every measured key of result.yaml. A value that the test does not have is empty.
///
/// Symbols: s extension, F true force on the upper grip, s_l lock extension. The load is what the cell reads: balancing
/// it zeroes what the mounted specimen already carried, F = load + balance_offset but for the cell's own errors.
/// "The pull" is the samples of phase `pull` that reach a new largest s, up to a break.
struct Results {
  MotionPattern motion_pattern = MotionPattern::kNone;
  double motion_pattern_confidence = 0.0;  ///< 0 to 1, see MotionPatternTracker
  EndedBy ended_by = EndedBy::kNotYet;

  /// Of the load, by the cell's readings alone, as they stand in curve.csv: what `compare` says of that file. The peak
  /// is also that of a rod that parted where nothing pulled. A knot that came undone, or that still slides, has no
  /// stiffness here.
  CurveReadings curve;

  // Of the true force, at the same readings and over the same extensions: these less balance_offset are those of the
  // load, but for the cell's own errors. [N]
  std::optional<double> true_plateau_force;
  std::optional<double> true_breakaway_force;
  std::optional<double> true_peak_force;
  std::optional<double> true_jump_force;
  std::optional<double> true_force_after_jump;

  std::optional<double> plateau_slope;   ///< de/ds over the plateau [-]; -2: rigid sliding
  std::optional<double> lock_extension;  ///< s_l, where the knots' distance tells that sliding became stretching [m]
  std::optional<double> first_contact_extension;  ///< s where the coils of the two knots first touch each other [m]
  std::optional<double> roller_touched_at;  ///< s where rollers first bear on a knot or its tail, 5 % of F or more [m]
  std::optional<double> balance_offset;     ///< F that the cell reads as zero, once the pull begins [N]
  std::optional<double> break_extension;    ///< s where the rod parted [m]
  std::optional<double> break_arclength;    ///< of the place where it did, from its first node [m]
  BreakPlace break_place = BreakPlace::kNone;
  std::string failure_mode;  ///< sliding then fracture, stretching then fracture, fracture, untangling; empty: none

  // Of the pull, with the state that it began from as its origin (pull_readings.hpp).
  std::optional<double> steady_force;       ///< mean over the second half of the way, where it is level [N]
  std::optional<double> energy_to_peak;     ///< [J]
  std::optional<double> energy_to_break;    ///< where the rod broke [J]
  std::optional<double> chord_stiffness;    ///< from 10 % to 50 % of the peak [N/m]
  std::optional<double> secant_stiffness;   ///< from the origin to the peak [N/m]
  std::optional<double> tangent_stiffness;  ///< where the pull is steepest [N/m]

  std::optional<Relaxation> relaxation;  ///< of the last hold under a load

  // Of the last step that cycles (cycles.hpp).
  std::size_t cycles = 0;            ///< that were closed
  std::optional<double> hysteresis;  ///< of the last of them [J]

  std::optional<double> untangled_at;    ///< time [s], see MotionPatternTracker
  KnotType knot_type = KnotType::kKept;  ///< at the end, see KnotWatch
  std::string not_equilibrated;          ///< empty: tying and release ended at rest; else what still moved

  double max_penetration = 0.0;               ///< [fraction of radius], over the whole test
  std::optional<double> force_balance_error;  ///< largest |upper - lower| of the pull / peak force

  /// Largest size of the sum of all moments at the grips over the present force [m], of readings of the pull that bear
  /// half of its median force: a slack loop that swings bears next to nothing. Inertia, drag and gravity leave some,
  /// and so does friction whose couple the sections do not take (ContactReading::couple).
  std::optional<double> moment_arm;

  /// Largest |work of the grips - change of stored and kinetic energy - losses| since the first sample, over the
  /// largest of these three. Losses are those by friction, drag, time steps and changed weights, each by its own
  /// formula.
  std::optional<double> energy_balance_error;
  std::optional<EnergyParts> energy;  ///< from the beginning of the pull to the end of the test

  // Once tied and released; where nothing is tied: when the pull begins.
  std::optional<double> tied_knot_distance;  ///< e [m]
  PerKnot tied_excess_length;                ///< rod hidden in each knot [m]; NaN: not read
  PerKnot final_excess_length;               ///< and at the end of the test [m]
  /// By which the knots came nearer to each other between release and pull, where that is a twentieth of e or more: a
  /// knot opened as the loop was mounted [m].
  std::optional<double> opened_when_mounted;
  RateShares rate;            ///< what speed has a share in
  double fastest_node = 0.0;  ///< of the pull until the knots lock [m/s]

  std::uint64_t steps = 0;
  std::uint64_t rejected_steps = 0;
  std::uint64_t newton_iterations = 0;
  double simulated_time = 0.0;  ///< [s]
};

/// Evaluates a whole test from every accepted time step, and from those of the samples that are readings of the load
/// cell; a break ends them.
Results analyse(const std::vector<Sample>& samples, const std::vector<Sample>& readings, EndedBy ended_by);

/// Of a cell that reads at every one of the samples.
Results analyse(const std::vector<Sample>& samples, EndedBy ended_by);

}  // namespace knot_utm
