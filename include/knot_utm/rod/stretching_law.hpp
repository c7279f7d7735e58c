#pragma once

namespace knot_utm {

/// The face of a stretching law. Of every edge a law says which tension its stretch lambda = |e|/l0 needs,
///
///     T = dW/dlambda,   l0 W the energy that the edge stores.
///
/// A law is one header and one line in `StretchingLaws` (stretching_laws.hpp). It is a plain struct, which
///
///     static constexpr const char* kName          is what a method calls it (material.stretching_law)
///     static constexpr bool kStudied              whether the errors beside readings were studied with this law
///                                                 (machine/accuracy.hpp)
///     static Law of(Material)                     from a method; throws InvalidInput where a value is missing
///     respond(StretchedEdge) -> StretchingResponse
///     state(Archive&)                             its parameters
///
/// k_s is the stiffness dT/dlambda at rest with every law, so that all that needs a scale of the tension takes k_s. An
/// edge that has parted has k_s = 0, and then no tension. The tension depends on the present stretch alone: a law that
/// remembers would keep what it remembers in the rod's state, as bending does (bending_law.hpp).
///
/// A whole rod is visited once per evaluation (std::visit), so that no edge pays for the choice.

/// What a law is told of one edge.
struct StretchedEdge {
  double stiffness;    ///< k_s [N]
  double rest_length;  ///< l0 [m]
  double stretch;      ///< lambda, more than 0 [-]
};

/// No energy is read of an edge without stiffness.
struct StretchingResponse {
  double energy;   ///< l0 W [J]
  double tension;  ///< T, positive pulls [N]
  double slope;    ///< dT/dlambda [N]
};

}  // namespace knot_utm
