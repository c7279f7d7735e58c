#include "knot_utm/specimen/knot_facts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "knot_utm/topology/crossings.hpp"
#include "knot_utm/topology/knot_invariants.hpp"

namespace knot_utm {

namespace {

/// Crossings of strands; those with a cut, or with the line that would close the rod, are none.
int visible_crossings(const Centreline& knot) {
  Mat3 rotation;  // from the front
  rotation << Vec3::UnitX().transpose(), Vec3::UnitZ().transpose(), -Vec3::UnitY().transpose();
  const Eigen::Index closing = knot.points.cols() - 1;
  const auto is_rope = [&](Eigen::Index segment) {
    return segment != closing && std::find(knot.cuts.begin(), knot.cuts.end(), segment) == knot.cuts.end();
  };
  const std::vector<Crossing> all = crossings_of(knot.points, rotation);
  return static_cast<int>(std::count_if(all.begin(), all.end(),
                                        [&](const Crossing& one) { return is_rope(one.over) && is_rope(one.under); }));
}

std::string term(std::int64_t coefficient, std::size_t power) {
  std::string size = std::to_string(std::abs(coefficient));
  if (power == 0) return size;
  return (size == "1" ? "" : size + " ") + (power == 1 ? "t" : "t^" + std::to_string(power));
}

/// "1 - 3 t + t^2"
std::string polynomial_text(const KnotPolynomial& polynomial) {
  std::string out;
  for (std::size_t power = 0; power < polynomial.size(); ++power) {
    const std::int64_t coefficient = polynomial[power];
    if (coefficient == 0) continue;
    const std::string sign = coefficient < 0 ? "-" : "+";
    out += out.empty() ? (coefficient < 0 ? "-" : "") : " " + sign + " ";
    out += term(coefficient, power);
  }
  return out;
}

std::string invariants(const KnotPolynomial& polynomial) {
  return "Alexander polynomial " + polynomial_text(polynomial) + ", determinant " +
         std::to_string(knot_determinant(polynomial));
}

std::string type_of_rope(const Centreline& knot) {
  const Points& x = knot.points;
  const Vec3 axis = x.rightCols(1) - x.leftCols(1);
  return invariants(alexander_polynomial(closed_far_away(x, axis))) + ", closed far away";
}

std::string type_of_loop(const Centreline& knot, double radius) {
  const auto standing = [&](std::size_t k) { return knot.nearest_node(knot.knots[k].standing_begin); };
  LoopTopology topology(standing(0), standing(1), radius, knot.windings());
  return invariants(topology.read(knot.points, Vec3::UnitZ()).polynomial) + ", its tails joined";
}

std::string type_of_ropes(const Centreline& knot) {
  const std::vector<Piece> ropes = pieces_between(knot.points.cols(), knot.cuts);
  const auto rope = [&](std::size_t k) { return Points(knot.points.middleCols(ropes[k].begin, ropes[k].nodes())); };
  std::string out;
  for (std::size_t i = 0; i < ropes.size(); ++i)
    for (std::size_t j = i + 1; j < ropes.size(); ++j)
      out += (out.empty() ? "linking number of ropes " : ", of ") + std::to_string(i + 1) + " and " +
             std::to_string(j + 1) + ": " + std::to_string(linking_number(rope(i), rope(j)));
  return out + ", each closed by the straight line between its ends";
}

std::string type_of(const Centreline& knot, double radius) {
  if (!knot.cuts.empty()) return type_of_ropes(knot);
  if (knot.knots.size() == 2) return type_of_loop(knot, radius);
  const bool held = knot.above.empty() || (knot.above.size() == 1 && knot.below.size() == 1);
  if (held) return type_of_rope(knot);
  return knot.free.empty() ? "not defined, as both ends are held by one grip"
                           : "not defined, as the rope has a free end";
}

void find_sharpest_bend(const Centreline& knot, KnotFacts& out) {
  constexpr double kStraight = 1e-9;  // what rounding turns a straight rope by [rad]
  out.sharpest_bend = std::numeric_limits<double>::infinity();
  for (const Piece& rope : pieces_between(knot.points.cols(), knot.cuts))
    for (Eigen::Index i = rope.begin + 1; i + 1 < rope.end; ++i) {
      const Vec3 before = knot.points.col(i) - knot.points.col(i - 1),
                 after = knot.points.col(i + 1) - knot.points.col(i);
      const double angle = turning_angle(before.normalized(), after.normalized());
      const double radius = angle > kStraight ? 0.5 * (before.norm() + after.norm()) / angle : out.sharpest_bend;
      if (radius >= out.sharpest_bend) continue;
      out.sharpest_bend = radius;
      out.sharpest = knot.points.col(i);
    }
}

}  // namespace

KnotFacts facts_of(const Centreline& knot, double radius) {
  KnotFacts out;
  out.strands = static_cast<int>(knot.cuts.size()) + 1;
  out.crossings = visible_crossings(knot);
  out.type = type_of(knot, radius);
  const NearestPlaces nearest = nearest_places(knot.points, 1.5 * M_PI * radius, knot.cuts);
  out.least_distance = nearest.distance;
  out.nearest = nearest.middle;
  find_sharpest_bend(knot, out);
  return out;
}

}  // namespace knot_utm
