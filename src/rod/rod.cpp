#include "knot_utm/rod/rod.hpp"

#include <cmath>

namespace knot_utm {

RodProperties make_rod(const Material& material, const Eigen::VectorXd& rest_length) {
  RodProperties rod;
  rod.material = material;
  rod.rest_length = rest_length;
  const Eigen::Index edges = rest_length.size();
  rod.voronoi_length = Eigen::VectorXd::Zero(edges + 1);
  rod.voronoi_length.head(edges) += 0.5 * rest_length;
  rod.voronoi_length.tail(edges) += 0.5 * rest_length;
  rod.mass = material.density * M_PI * material.radius * material.radius * rod.voronoi_length;
  return rod;
}

Eigen::VectorXd RodProperties::arclength() const {
  Eigen::VectorXd out(nodes());
  out[0] = 0.0;
  for (Eigen::Index i = 1; i < nodes(); ++i) out[i] = out[i - 1] + rest_length[i - 1];
  return out;
}

void RodState::state(Archive& archive) {
  archive.section("RODS");
  archive(position, velocity, twist, twist_rate, reference_director, reference_twist);
}

}  // namespace knot_utm
