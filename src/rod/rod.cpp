#include "knot_utm/rod/rod.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "knot_utm/rod/rod_laws.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

void require_size(const char* key, Eigen::Index size, Eigen::Index expected) {
  if (size != expected)
    throw InvalidInput::sentence(
        key, std::string(key) + " has " + std::to_string(size) + " values, but must have " + std::to_string(expected));
}

constexpr double kLengthOfCut = 10.0;  // more than least_loop [h]

}  // namespace

RodProperties make_rod(const RodMaterial& material, const Eigen::VectorXd& rest_length, const std::vector<int>& cuts) {
  RodProperties rod;
  rod.material = material;
  rod.laws = std::make_shared<const RodLaws>(RodLaws::of(material));
  rod.cuts = cuts;
  rod.rest_length = rest_length;
  for (const int cut : cuts) rod.rest_length[cut] = 0.0;
  const Eigen::Index edges = rest_length.size();
  rod.voronoi_length = Eigen::VectorXd::Zero(edges + 1);
  rod.voronoi_length.head(edges) += 0.5 * rod.rest_length;
  rod.voronoi_length.tail(edges) += 0.5 * rod.rest_length;
  for (const int cut : cuts) rod.rest_length[cut] = kLengthOfCut * material.radius;
  rod.mass = material.density * M_PI * material.radius * material.radius * rod.voronoi_length;
  return rod;
}

RodProperties make_rod(const RodMaterial& material, const RodMaterial& other, const Eigen::VectorXd& rest_length,
                       const std::vector<int>& cuts) {
  RodProperties rod = make_rod(material, rest_length, cuts);
  if (cuts.empty()) throw InvalidInput("rod", "one rope", "two ropes or more where there is another material");
  rod.other_material = other;
  rod.other_laws = std::make_shared<const RodLaws>(RodLaws::of(other));
  if (!of_one_kind(*rod.laws, *rod.other_laws))
    throw InvalidInput("rod", "two materials with laws of different kinds", "two with laws of the same kinds");
  for (const int cut : cuts) rod.rest_length[cut] = kLengthOfCut * std::max(material.radius, other.radius);
  const Eigen::Index others = rod.nodes() - rod.first_of_other();
  rod.mass.tail(others) = other.density * M_PI * other.radius * other.radius * rod.voronoi_length.tail(others);
  return rod;
}

bool are_places(const Points& points) {
  constexpr double kFarthest = 1e6;  // [m]
  return (points.array().abs() <= kFarthest).all();
}

bool RodProperties::is_cut(Eigen::Index edge) const { return std::find(cuts.begin(), cuts.end(), edge) != cuts.end(); }

double RodProperties::thinnest() const {
  return other_material ? std::min(material.radius, other_material->radius) : material.radius;
}

double RodProperties::length() const {
  double length = rest_length.sum();
  for (const int cut : cuts) length -= rest_length[cut];
  return length;
}

Eigen::VectorXd RodProperties::arclength() const {
  Eigen::VectorXd out(nodes());
  out[0] = 0.0;
  for (Eigen::Index i = 1; i < nodes(); ++i) out[i] = out[i - 1] + rest_length[i - 1];
  return out;
}

double RodProperties::place(double arclength) const {
  double out = arclength;
  for (const int cut : cuts)
    if (arclength > rest_length.head(cut).sum()) out -= rest_length[cut];
  return out;
}

double RodProperties::place(Eigen::Index edge, double fraction) const {
  return place(rest_length.head(edge).sum() + fraction * rest_length[edge]);
}

void remember_bends(const RodProperties& rod, RodState* state) {
  const Eigen::Index inner = rod.nodes() - 2;
  state->natural_curvature.setZero(2, inner);
  state->bending_own.setZero(own_numbers(rod.laws->bending) * inner);
}

void require_fits(const RodProperties& rod, const RodState& state) {
  require_size("state.position", state.position.cols(), rod.nodes());
  const Eigen::Index inner = rod.nodes() - 2;
  if (state.curved_at_rest())
    require_size("state.natural_curvature", state.natural_curvature.cols(), inner);
  else if (bends_on_frames(rod.laws->bending))
    throw InvalidInput("rod", "one without a memory of bends", "made with natural curvatures, be they zero");
  require_size("state.bending_own", state.bending_own.size(), own_numbers(rod.laws->bending) * inner);
  if (state.twist.size() > 0) {
    require_size("state.twist", state.twist.size(), rod.edges());
    require_size("state.reference_director", state.reference_director.cols(), rod.edges());
    require_size("state.reference_twist", state.reference_twist.size(), inner);
  } else if (state.curved_at_rest()) {
    throw InvalidInput("state.twist", "empty", "given for a rod with natural curvature");
  }
}

void RodState::state(Archive& archive) {
  archive.section("RODS");
  archive(position, velocity, twist, twist_rate, reference_director, reference_twist, natural_curvature);
  if (curved_at_rest()) archive.list(bending_own);
  const bool finite = are_places(position) && velocity.allFinite() && twist.allFinite() && twist_rate.allFinite() &&
                      reference_director.allFinite() && reference_twist.allFinite() && natural_curvature.allFinite() &&
                      bending_own.allFinite();
  archive.require(finite, "state of the rod", "that of no rod");
}

}  // namespace knot_utm
