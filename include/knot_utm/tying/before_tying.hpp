#pragma once

#include <string>
#include <vector>

#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// What can be known before the first time step about the knots that a pre-load ties.
///
/// Symbols: h radius of the rod, k_b and k_s its bending and stretching stiffness, mu friction coefficient, F_p
/// pre-load, R radius of the coil's centreline.
///
/// Closing the coil. A coil under the tension T of its strand bears the bending moment k_b/R. In equilibrium the
/// tension balances this moment over half the radius, T R/2 = k_b/(4 R), so that R = sqrt(k_b/(2 T)). This is exact for
/// the loop of a loose overhand knot without friction. The tail's pull reaches the coil behind half a turn around the
/// strands in it, which leaves T = F_p exp(-pi mu) by the capstan law. The coil is closed at R = 2 h, where it lies on
/// the strands in it:
///
///   R = sqrt(k_b exp(pi mu)/(2 F_p)),     F_p(closed) = exp(pi mu) k_b/(8 h^2).
///
/// Measured over mu = 0.1 to 0.8 and F_p h^2/k_b = 0.02 to 20 (doc/developers/history.md): a coil that is
/// tied with F_p(closed) stays wider by 0.2 to 0.7 h than one that is tied with 20 k_b/h^2. A pull below exp(pi mu)
/// k_b/(2 R_0^2) does not move the sketched coil, R_0 = 4.7 h.
///
/// Strain. The outermost fibre of a bend of radius R is strained by h/R in addition to the F_p/k_s of the tension: h/R
/// is 1/4.7 in the sketched coil and up to 1/2 in one that lies on the strands in it.

/// Whether a pre-load ties the knot. The file of a knot may pull at no end: its sketched shape then only settles.
bool tied_by_preload(const SpecimenOptions& specimen);

/// Whether the pre-load has an effect: it ties the knot, or scales weights that hang on it.
bool preload_acts(const SpecimenOptions& specimen);

/// Least F_p that closes the coils [N].
double closing_preload(const Material& material);

/// R to which a pre-load [N] bends a free coil [m].
double coil_radius(const Material& material, double preload);

/// Throws InvalidInput (specimen.preload, material.breaking.bending_share) where the knot cannot be tied.
void check_tying(const SpecimenOptions& specimen, const Material& material);

/// Warnings about what makes tying doubtful but not impossible, one line each, with its figure.
std::vector<std::string> tying_warnings(const SpecimenOptions& specimen, const Material& material,
                                        const PhysicsOptions& physics);

}  // namespace knot_utm
