#pragma once

#include "knot_utm/machine/accuracy.hpp"

/// The tolerances behind `physics.accuracy` and the errors beside readings: what was measured, and by which bench.
/// doc/measured.md lists these and all other constants that were measured or chosen.
namespace knot_utm::measured {

// Longest step [s], residual [k_b/h^2], contact tolerance [h], presliding [h], refinement [-]. `scripts/bench
// convergence` makes each of those of `normal` smaller, and compares with `fine`: bench/results/convergence.md.
inline constexpr Tolerances kDraft{0.34, 2e-4, 0.06, 4e-3, 1.3};
inline constexpr Tolerances kNormal{0.17, 1e-4, 0.005, 2e-3, 2.25};
inline constexpr Tolerances kFine{0.05, 1e-5, 0.0025, 1e-3, 3.0};

// For the loop of a rod that stretches.
inline constexpr Tolerances kStretchingDraft{0.34, 3e-4, 0.12, 2e-2, 1.0};
inline constexpr Tolerances kStretchingNormal{0.17, 2e-4, 0.08, 1e-2, 1.0};
inline constexpr Tolerances kStretchingFine{0.05, 1e-5, 0.01, 1e-3, 2.0};

// Under the tension T of its tying a rope's bends fade along a strand within sqrt(k_b/T): the harder it is tied, the
// shorter the edges that it takes. Beyond this pre-load [k_b/h^2] they are shorter by its fourth root, up to a third,
// by choice: the square root would ask for edges in nylon that are 2.4 times as short.
inline constexpr double kTiedHard = 6.0, kShortestForHard = 4.0 / 3.0;

// At `normal` with edges of h/2.25 (of a solid rod of h), meant to hold 95 % of the differences to `fine` with edges
// half as long, and to be hardly wider. Chosen after what scripts/bench readings drew with seeds 21, 25 and 28 to 30.
// How many of them these hold, and how many of other seeds, stands in doc/benchmarks.md.
inline constexpr double kPlateau = 0.043, kOppositePlateau = 0.067;  // of knots of the same hand, and of opposite ones
// Below this mu the knots are the less sure the nearer to opening.
inline constexpr double kSlippery = 0.65, kOppositeSlippery = 0.45, kLeastFriction = 0.1;
// Knots that slide under less [k_b/h^2] are hardly closed: any change of the mesh changes how far they are open.
inline constexpr double kHardlyClosed = 0.55;
inline constexpr double kLock = 0.0105, kOppositeLock = 0.027;
// The error of a solid rod's stiffness is that of its knots, whose share in the loop is h/L.
inline constexpr double kRopesStiffness = 0.006, kSolidsStiffnessOfKnots = 1.2;
inline constexpr double kStraightStiffness = 1e-3;  // an upper bound by judgement: exact but for the residual

// What each source of error contributes to the error at `normal` with edges of one radius [-]: they add up to 1. Chosen
// by hand together with the errors above, after the same draws; no bench varies one source at a time.
inline constexpr double kShareOfEdges = 0.5, kShareOfContactTolerance = 0.2, kShareOfPresliding = 0.1,
                        kShareOfStep = 0.1, kShareOfResidual = 0.1;

}  // namespace knot_utm::measured
