#include "examine_step.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

namespace knot_utm {

namespace {

/// Of point a against point b, or against where a roller ends up, in this step [m].
Vec3 slip(const ContactPoint& contact, const Points& way) {
  Vec3 out = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    out += contact.c[k] * way.col(contact.a0 + k);
    if (!contact.on_roller()) out += contact.c[3 + k] * way.col(contact.b0 + k);
  }
  if (contact.on_roller()) out -= carried_along(contact);
  return out;
}

std::string reason(const RodProperties& rod, const Passage& passage) {
  auto arclength = [&](int edge, double share) {
    return rod.rest_length.head(edge).sum() + share * rod.rest_length[edge];
  };
  std::ostringstream out;
  out << "strands would pass through each other at " << arclength(passage.edge_a, passage.on_a) << " m and "
      << arclength(passage.edge_b, passage.on_b) << " m along the rod";
  return out.str();
}

}  // namespace

void examine(const RodProperties& rod, const StepSettings& settings, const SolvedStep& step, ContactLists contacts,
             StrandPassage& passage, StepSummary& out) {
  for (Eigen::Index i = 0; i < rod.nodes(); ++i)
    out.largest_motion = std::max(out.largest_motion, step.way.col(i).norm());
  for (const std::vector<ContactPoint>& list : contacts)
    for (const ContactPoint& contact : list) {
      out.largest_overlap = std::max(out.largest_overlap, contact.overlap);
      out.largest_slip = std::max(out.largest_slip, slip(contact, step.way).norm());
    }
  if (out.largest_motion > settings.motion_limit)
    out.reason = "a node moved further than is allowed in one step";
  else if (out.largest_overlap > settings.overlap_limit)
    out.reason = "strands overlap more than is allowed after a step";
  else if (const std::optional<Passage> found = passage.find(step.start.position, step.end))
    out.reason = reason(rod, *found);
}

}  // namespace knot_utm
