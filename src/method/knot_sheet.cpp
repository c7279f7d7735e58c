#include "knot_utm/method/knot_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/settings/specimen_centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/knot_facts.hpp"
#include "knot_utm/words/known_names.hpp"

namespace knot_utm {
namespace {

constexpr double kShownTail = 6.0;  // [h]
constexpr double kShownEdge = 0.5;  // [h]
constexpr double kFarOff = 4.0;     // less than a bend's own strand is away where it counts as another one [h]
constexpr const char* kAnyTest =
    "specimen: {knot: straight}\n"
    "material: nylon\n"
    "program: [hold: {duration: 1}]\n";

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  return out + '"';
}

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

std::string facts_text(const Method& method, const Supports& supports, const KnotFacts& facts) {
  const KnotDrawing* drawing = method.specimen.drawing.get();
  const double h = thickest(method.material);
  Vec3 origin = Vec3::Zero();
  if (drawing) origin.z() = height_of_origin(*drawing, {h, method.specimen.end_to_end, 0.0, 0.0});
  std::string out = "title: " + title_of(method) + "\n";
  if (drawing && !drawing->use.empty()) out += "use: " + drawing->use + "\n";
  out += "strands: " + std::to_string(facts.strands) + "\n";
  out += "held: " + held(method, supports) + "\n";
  out += "pulled: " + pulled(method) + "\n";
  if (drawing && !drawing->weights.empty()) out += "weights: " + with_parts(drawing->weights) + "\n";
  out += "crossings: " + std::to_string(facts.crossings) + ", from the front\n";
  out += "type: " + facts.type + "\n";
  const bool near = facts.least_distance < kFarOff * h;
  out += "least distance of strands: " +
         (near ? length_at(facts.least_distance, facts.nearest, origin, h) : std::string("above 4 radii")) + "\n";
  const bool bent = std::isfinite(facts.sharpest_bend);
  out += "sharpest bend: " + (bent ? length_at(facts.sharpest_bend, facts.sharpest, origin, h) : std::string("none")) +
         "\n";
  return out;
}

std::string json_of(const Vec3& vector) {
  std::ostringstream out;
  out << '[' << vector.x() << ", " << vector.y() << ", " << vector.z() << ']';
  return out.str();
}

/// All lengths in radii of the rod.
std::string shape_json(const std::string& title, const Method& method, const Centreline& shown,
                       const Supports& supports) {
  const double h = thickest(method.material);
  const std::vector<std::array<std::string, 2>> ends = names_of_ends(method);
  std::ostringstream out;
  out << "{\"title\": " << quoted(title) << ", \"ropes\": [";
  const std::vector<Piece> ropes = pieces_between(shown.points.cols(), shown.cuts);
  for (std::size_t k = 0; k < ropes.size(); ++k) {
    out << (k > 0 ? ", " : "") << "{\"ends\": [" << quoted(ends[k][0]) << ", " << quoted(ends[k][1])
        << "], \"points\": [";
    for (Eigen::Index i = ropes[k].begin; i < ropes[k].end; ++i)
      out << (i > ropes[k].begin ? ", " : "") << json_of(shown.points.col(i) / h);
    out << "]}";
  }
  out << "], \"posts\": [";
  const char* comma = "";
  for (const std::vector<Roller>* posts : {&supports.posts, &supports.pins})
    for (const Roller& post : *posts) {
      out << comma << "{\"centre\": " << json_of(post.centre / h) << ", \"axis\": " << json_of(post.axis)
          << ", \"radius\": " << post.radius / h << ", \"ring\": " << post.ring / h << '}';
      comma = ", ";
    }
  out << "]}\n";
  return out.str();
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
  out.facts = facts_text(method, supports, facts_of(shown, thickest(method.material)));
  out.shape = shape_json(title_of(method), method, shown, supports);
  return out;
}

}  // namespace knot_utm
