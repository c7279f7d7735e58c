#include "knot_utm/rod/rod.hpp"

#include <cmath>
#include <string>

namespace knot_utm {

RodProperties make_rod(const Material& material, const Eigen::VectorXd& rest_length) {
  RodProperties rod;
  rod.material = material;
  rod.stretching = stretching_law_of(material);
  rod.rest_length = rest_length;
  const Eigen::Index edges = rest_length.size();
  rod.voronoi_length = Eigen::VectorXd::Zero(edges + 1);
  rod.voronoi_length.head(edges) += 0.5 * rest_length;
  rod.voronoi_length.tail(edges) += 0.5 * rest_length;
  rod.mass = material.density * M_PI * material.radius * material.radius * rod.voronoi_length;
  return rod;
}

bool are_places(const Points& points) {
  constexpr double kFarthest = 1e6;  // [m]
  return (points.array().abs() <= kFarthest).all();
}

Eigen::VectorXd RodProperties::arclength() const {
  Eigen::VectorXd out(nodes());
  out[0] = 0.0;
  for (Eigen::Index i = 1; i < nodes(); ++i) out[i] = out[i - 1] + rest_length[i - 1];
  return out;
}

void Material::state(Archive& archive) {
  archive(name, radius, density, stretching_stiffness, bending_stiffness, twisting_stiffness, friction_coefficient,
          contact_stiffness, tying_preload, breaking_force, load_cell, notes);
}

void RodProperties::state(Archive& archive) {
  archive.section("PRO2");  // "PROP" had no stretching law
  archive(material);
  for (Eigen::VectorXd* each : {&rest_length, &voronoi_length, &mass, &natural_twist}) archive.list(*each);
  const Eigen::Index inner = nodes() - 2, twisted = natural_twist.size();
  const bool fits = inner >= 1 && edges() == inner + 1 && mass.size() == nodes() && (twisted == 0 || twisted == inner);
  archive.require(fits, "nodes", std::to_string(nodes()));
  const auto positive = [](const Eigen::VectorXd& values) { return values.allFinite() && values.minCoeff() > 0.0; };
  const bool solid = positive(rest_length) && positive(voronoi_length) && positive(mass) && std::isfinite(length()) &&
                     material.radius > 0.0 && std::isfinite(material.radius);
  archive.require(solid, "rod", "one without a length, a radius or a mass");
  LawRegistry<StretchingLaws>::archive(archive, "stretching law", stretching);
}

void RodState::state(Archive& archive) {
  archive.section("RODS");
  archive(position, velocity, twist, twist_rate, reference_director, reference_twist, natural_curvature);
  const bool finite = are_places(position) && velocity.allFinite() && twist.allFinite() && twist_rate.allFinite() &&
                      reference_director.allFinite() && reference_twist.allFinite() && natural_curvature.allFinite();
  archive.require(finite, "state of the rod", "that of no rod");
}

}  // namespace knot_utm
