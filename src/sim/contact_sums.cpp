#include "knot_utm/sim/contact_sums.hpp"

#include <algorithm>

namespace knot_utm {

namespace {

/// Calls add(node, weight) with weights on three nodes of the sum 1, of which those below zero count as zero.
template <class Add>
void share(const double* weights, double sign, int first, const Add& add) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += std::max(0.0, sign * weights[k]);
  for (int k = 0; k < 3; ++k) {
    const double weight = std::max(0.0, sign * weights[k]);
    if (weight > 0.0) add(first + k, weight / sum);
  }
}

/// Calls add(node, its share of the normal force [N], the direction of it) for both sides of those that touch.
template <class Add>
void each_share(const std::vector<ContactPoint>& contacts, const Add& add) {
  for (const ContactPoint& contact : contacts) {
    if (!contact.touches()) continue;
    const double normal = contact.weight * contact.pressure;
    share(contact.c, 1.0, contact.a0, [&](int node, double weight) { add(node, weight * normal, contact.n); });
    if (!contact.on_roller())
      share(contact.c + 3, -1.0, contact.b0, [&](int node, double weight) { add(node, weight * normal, -contact.n); });
  }
}

}  // namespace

void add_normal_forces(const std::vector<ContactPoint>& contacts, Eigen::VectorXd& force) {
  each_share(contacts, [&](int node, double normal, const Vec3&) { force[node] += normal; });
}

void add_pressing(const std::vector<ContactPoint>& contacts, Pressing& pressing) {
  each_share(contacts, [&](int node, double normal, const Vec3& along) {
    pressing.col(node).head<3>() += normal * along;
    pressing(3, node) += normal;
  });
}

std::vector<ContactForce> contact_forces(const std::vector<ContactPoint>& contacts, const Points& position) {
  std::vector<ContactForce> out;
  for (const ContactPoint& contact : contacts) {
    if (contact.on_roller() || !contact.touches()) continue;
    Vec3 a = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      if (contact.c[k] != 0.0) a += contact.c[k] * position.col(contact.a0 + k);
    out.push_back({a - 0.5 * contact.x, contact.force});
  }
  return out;
}

double normal_force_between(const std::vector<ContactPoint>& contacts, const NodeRange& a, const NodeRange& b) {
  double sum = 0.0;
  for (const ContactPoint& contact : contacts) {
    if (contact.on_roller() || !contact.touches()) continue;
    const int on_a = contact.a0 + 1, on_b = contact.b0 + 1;  // the middle of their three nodes
    if ((a.holds(on_a) && b.holds(on_b)) || (a.holds(on_b) && b.holds(on_a))) sum += contact.weight * contact.pressure;
  }
  return sum;
}

double roller_normal_force(const std::vector<ContactPoint>& contacts, const NodeRange& piece) {
  double sum = 0.0;
  for (const ContactPoint& contact : contacts)
    if (contact.on_roller() && contact.touches() && piece.holds(contact.a0 + 1))
      sum += contact.weight * contact.pressure;
  return sum;
}

}  // namespace knot_utm
