#pragma once

namespace knot_utm {

/// The interface of a pressure law. At every contact a law gives the line pressure p [N/m] of an overlap D [m]. It is
/// elastic, with the energy e(D) per length of rod,
///
///     p = de/dD,
///
/// and has no internal variables. Contacts along smooth centrelines and on rollers use such a law. EdgeLaw has the
/// same interface for one contact at a time.
///
/// A law is one header and one line in `PressureLaws` (pressure_laws.hpp). With the second law a method gets the key
/// `material.pressure_law` by itself; while there is one law, there is nothing to choose. It is a plain struct, which
/// has
///
///     static constexpr const char* kName     the name that methods use
///     static constexpr std::array kKeys      its keys in `material` (LawKey), or NoKeys
///     static constexpr bool kStudied         whether the errors beside readings were studied with this law
///                                            (machine/accuracy.hpp)
///     static Law of(Material, PressureScales)
///                                            made from a method; throws InvalidInput where a value is missing
///     double stiffness, tolerance            K [N/m^2], the scale of its slope, and delta [m], the scale of the
///                                            overlaps within which it rounds the corner where strands just touch;
///                                            EdgeLaw uses both
///     begin()                                overlap at which strands begin to feel each other, at most 0 [m]
///     pressure(D)                            p [N/m], 0 up to begin() and more than 0 beyond
///     slope(D)                               dp/dD [N/m^2], not negative
///     overlap_at(p)                          the overlap at which p is the pressure, p >= 0 [m]
///     energy(D)                              e [N]; of a double only
///     stiffens_at()                          overlap beyond which the tangent is too stiff a guess for a contact that
///                                            is new; infinity: nowhere [m]
///     state(Archive&)                        its parameters
///
/// pressure, slope and overlap_at are templates: of a double, or of Lanes for four contacts side by side. An evaluation
/// of all contacts chooses the law once (std::visit), not at every contact.

/// What a law's parameters depend on besides the material.
struct PressureScales {
  double tolerance = 0.0;  ///< delta [m]
};

}  // namespace knot_utm
