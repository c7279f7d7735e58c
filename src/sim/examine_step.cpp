#include "examine_step.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

namespace {

/// How far point a moved in this step against point b, or against where a roller ends up [m].
Vec3 slip(const ContactPoint& contact, const Points& increment) {
  Vec3 out = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    out += contact.c[k] * increment.col(contact.a0 + k);
    if (!contact.on_roller()) out += contact.c[3 + k] * increment.col(contact.b0 + k);
  }
  if (contact.on_roller()) out -= carried_along(contact);
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
