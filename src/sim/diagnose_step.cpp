#include "diagnose_step.hpp"

#include <algorithm>
#include <optional>
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

namespace {

/// How far point a moved in this step against point b, or against where a roller ends up [m].
Vec3 slip(const ContactPoint& contact, const Points& increment) {
  Vec3 out = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    out += contact.c[k] * increment.col(contact.a0 + k);
    if (!contact.on_roller()) out += contact.c[3 + k] * increment.col(contact.b0 + k);
  }
  return out;
}

std::string reason(const RodProperties& rod, const Tunnelling& tunnelling) {
  std::ostringstream out;
  out << "strands would pass through each other at " << rod.place(tunnelling.edge_a, tunnelling.on_a) << " m and "
      << rod.place(tunnelling.edge_b, tunnelling.on_b) << " m along the rod";
  return out.str();
}

}  // namespace

void examine(const RodProperties& rod, const StepSettings& settings, const SolvedStep& step,
             const ContactLists& contacts, TunnellingSearch& tunnelling, StepSummary& out) {
  for (Eigen::Index i = 0; i < rod.nodes(); ++i)
    out.largest_motion = std::max(out.largest_motion, step.increment.col(i).norm());
  for (const std::vector<ContactPoint>& list : contacts)
    for (const ContactPoint& contact : list) {
      out.largest_overlap = std::max(out.largest_overlap, contact.overlap);
      out.largest_slip = std::max(out.largest_slip, slip(contact, step.increment).norm());
    }
  if (out.largest_motion > settings.motion_limit)
    out.reason = "a node moved further than is allowed in one step";
  else if (out.largest_overlap > settings.overlap_limit)
    out.reason = "strands overlap more than is allowed after a step";
  else if (const std::optional<Tunnelling> found = tunnelling.find(step.state.position, step.end))
    out.reason = reason(rod, *found);
}

}  // namespace knot_utm
