#include "diagnose_step.hpp"

#include <cmath>

namespace knot_utm {

namespace {

/// The deepest contact that the node of the diagnosis has a part in.
void find_contact(const std::vector<ContactPoint>& contacts, StepDiagnosis& out) {
  for (const ContactPoint& contact : contacts) {
    const auto stands_on = [&](int first) { return out.node >= first && out.node < first + 3; };
    const bool part = stands_on(contact.a0) || (!contact.on_roller() && stands_on(contact.b0));
    if (!part || !contact.touches() || (out.in_contact && contact.overlap <= out.overlap)) continue;
    out.in_contact = true;
    out.roller = contact.roller;
    out.contact_arclengths[0] = contact.arclength_a;
    out.contact_arclengths[1] = contact.arclength_b;
    out.overlap = contact.overlap;
    out.slides = contact.z.squaredNorm() > 0.99;
  }
}

}  // namespace

StepDiagnosis diagnose(const RodProperties& rod, const SolvedStep& step, bool converged, ContactLists contacts) {
  StepDiagnosis out;
  double worst = -1.0;
  for (int i = 0; i < static_cast<int>(rod.nodes()); ++i) {
    const auto node = static_cast<std::size_t>(i);
    const double residual = step.held[node] ? 0.0 : to_vec3(step.force[node]).norm();
    const double motion = step.way.col(i).norm();
    const double here = converged ? motion : residual;
    if (std::isfinite(here) && here <= worst) continue;
    worst = here;
    out.node = i;
    out.residual = residual;
    out.motion = motion;
    if (!std::isfinite(here)) break;
  }
  out.arclength = rod.rest_length.head(out.node).sum();
  for (const std::vector<ContactPoint>& list : contacts) find_contact(list, out);
  return out;
}

}  // namespace knot_utm
