#include "knot_utm/ros/markers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

using visualization_msgs::Marker;

/// rviz does not light triangles that have colours of their own, so the light is put into the colours: one lamp, and
/// soft enough that no side is black (half-Lambert).
std_msgs::ColorRGBA lit(const std_msgs::ColorRGBA& c, const Vec3& normal) {
  static const Vec3 kToLamp = Vec3(0.55, -0.65, 0.55).normalized();
  const double half = 0.5 + 0.5 * normal.dot(kToLamp);
  const double light = 0.3 + 0.75 * half * half;
  return color(std::min(1.0, light * static_cast<double>(c.r)), std::min(1.0, light * static_cast<double>(c.g)),
               std::min(1.0, light * static_cast<double>(c.b)));
}

constexpr std::size_t kGaugeMarks = 9;  // along the rod
constexpr double kGaugeMark = 0.6;      // half of its length [radius]
constexpr double kAboveTheRod = 1.03;   // of its paint [radius]
constexpr double kLongestForce = 6.0;   // half of the line of a contact force at the end of the scale [radius]

// Spheres in place of a tube
constexpr double kSphereDistance = 1.3;  // beyond which one is put between two [radius]
constexpr int kMostBetween = 4;          // on an edge

const std_msgs::ColorRGBA kWhite = color(1.0, 1.0, 1.0);  // of what has a colour for each of its points
const std_msgs::ColorRGBA kInk = color(0.12, 0.12, 0.15);
const std_msgs::ColorRGBA kUnknown = color(0.58, 0.6, 0.63);  // of what has no known value
const std_msgs::ColorRGBA kContactColor = color(0.25, 0.85, 0.95);
const std_msgs::ColorRGBA kBodyColor = color(0.45, 0.47, 0.52);

/// A marker for rviz that is still without content. `ns`: its namespace, within which `id` is unique.
Marker marker_of(const char* ns, int id, int type, const Vec3& size, const std_msgs::ColorRGBA& c) {
  Marker m;
  m.header.frame_id = names::kBaseFrame;
  m.ns = ns;
  m.id = id;
  m.type = type;
  m.action = Marker::ADD;
  m.pose.orientation.w = 1.0;
  m.scale.x = size.x();
  m.scale.y = size.y();
  m.scale.z = size.z();
  m.color = c;
  return m;
}

Marker triangles(const char* ns) { return marker_of(ns, 0, Marker::TRIANGLE_LIST, Vec3::Ones(), kWhite); }

/// One ring of the tube at a node.
struct Ring {
  Vec3 center, normal, binormal;  ///< normal x binormal points along the rod
};

std::vector<Ring> rings_of(const Points& points) {
  const Eigen::Index n = points.cols();
  std::vector<Ring> rings;
  Vec3 last_tangent = Vec3::UnitZ();
  Vec3 normal = Vec3::UnitX();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 chord = points.col(std::min(i + 1, n - 1)) - points.col(std::max<Eigen::Index>(i - 1, 0));
    const double length = chord.norm();
    const Vec3 tangent = length > 0.0 ? Vec3(chord / length) : last_tangent;
    normal = i == 0 ? any_normal(tangent) : parallel_transport(normal, last_tangent, tangent);
    normal = (normal - tangent * tangent.dot(normal)).normalized();
    rings.push_back({points.col(i), normal, tangent.cross(normal)});
    last_tangent = tangent;
  }
  return rings;
}

Marker body_marker(int id, const GripBody& body, const Vec3& grip, double radius) {
  const bool cylinder = body.cylinder_radius > 0.0;
  const Vec3 half =
      cylinder ? Vec3(body.cylinder_radius, body.cylinder_radius, body.half_length(radius)) : body.half_box(radius);
  Marker m = marker_of("grips", id, cylinder ? Marker::CYLINDER : Marker::CUBE, 2.0 * half, kBodyColor);
  m.pose.position = to_point(grip + body.from_grip);
  if (cylinder) {
    // A marker's cylinder stands along z.
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), body.axis);
    m.pose.orientation.w = turn.w();
    m.pose.orientation.x = turn.x();
    m.pose.orientation.y = turn.y();
    m.pose.orientation.z = turn.z();
  }
  return m;
}

/// Adds a tube around a centreline to a list of triangles. `color_at`: the colour of a node.
template <class ColorAt>
void add_tube(Marker& m, const Points& points, double radius, ColorAt color_at) {
  const std::vector<Ring> rings = rings_of(points);
  const auto outwards = [&](const Ring& ring, int side) -> Vec3 {
    const double angle = 2.0 * M_PI * side / kTubeSides;
    return std::cos(angle) * ring.normal + std::sin(angle) * ring.binormal;
  };
  const auto add = [&](const Vec3& point, const std_msgs::ColorRGBA& c) {
    m.points.push_back(to_point(point));
    m.colors.push_back(c);
  };
  const auto add_side = [&](std::size_t i, int side) {
    const Vec3 normal = outwards(rings[i], side);
    add(rings[i].center + radius * normal, lit(color_at(i), normal));
  };
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (int side = 0; side < kTubeSides; ++side) {
      add_side(i, side), add_side(i, side + 1), add_side(i + 1, side + 1);
      add_side(i, side), add_side(i + 1, side + 1), add_side(i + 1, side);
    }
  const auto add_end = [&](std::size_t i, double direction) {
    const Ring& ring = rings[i];
    const std_msgs::ColorRGBA shade = lit(color_at(i), direction * ring.normal.cross(ring.binormal));
    for (int side = 0; side < kTubeSides; ++side) {
      const int from = direction > 0.0 ? side : side + 1, to = direction > 0.0 ? side + 1 : side;
      add(ring.center, shade);
      add(ring.center + radius * outwards(ring, from), shade);
      add(ring.center + radius * outwards(ring, to), shade);
    }
  };
  add_end(0, -1.0);
  add_end(rings.size() - 1, 1.0);
}

/// Dark bands on the rod, each along the edges beside its node.
Marker gauge_marker(const Points& points, const std::vector<Eigen::Index>& nodes, const RopeRadii& radius) {
  Marker m = triangles("gauge_marks");
  for (const Eigen::Index node : nodes) {
    if (node < 1 || node + 1 >= points.cols()) continue;
    const Vec3 here = points.col(node);
    const auto towards = [&](Eigen::Index other) -> Vec3 {
      const Vec3 offset = points.col(other) - here;
      return here + std::min(1.0, kGaugeMark * radius(node) / offset.norm()) * offset;
    };
    Points band(3, 3);
    band << towards(node - 1), here, towards(node + 1);
    add_tube(m, band, kAboveTheRod * radius(node), [](std::size_t) { return kInk; });
  }
  return m;
}

}  // namespace

RopeRadii::RopeRadii(const Material& material, const std::vector<int>& cuts) : RopeRadii(material.radius) {
  if (!material.other || cuts.empty()) return;
  others = material.other->radius;
  first_of_others = cuts.front() + 1;
}

Eigen::VectorXd tension_at_nodes(const Eigen::VectorXd& tension, const std::vector<int>& cuts) {
  const Eigen::Index edges = tension.size();
  if (edges == 0) return {};
  Eigen::VectorXd out(edges + 1);
  for (const Piece& rope : pieces_between(edges + 1, cuts))
    for (Eigen::Index i = rope.begin; i < rope.end; ++i) {
      const double before = tension[std::max(i - 1, rope.begin)], after = tension[std::min(i, rope.end - 2)];
      out[i] = 0.5 * (before + after);
    }
  return out;
}

Eigen::VectorXd curvature_at_nodes(const Points& points, const RopeRadii& radius, const std::vector<int>& cuts) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(points.cols());
  for (Eigen::Index i = 1; i + 1 < points.cols(); ++i) {
    const Vec3 before = points.col(i) - points.col(i - 1), after = points.col(i + 1) - points.col(i);
    const double length_before = before.norm(), length_after = after.norm();
    if (length_before <= 0.0 || length_after <= 0.0) continue;
    const double angle = turning_angle(before / length_before, after / length_after);
    out[i] = radius(i) * 2.0 * angle / (length_before + length_after);
  }
  for (const Piece& rope : pieces_between(points.cols(), cuts)) out[rope.begin] = out[rope.end - 1] = 0.0;
  return out;
}

Marker tube_marker(const Points& points, const Colors& colors, const RopeRadii& radius,
                   const std::vector<int>& missing) {
  Marker m = triangles("rod");
  const std::size_t corners = 6 * static_cast<std::size_t>(kTubeSides) * static_cast<std::size_t>(points.cols());
  m.points.reserve(corners);
  m.colors.reserve(corners);
  for (const Piece& piece : pieces_between(points.cols(), missing))
    if (piece.nodes() > 1)
      add_tube(m, points.middleCols(piece.begin, piece.nodes()), radius(piece.begin),
               [&](std::size_t node) { return colors[static_cast<std::size_t>(piece.begin) + node]; });
  return m;
}

std::vector<Marker> sphere_markers(const Points& points, const Colors& colors, const RopeRadii& radius,
                                   const std::vector<int>& missing) {
  std::vector<Marker> lists;
  for (const Piece& piece : pieces_between(points.cols(), missing)) {
    const double r = radius(piece.begin);
    if (lists.empty() || piece.begin == radius.first_of_others)
      lists.push_back(
          marker_of("rod", static_cast<int>(lists.size()), Marker::SPHERE_LIST, {2 * r, 2 * r, 2 * r}, kWhite));
    const auto add = [&](const Vec3& place, Eigen::Index node) {
      lists.back().points.push_back(to_point(place));
      lists.back().colors.push_back(colors[static_cast<std::size_t>(node)]);
    };
    for (Eigen::Index i = piece.begin; i < piece.end; ++i) {
      add(points.col(i), i);
      if (i + 1 == piece.end) break;
      const Vec3 edge = points.col(i + 1) - points.col(i);
      const int between = std::min(static_cast<int>(edge.norm() / (kSphereDistance * r)), kMostBetween);
      for (int k = 1; k <= between; ++k) add(points.col(i) + edge * k / (between + 1), i);
    }
  }
  return lists;
}

Marker contact_marker(const std::vector<ContactForce>& forces, double radius, const ColorScale& scale, double longest) {
  Marker m = marker_of("contact_forces", 0, Marker::LINE_LIST, {0.35 * radius, 0.0, 0.0}, kContactColor);
  for (const ContactForce& contact : forces) {
    const double size = contact.force.norm();
    const Vec3 half = size > 0.0 ? Vec3(longest * scale.place(size) / size * contact.force) : Vec3::Zero();
    m.points.push_back(to_point(contact.place - half));
    m.points.push_back(to_point(contact.place + half));
  }
  return m;
}

ScenePicture::ScenePicture(const SpecimenOptions& specimen, const MachineOptions& machine, const Material& material)
    : bodies_(grip_bodies(specimen, machine, material)),
      material_(material),
      radii_(material.radius),
      tension_(ColorScale::of_tension(material, machine.load_cell)),
      curvature_(ColorScale::of_curvature()) {}

void ScenePicture::begin(const Points& points, const std::vector<int>& cuts) {
  gauge_.clear();
  cuts_ = cuts;
  radii_ = RopeRadii(material_, cuts);
  arclength_ = Eigen::VectorXd::Zero(points.cols());
  const auto is_cut = [&](Eigen::Index edge) { return std::binary_search(cuts.begin(), cuts.end(), edge); };
  for (Eigen::Index i = 1; i < points.cols(); ++i)
    arclength_[i] = arclength_[i - 1] + (is_cut(i - 1) ? 0.0 : (points.col(i) - points.col(i - 1)).norm());
  for (Eigen::Index i = 1; i < points.cols(); ++i) {
    if (is_cut(i - 1) || is_cut(i)) continue;
    const double next = arclength_[points.cols() - 1] * static_cast<double>(gauge_.size() + 1) / (kGaugeMarks + 1.0);
    if (gauge_.size() < kGaugeMarks && arclength_[i] >= next) gauge_.push_back(i);
  }
}

ScenePicture::Rod ScenePicture::rod_of(const SceneView& view) const {
  const bool by_tension = color_by_ == ColorBy::kTension;
  Eigen::VectorXd value =
      by_tension ? tension_at_nodes(view.tension, cuts_) : curvature_at_nodes(view.points, radii_, cuts_);
  value.conservativeResizeLike(Eigen::VectorXd::Constant(view.points.cols(), Sample::kNone));
  Rod rod{{}, cuts_};
  if (!std::isnan(view.sample.break_arclength)) {
    const double* begin = arclength_.data();
    const Eigen::Index beyond = std::upper_bound(begin, begin + arclength_.size(), view.sample.break_arclength) - begin;
    const Eigen::Index parted = std::min(beyond - 1, view.points.cols() - 2);
    rod.missing.insert(std::upper_bound(rod.missing.begin(), rod.missing.end(), parted), static_cast<int>(parted));
    if (by_tension) {
      value.setConstant(Sample::kNone);
    } else {
      value.segment(parted, 2).setZero();  // no bend is there any more
    }
  }
  for (const double x : value) rod.colors.push_back(std::isfinite(x) ? scale().color(x) : kUnknown);
  return rod;
}

visualization_msgs::MarkerArray ScenePicture::with_bodies(std::vector<Marker> markers, const SceneView& view) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    markers.push_back(body_marker(static_cast<int>(i), bodies_[i],
                                  bodies_[i].goes_up ? view.upper_grip : view.lower_grip, thickest(material_)));
  for (Marker& marker : markers) {
    marker.header.stamp = view.stamp;
    const bool a_list = marker.type == Marker::TRIANGLE_LIST || marker.type == Marker::LINE_LIST;
    if (a_list && marker.points.empty()) marker.action = Marker::DELETE;  // rviz takes an empty list for an error
  }
  visualization_msgs::MarkerArray array;
  array.markers = std::move(markers);
  return array;
}

visualization_msgs::MarkerArray ScenePicture::draw(const SceneView& view) const {
  const Rod rod = rod_of(view);
  const std::vector<ContactForce> contacts = show_contacts_ ? view.contacts : std::vector<ContactForce>();
  return with_bodies(
      {tube_marker(view.points, rod.colors, radii_, rod.missing), gauge_marker(view.points, gauge_, radii_),
       contact_marker(contacts, radii_.first, tension_, kLongestForce * radii_.first)},
      view);
}

visualization_msgs::MarkerArray ScenePicture::draw_small(const SceneView& view) const {
  Rod rod = rod_of(view);
  for (const Eigen::Index node : gauge_)
    if (node < view.points.cols()) rod.colors[static_cast<std::size_t>(node)] = kInk;
  return with_bodies(sphere_markers(view.points, rod.colors, radii_, rod.missing), view);
}

}  // namespace knot_utm
