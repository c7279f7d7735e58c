#pragma once

#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

inline Eigen::VectorXd flat(const Points& points) {
  return Eigen::Map<const Eigen::VectorXd>(points.data(), points.size());
}
inline Points unflat(const Eigen::VectorXd& values) {
  return Eigen::Map<const Points>(values.data(), 3, values.size() / 3);
}

/// What the contacts exert on the rod's nodes, one after the other [N].
inline Eigen::VectorXd nodal_forces(const std::vector<ContactPoint>& contacts, Eigen::Index nodes) {
  Points out = Points::Zero(3, nodes);
  for (const ContactPoint& contact : contacts)
    for (int k = 0; k < 3; ++k) {
      out.col(contact.a0 + k) += contact.c[k] * contact.force;
      if (!contact.on_roller()) out.col(contact.b0 + k) += contact.c[3 + k] * contact.force;
    }
  return flat(out);
}

/// M of a linear model [N/m]
inline Mat3 still_of(const ContactModel& model) {
  Mat3 m;
  m << to_vec3(model.still[0]), to_vec3(model.still[1]), to_vec3(model.still[2]);
  return m;
}

}  // namespace knot_utm
