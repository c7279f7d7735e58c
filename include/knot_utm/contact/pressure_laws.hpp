#pragma once

#include <variant>

#include "knot_utm/contact/normal_law.hpp"

namespace knot_utm {

/// All pressure laws. At every contact a law gives the line pressure p [N/m] of an overlap D [m]. It is elastic, with
/// the energy e(D) per length of rod,
///
///     p = de/dD,
///
/// and has no internal variables. Contacts along smooth centrelines and on rollers use one of these laws. EdgeLaw has
/// the same interface for one contact at a time.
///
/// A law is one header and one line here. It is a plain struct, which has
///
///     static constexpr const char* kName     its name
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
using PressureLaws = std::variant<NormalLaw>;

inline double begin_of(const PressureLaws& law) {
  return std::visit([](const auto& own) { return own.begin(); }, law);
}

/// e(D) [N]
inline double energy_of(const PressureLaws& law, double overlap) {
  return std::visit([&](const auto& own) { return own.energy(overlap); }, law);
}

}  // namespace knot_utm
