#pragma once

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

/// Enters the contacts of one kind into the report of an iterate.
inline void report_contacts(const RodProperties& rod, const std::vector<ContactPoint>& contacts, Iterate& out) {
  for (const ContactPoint& contact : contacts) {
    out.active += contact.active() ? 1 : 0;
    if (!contact.touches()) continue;
    ++out.touching;
    if (out.in_contact && contact.overlap <= out.overlap) continue;
    out.in_contact = true;
    out.overlap = contact.overlap;
    out.roller = contact.roller;
    out.arclengths[0] = rod.place(contact.on_roller() ? rod.arclength()[contact.a0 + 1] : contact.arclength_a);
    out.arclengths[1] = rod.place(contact.arclength_b);
  }
}

/// The report of the present iterate, for whoever watches the solution.
template <typename Equation, typename Increment>
Iterate iterate_of(const Equation& equation, const Increment& increment) {
  Iterate out;
  out.residual = increment.worst_residual().residual;
  out.tolerance = increment.tolerance();
  out.node = increment.worst_residual().node;
  out.spin = increment.worst_residual().spin;
  out.factor = increment.factor();
  out.motion = increment.motion();
  report_contacts(equation.rod, equation.strands.points(), out);
  report_contacts(equation.rod, equation.rollers.points(), out);
  return out;
}

}  // namespace knot_utm
