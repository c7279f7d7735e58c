#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "knot_utm/method/knot_file.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "knot_utm/topology/crossings.hpp"
#include "knot_utm/topology/knot_invariants.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "knot_utm/words/yaml_lines.hpp"

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
  const bool held = knot.held_upper.empty() || (knot.held_upper.size() == 1 && knot.held_lower.size() == 1);
  if (held) return type_of_rope(knot);
  return knot.free_ends.empty() ? "not defined, as both ends are held by one grip"
                                : "not defined, as the rope has a free end";
}

/// The least radius of the circle through the midpoints of two edges, infinite in a straight rope, and the node between
/// them [m].
struct Bend {
  double radius = std::numeric_limits<double>::infinity();
  Vec3 at = Vec3::Zero();
};

Bend sharpest_bend(const Centreline& knot) {
  constexpr double kStraight = 1e-9;  // what rounding turns a straight rope by [rad]
  Bend out;
  for (const Piece& rope : pieces_between(knot.points.cols(), knot.cuts))
    for (Eigen::Index i = rope.begin + 1; i + 1 < rope.end; ++i) {
      const Vec3 before = knot.points.col(i) - knot.points.col(i - 1),
                 after = knot.points.col(i + 1) - knot.points.col(i);
      const double angle = turning_angle(before.normalized(), after.normalized());
      if (!(angle > kStraight)) continue;
      const double radius = 0.5 * (before.norm() + after.norm()) / angle;
      if (radius < out.radius) out = {radius, knot.points.col(i)};
    }
  return out;
}

constexpr double kShownTail = 6.0;  // [h]
constexpr double kShownEdge = 0.5;  // [h]
constexpr double kFarOff = 4.0;     // less than a bend's own strand is away where it counts as another one [h]
constexpr const char* kAnyTest =
    "specimen: {knot: straight}\n"
    "material: nylon\n"
    "program: [hold: {duration: 1}]\n";

/// A loop is shown on its rollers.
const char* grips_for(const std::string& knot) {
  const auto is_it = [&](const Knot* one) { return one->about().loop && knot == one->about().name; };
  return std::any_of(knots().begin(), knots().end(), is_it) ? "rollers" : "nodes";
}

Centreline centreline_of(const Method& method) {
  return specimen_centreline(method.specimen, method.material, method.machine, method.physics);
}

/// The rod as it is drawn for the picture. A test's own is drawn before: what that is refused for, this is, too.
Centreline shown_centreline(Method& method) {
  Centreline tested = centreline_of(method);
  if (!method.specimen.drawing) return tested;
  const double h = thickest(method.material);
  method.specimen.tail = kShownTail * h;
  method.specimen.edge_length = kShownEdge * h;
  method.specimen.end_to_end = least_end_to_end(*method.specimen.drawing, h);
  return centreline_of(method);
}

std::vector<std::array<std::string, 2>> names_of_ends(const Method& method) {
  std::vector<std::array<std::string, 2>> out;
  if (!method.specimen.drawing) return {{"first end", "last end"}};
  for (const KnotDrawing::Strand& strand : method.specimen.drawing->strands) out.push_back(strand.ends);
  return out;
}

std::string title_of(const Method& method) {
  return method.specimen.drawing ? method.specimen.drawing->title : knot_of(method.specimen).about().title;
}

std::string held(const Method& method, const Supports& supports) {
  const KnotDrawing* drawing = method.specimen.drawing.get();
  if (knot_of(method.specimen).about().loop) return "the loop by both grips";
  const std::vector<std::string> lower = drawing ? drawing->lower : std::vector<std::string>{"first end"},
                                 upper = drawing ? drawing->upper : std::vector<std::string>{"last end"};
  const auto by = [](const std::vector<std::string>& ends, const std::string& grip, bool post) {
    return post ? "a post stands for the " + grip + " grip" : listed(ends, " and ") + " by the " + grip + " grip";
  };
  return by(lower, "lower", drawing ? lower.empty() : !supports.posts.empty()) + ", " +
         by(upper, "upper", !supports.pins.empty());
}

/// "lower_tail with 0.5 F_p and upper_tail".
std::string with_parts(const std::vector<KnotDrawing::Pull>& pulls) {
  std::vector<std::string> ends;
  for (const KnotDrawing::Pull& pull : pulls) {
    std::ostringstream part;
    if (pull.fraction != 1.0) part << " with " << pull.fraction << " F_p";
    ends.push_back(pull.end + part.str());
  }
  return listed(ends, " and ");
}

std::string pulled(const Method& method) {
  if (knot_of(method.specimen).about().loop) return "its two tails";
  if (!method.specimen.drawing || method.specimen.drawing->tie.empty()) return "none";
  std::string out;
  for (const std::vector<KnotDrawing::Pull>& together : method.specimen.drawing->tie)
    out += (out.empty() ? "" : ", then ") + with_parts(together);
  return out;
}

/// "2.05 radii at (1.2, 0, -3)", in the frame of the knot's file or from the lower grip.
std::string length_at(double length, const Vec3& place, const Vec3& origin, double radius) {
  std::array<char, 128> text{};
  const Vec3 at = ((place - origin) / radius).array() + 0.0;
  std::snprintf(text.data(), text.size(), "%.3g radii at (%.1f, %.1f, %.1f)", length / radius, at.x(), at.y(), at.z());
  return text.data();
}

/// What can be read from a knot's shape before anything pulls it, as seen from the front: x to the right, z up.
std::string facts_text(const Method& method, const Supports& supports, const Centreline& shown) {
  const KnotDrawing* drawing = method.specimen.drawing.get();
  const double h = thickest(method.material);
  Vec3 origin = Vec3::Zero();
  if (drawing) origin.z() = height_of_origin(*drawing, {h, method.specimen.end_to_end, 0.0, 0.0});
  const NearestPlaces nearest = nearest_places(shown.points, 1.5 * M_PI * h, shown.cuts);
  const Bend bend = sharpest_bend(shown);
  std::string out = "title: " + title_of(method) + "\n";
  if (drawing && !drawing->use.empty()) out += "use: " + drawing->use + "\n";
  out += "strands: " + std::to_string(shown.cuts.size() + 1) + "\n";
  out += "held: " + held(method, supports) + "\n";
  out += "pulled: " + pulled(method) + "\n";
  if (drawing && !drawing->weights.empty()) out += "weights: " + with_parts(drawing->weights) + "\n";
  out += "crossings: " + std::to_string(visible_crossings(shown)) + ", from the front\n";
  out += "type: " + type_of(shown, h) + "\n";
  const bool near = nearest.distance < kFarOff * h;
  out += "least distance of strands: " +
         (near ? length_at(nearest.distance, nearest.middle, origin, h) : "above 4 radii") + "\n";
  const bool bent = std::isfinite(bend.radius);
  return out + "sharpest bend: " + (bent ? length_at(bend.radius, bend.at, origin, h) : "none") + "\n";
}

std::string array_of(const std::vector<std::string>& items) { return "[" + listed(items, ", ") + "]"; }

std::string json_of(const Vec3& vector) {
  return array_of({format_number(vector.x()), format_number(vector.y()), format_number(vector.z())});
}

/// All lengths in radii of the rod.
std::string shape_json(const std::string& title, const Method& method, const Centreline& shown,
                       const Supports& supports) {
  const double h = thickest(method.material);
  const std::vector<std::array<std::string, 2>> ends = names_of_ends(method);
  std::vector<std::string> ropes, posts;
  for (const Piece& piece : pieces_between(shown.points.cols(), shown.cuts)) {
    const std::array<std::string, 2>& names = ends[ropes.size()];
    std::vector<std::string> points;
    for (Eigen::Index i = piece.begin; i < piece.end; ++i) points.push_back(json_of(Vec3(shown.points.col(i) / h)));
    ropes.push_back("{\"ends\": " + array_of({quoted(names[0]), quoted(names[1])}) +
                    ", \"points\": " + array_of(points) + "}");
  }
  for (const std::vector<Roller>* of : {&supports.posts, &supports.pins})
    for (const Roller& post : *of)
      posts.push_back("{\"centre\": " + json_of(Vec3(post.centre / h)) + ", \"axis\": " + json_of(post.axis) +
                      ", \"radius\": " + format_number(post.radius / h) +
                      ", \"ring\": " + format_number(post.ring / h) + "}");
  return "{\"title\": " + quoted(title) + ", \"ropes\": " + array_of(ropes) + ", \"posts\": " + array_of(posts) + "}\n";
}

}  // namespace

KnotSheet knot_sheet(const std::string& knot, const std::string& option) {
  Method method = parse_method(
      kAnyTest, option, {"specimen.knot=" + quoted(knot), "machine.grips=" + std::string(grips_for(knot))}, option);
  const Centreline shown = shown_centreline(method);
  const Supports supports = knot_of(method.specimen).supports(method.specimen, method.material);
  const KnotDrawing* drawing = method.specimen.drawing.get();
  KnotSheet out;
  out.name = drawing ? std::filesystem::path(drawing->name).stem().string() : knot_of(method.specimen).about().name;
  out.facts = facts_text(method, supports, shown);
  out.shape = shape_json(title_of(method), method, shown, supports);
  return out;
}

}  // namespace knot_utm
