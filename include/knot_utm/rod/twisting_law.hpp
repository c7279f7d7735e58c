#pragma once

namespace knot_utm {

/// The interface of a twisting law. At every inner node a law gives the twisting moment as a function of the twist,
///
///     M = dE/dm.
///
/// A law is one header and one line in `TwistingLaws` (twisting_laws.hpp). It is a plain struct, which
///
///     static constexpr const char* kName          is what a method calls it (material.twisting_law, a key that is
///                                                 there as soon as there are two)
///     static constexpr std::array kKeys           its keys in `material` (LawKey), or NoKeys
///     static constexpr bool kStudied              whether the errors beside readings were studied with this law
///                                                 (machine/accuracy.hpp)
///     static Law of(Material)                     from a method; throws InvalidInput where a value is missing
///     respond(TwistedNode<Real>) -> TwistingResponse<Real>
///     state(Archive&)                             its parameters
///
/// An evaluation of the rod chooses the law once (std::visit), not at every node.

/// What a law is told of one inner node, or of four. `Real`: double, or Lanes.
template <typename Real>
struct TwistedNode {
  Real k_t_over_length;  ///< k_t/lbar, 0 at an edge that has parted [N m]
  Real twist;            ///< m - mbar [rad]
};

/// The energy of a node without stiffness is undefined and must not be read.
template <typename Real>
struct TwistingResponse {
  Real energy;   ///< E [J]
  Real moment;   ///< dE/dm [N m]
  Real tangent;  ///< d2E/dm2 [N m]
};

}  // namespace knot_utm
