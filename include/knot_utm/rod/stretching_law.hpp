#pragma once

namespace knot_utm {

/// The interface of a stretching law. For every edge a law gives the tension as a function of the stretch lambda =
/// |e|/l0,
///
///     T = dW/dlambda,   l0 W the energy that the edge stores.
///
/// A law is one header and one line in `StretchingLaws` (stretching_laws.hpp). It is a plain struct, which has
///
///     static constexpr const char* kName          the name that methods use (material.stretching_law)
///     static constexpr std::array kKeys           its keys in `material` (LawKey), or NoKeys
///     static constexpr bool kStudied              whether the errors beside readings were studied with this law
///                                                 (settings/accuracy.hpp)
///     static Law of(Material)                     made from a method; throws InvalidInput where a value is missing
///     respond(StretchedEdge)                      -> StretchingResponse
///     strain(k_s, T)                              -> lambda - 1 of an edge that bears T >= 0, the inverse of `respond`
///
/// With every law k_s is the stiffness dT/dlambda at rest, so that k_s can serve as the scale of the tension. An edge
/// that has parted has k_s = 0 and bears no tension.
///
/// An evaluation of the rod chooses the law once (std::visit), not at every edge.

/// What a law is told of one edge.
struct StretchedEdge {
  double k_s;          ///< stiffness [N]
  double rest_length;  ///< l0 [m]
  double stretch;      ///< lambda, more than 0 [-]
};

/// The energy of an edge without stiffness (k_s = 0) is undefined and must not be read.
struct StretchingResponse {
  double energy;   ///< l0 W [J]
  double tension;  ///< T, positive pulls [N]
  double slope;    ///< dT/dlambda [N]
};

}  // namespace knot_utm
