#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/machine/sample.hpp"
#include "knot_utm/machine/test_program.hpp"

namespace knot_utm {

/// Where the work of the grips went [J] (StepWork).
struct EnergyParts {
  double work = 0.0;
  double stored = 0.0;  ///< change of stretching, bending, twisting and contact energy
  double kinetic = 0.0;
  double friction = 0.0;
  double drag = 0.0;
  double numerical = 0.0;
  double reweighting = 0.0;

  double losses() const { return friction + drag + numerical + reweighting; }
  double gap() const { return work - stored - kinetic - losses(); }
};

/// What happened between two samples.
EnergyParts energy_between(const Sample& from, const Sample& to);

/// What became of F while the crosshead stood still.
struct Relaxation {
  double from;  ///< F where the hold begins, which is positive [N]
  double to;    ///< and where it ends [N]

  double lost() const { return (from - to) / from; }  ///< share of F [-]
};

/// What a test says: every measured key of result.yaml. A value that the test does not have is empty.
///
/// Symbols: s extension, F true force on the upper grip, s_l lock extension. F is not what the cell reads: balancing it
/// zeroes what the mounted specimen already carried, F = load + balance_offset but for noise and resolution.
/// "The pull" is the samples of phase `pull` that reach a new
/// largest s, up to a break.
struct Results {
  MotionPattern motion_pattern = MotionPattern::kNone;
  double motion_pattern_confidence = 0.0;  ///< 0 to 1, see MotionPatternTracker
  EndedBy ended_by = EndedBy::kNotYet;

  /// Sliding only: mean and standard deviation of F, weighted by extension, over s from 0.3 to 0.8 of s_l, or of the
  /// whole pull where it never locked. The breakaway lies before, the onset of locking behind. [N]
  std::optional<double> plateau_force;
  std::optional<double> plateau_force_sd;
  std::optional<double> plateau_slope;    ///< de/ds over the same part [-]; -2: rigid sliding
  std::optional<double> breakaway_force;  ///< sliding only: largest F up to 0.3 of s_l [N]
  std::optional<double> lock_extension;   ///< s_l, where sliding turned into stretching [m]

  /// Slope of F(s) where the rod carries the load: over the samples after s_l (stretching: all), up to the peak, whose
  /// F lies between half the peak and the peak, at least the last three. The middle one of the least-squares slopes in
  /// three parts of equal extension: strands that slip inside a locked knot let F fall at one place. [N/m]
  std::optional<double> locked_stiffness;
  std::optional<double> peak_force;       ///< largest F of the pull, and where the rod parted [N]
  std::optional<double> balance_offset;   ///< F that the cell reads as zero, once the pull begins [N]
  std::optional<double> break_extension;  ///< s where the rod parted [m]
  std::optional<double> break_arclength;  ///< of the place where it did, from its first node [m]
  BreakPlace break_place = BreakPlace::kNone;
  std::string failure_mode;  ///< sliding then fracture, stretching then fracture, fracture, untangling; empty: none

  // Of the pull, with the state that it began from as its origin (pull_readings.hpp).
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

  /// Largest size of the sum of all moments at the grips, of the pull / (peak force L). Inertia, drag and gravity leave
  /// some, and friction, which acts on the strands' centrelines (ContactReading::couple).
  std::optional<double> moment_balance_error;

  /// Largest |work of the grips - change of stored and kinetic energy - losses| since the first sample, over the
  /// largest of these three. Losses are those by friction, drag, time steps and changed weights, each by its own
  /// formula.
  std::optional<double> energy_balance_error;
  std::optional<EnergyParts> energy;  ///< from the beginning of the pull to the end of the test

  // Once tied and released; where nothing is tied: when the pull begins.
  std::optional<double> tied_knot_distance;                  ///< e [m]
  std::array<std::optional<double>, 2> tied_excess_length;   ///< rod hidden in each knot [m]
  std::array<std::optional<double>, 2> final_excess_length;  ///< and at the end of the test [m]
  double fastest_node = 0.0;  ///< of the pull until the knots lock [m/s]; above 0.1 m/s one opened

  std::uint64_t steps = 0;
  std::uint64_t rejected_steps = 0;
  std::uint64_t newton_iterations = 0;
  double simulated_time = 0.0;  ///< [s]
};

/// Evaluates a whole test; best from every accepted time step.
Results analyse(const std::vector<Sample>& samples, EndedBy ended_by);

}  // namespace knot_utm
