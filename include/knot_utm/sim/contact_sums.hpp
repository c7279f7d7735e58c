#pragma once

#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/contact_force.hpp"
#include "knot_utm/sim/pressing.hpp"

namespace knot_utm {

/// Nodes of the rod from one to another.
struct NodeRange {
  int first = 0, last = -1;

  bool empty() const { return last < first; }
  bool holds(int node) const { return first <= node && node <= last; }
};

/// Sum of the normal forces of contacts between two pieces of the rod [N].
double normal_force_between(const std::vector<ContactPoint>& contacts, const NodeRange& a, const NodeRange& b);

/// Sum of the normal forces of rollers on a piece of the rod [N].
double roller_normal_force(const std::vector<ContactPoint>& contacts, const NodeRange& piece);

/// Adds to each node's force [N] its share of the normal forces of these contacts on the rod: w p, shared among the
/// nodes of either point by those of its weights c_k that are of its side's sign. For pictures: by the other weights of
/// a smooth centreline a strand would pull at its neighbours.
void add_normal_forces(const std::vector<ContactPoint>& contacts, Eigen::VectorXd& force);

/// Adds the same forces to what presses on each node.
void add_pressing(const std::vector<ContactPoint>& contacts, Pressing& pressing);

/// The forces of those contacts that touch between strands; a law has evaluated all of them at `position`.
std::vector<ContactForce> contact_forces(const std::vector<ContactPoint>& contacts, const Points& position);

}  // namespace knot_utm
