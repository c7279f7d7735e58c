#include "diagnose_step.hpp"

#include <sstream>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

namespace {

/// The deepest contact that the node of the diagnosis has a part in.
void find_contact(const RodProperties& rod, const std::vector<ContactPoint>& contacts, StepDiagnosis& out) {
  for (const ContactPoint& contact : contacts) {
    const auto stands_on = [&](int first) { return out.node >= first && out.node < first + 3; };
    const bool part = stands_on(contact.a0) || (!contact.on_roller() && stands_on(contact.b0));
    if (!part || !contact.touches() || (out.in_contact && contact.overlap <= out.overlap)) continue;
    out.in_contact = true;
    out.roller = contact.roller;
    out.contact_arclengths[0] = rod.place(contact.arclength_a);
    out.contact_arclengths[1] = rod.place(contact.arclength_b);
    out.overlap = contact.overlap;
    out.slides = contact.z.squaredNorm() > 0.99;
  }
}

}  // namespace

StepDiagnosis diagnose(const RodProperties& rod, const SolvedStep& step, int node, double residual,
                       const ContactLists& contacts) {
  StepDiagnosis out;
  out.node = node;
  out.arclength = rod.place(rod.rest_length.head(node).sum());
  out.residual = residual;
  out.motion = step.increment.col(node).norm();
  for (const std::vector<ContactPoint>& list : contacts) find_contact(rod, list, out);
  return out;
}

std::string StepDiagnosis::text() const {
  if (node < 0) return "no node stands out";
  std::ostringstream out;
  out << "the residual is largest at node " << node << ", " << arclength << " m along the rod: " << residual
      << " N; the node moved " << motion << " m and touches ";
  if (!in_contact) return out.str() + "nothing";
  if (roller >= 0) {
    out << "roller " << roller;
  } else {
    out << "another strand, " << contact_arclengths[0] << " m along the rod at " << contact_arclengths[1] << " m";
  }
  out << ", with an overlap of " << overlap << " m, " << (slides ? "sliding" : "sticking");
  return out.str();
}

}  // namespace knot_utm
