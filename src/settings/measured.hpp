#pragma once

#include "knot_utm/settings/accuracy.hpp"

/// The tolerances behind `physics.accuracy`, and the constants of the errors that are reported beside readings.
/// doc/developers/measured.md says which measurement gave them, as all other constants that decide what is measured.
namespace knot_utm::measured {

// Longest step [s], residual [k_b/h^2], contact tolerance [h], presliding displacement [h], refinement [-].
// The bench `convergence` reduced each tolerance of `normal` and compared the readings with those of `fine`:
// bench/results/convergence.md (doc/developers/history.md).
inline constexpr Tolerances kDraft{0.34, 2e-4, 0.06, 4e-3, 1.3};
inline constexpr Tolerances kNormal{0.17, 1e-4, 0.005, 2e-3, 2.25};
inline constexpr Tolerances kFine{0.05, 1e-5, 0.0025, 1e-3, 3.0};

// The same for a rope whose strands roll (friction_couple above 0). Its steps are limited by where Newton's method
// converges, and these tolerances save a third of the work. They change the plateaus of nylon and polypropylene by 2.4
// % at most from `fine` (pre-loads 20, 50 and 150 N).
inline constexpr Tolerances kRollingNormal{0.17, 2e-4, 0.02, 5e-3, 2.0};

// The same for a loop of a stretchy rod. With a tenth of these residuals its readings are the same, and it takes 11 to
// 16 % more iterations.
inline constexpr Tolerances kStretchingDraft{0.34, 2e-3, 0.12, 2e-2, 1.0};
inline constexpr Tolerances kStretchingNormal{0.17, 2e-3, 0.08, 1e-2, 1.0};
inline constexpr Tolerances kStretchingFine{0.05, 1e-5, 0.01, 1e-3, 2.0};

// The same for a solid rod between clamps whose knot is drawn open, or whose shape is from a file, and whose strands
// roll. Its swing decides how far its force is off, and finer tolerances do not change it: over twelfths of the pull of
// open overhands with one to three turns the mean force differs from that of `fine` by 0.5 to 1.3 %, and by 0.4 to 1.3
// % with those of ropes.
inline constexpr Tolerances kOpenDraft{0.34, 7.5e-2, 0.2, 4e-2, 1.0};
inline constexpr Tolerances kOpenNormal{0.17, 3e-2, 0.1, 2e-2, 1.0};

// A rope that is tied with the tension T has bends that decay along a strand within sqrt(k_b/T). The harder it is tied,
// the shorter its edges must be. Beyond this pre-load [k_b/h^2] the edges are shorter by its fourth root, but by a
// third at most. The fourth root was chosen because the square root would need edges in nylon that are 2.4 times as
// short.
inline constexpr double kTiedHard = 6.0, kShortestForHard = 4.0 / 3.0;

// Relative errors at `normal` with edges of h/2.25 (h/2 where strands of rope roll, h for a solid rod). They are meant
// to include 95 % of the differences from `fine` with edges half as long, a quarter of the presliding displacement and
// steps of 0.025 s at most; doc/developers/benchmarks.md says how many they include. Two knots of the same handedness:
// nearly all plateaus are too low, and the more so the smaller mu is.
inline constexpr double kPlateau = 0.06, kRollingPlateau = 0.09, kSlippery = 0.8, kLeastFriction = 0.1;
// Where strands roll and friction among fibres holds bends, the force grows faster than M0 mu as the knots come near to
// locking themselves, and so does its error: by 1 + (M0 mu/kNearLocking)^2, with M0 in k_b/h.
inline constexpr double kNearLocking = 0.07;
// The load at which a knot parts whose bend helps to part it, with edges of h; and where contacts that press it flat
// help, too, whose forces converge more slowly than bends.
inline constexpr double kBreakInBend = 0.06, kBreakCrushed = 0.1;
// Two knots of opposite handedness: the plateau is one of a distribution. Small changes of mesh, tolerances or specimen
// move it by as much, in either direction, whatever mu is. The latter where strands roll.
inline constexpr double kOppositePlateau = 0.25, kOppositeRollingPlateau = 0.43;
// Knots that slide under a smaller force than this [k_b/h^2] are hardly closed. Their errors are not known, but where
// strands roll: there those of plateau and lock are larger by these factors, but the former is no larger than that of
// knots of opposite handedness.
inline constexpr double kHardlyClosed = 0.15, kHardlyClosedPlateau = 2.0, kHardlyClosedLock = 2.0;
// The lock extension, with two knots of the same handedness, of opposite handedness, and of the latter that roll.
inline constexpr double kLock = 0.014, kOppositeLock = 0.045, kOppositeRollingLock = 0.055;
// The locked stiffness of a rope, and that of a solid rod. The latter is multiplied by h over the distance of the
// grips, because the error arises in the knots, which are the smaller a part of a loop the longer it is.
inline constexpr double kRopesStiffness = 0.010, kSolidsStiffnessOfKnots = 1.2;
// The locked stiffness where strands roll, of a rope and of any rod whose knots are of opposite handedness.
inline constexpr double kRollingStiffness = 0.016, kOppositeRollingStiffness = 0.14;
// Loops whose sections give: plateau, lock and stiffness, the last one with knots of the same handedness. A plateau of
// knots that are not hardly closed is that of knots which nearly stretch. In five of six loops it is 34 to 97 % larger
// with finer edges, which no error tells. Where knots are hardly closed, the error is the share kSoftHardlyClosed of
// it.
inline constexpr double kSoftPlateau = 0.6, kSoftHardlyClosed = 0.25, kSoftLock = 0.25, kSoftStiffness = 0.1;
// an upper bound by judgement: the solution is exact except for the residual
inline constexpr double kStraightStiffness = 1e-3;

// The largest load of a knot from a file, in a solid rod and in a rope that slips at less than its pre-load. They hold
// 21 of 22 and 13 of 13 means of two starts (bench/results/knots.md, and six other knots). Of six more, tried once they
// were set, they hold 11 of 12, one being off by 10.3 % while the error of the finer mean is 9 %, and 2 of 2.
inline constexpr double kSketchedInSolid = 0.10, kSketchedInRope = 0.15;

// Fraction of the error that each source contributes at `normal` with edges of one radius [-]; they sum to 1. For the
// same draws each source by itself was reduced: edges to a half, contact tolerance to a half, presliding displacement
// and longest step to a quarter, residual to a tenth. The mean changes of a plateau, extrapolated to nothing, gave
// these.
inline constexpr double kFractionOfEdges = 0.4, kFractionOfContactTolerance = 0.05, kFractionOfPresliding = 0.3,
                        kFractionOfStep = 0.2, kFractionOfResidual = 0.05;

}  // namespace knot_utm::measured
