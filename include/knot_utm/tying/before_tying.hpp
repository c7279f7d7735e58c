#pragma once

#include <string>
#include <vector>

#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// What can be known before the first time step about the knots that a pre-load F_p ties (doc/model.md, section 9).
///
/// A coil of radius R under the tension T of its strand is in equilibrium where T R/2 = k_b/(4 R). By the capstan law,
/// T = F_p exp(-pi mu) is left of the tail's pull behind half a turn around the strands in the coil. It is closed at
/// R = 2 h, where it lies on these strands:
///
///   R = sqrt(k_b exp(pi mu)/(2 F_p)),     F_p(closed) = exp(pi mu) k_b/(8 h^2)
///
/// With h radius of the rod, k_b bending stiffness, mu friction coefficient. The outermost fibre of the coil has the
/// strain h/R on top of that by the tension: 1/4.7 in the sketched coil, up to 1/2 in one that is closed.

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
