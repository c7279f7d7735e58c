#include "knot_utm/ros/markers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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
constexpr double kForceWidth = 0.15;    // of that line [radius]
constexpr double kPartedGap = 2.0;      // from the place of a break to each of the new ends [radius]
constexpr double kNoBend = 0.01;        // curvature of a rod that is as good as straight [1/radius]

// Between two rings of the rod at most
constexpr double kRingTurn = 0.2;   // angle by which it turns
constexpr float kRingColor = 0.1f;  // by which its colour changes
constexpr double kRoundBend = 0.5;  // cosine of half the turn up to which cylinders meet on the outside of a bend

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

/// Takes away all that was there before.
visualization_msgs::MarkerArray nothing() {
  visualization_msgs::MarkerArray array;
  array.markers.push_back(marker_of("", 0, Marker::CUBE, Vec3::Ones(), kWhite));
  array.markers.back().action = Marker::DELETEALL;
  return array;
}

/// One ring of the tube at a node.
struct Ring {
  Vec3 center, normal, binormal;  ///< normal x binormal points along the rod
  Vec3 along() const { return normal.cross(binormal); }
  std_msgs::ColorRGBA color;
};

bool differ(const Ring& a, const Ring& b) {
  const Eigen::Vector3f change(a.color.r - b.color.r, a.color.g - b.color.g, a.color.b - b.color.b);
  return a.along().dot(b.along()) < std::cos(kRingTurn) || change.cwiseAbs().maxCoeff() > kRingColor;
}

/// Those between which the rod is as good as straight and of one colour. `colors`: of the nodes.
std::vector<Ring> rings_of(const Points& points, Colors::const_iterator colors) {
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
    rings.push_back({points.col(i), normal, tangent.cross(normal), colors[i]});
    last_tangent = tangent;
  }
  std::vector<Ring> needed;
  for (std::size_t i = 0; i < rings.size(); ++i)
    if (i == 0 || i + 1 == rings.size() || differ(rings[i + 1], needed.back())) needed.push_back(rings[i]);
  return needed;
}

Marker cylinder(const char* ns, int id, const Vec3& from, const Vec3& to, double radius, const std_msgs::ColorRGBA& c) {
  const Vec3 axis = to - from;
  Marker m = marker_of(ns, id, Marker::CYLINDER, {2.0 * radius, 2.0 * radius, axis.norm()}, c);
  m.pose.position = to_point(0.5 * (from + to));
  // A marker's cylinder stands along z.
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis);
  m.pose.orientation.w = turn.w();
  m.pose.orientation.x = turn.x();
  m.pose.orientation.y = turn.y();
  m.pose.orientation.z = turn.z();
  return m;
}

/// It goes with the frame of its grip.
Marker body_marker(int id, const GripBody& body, double radius) {
  const Vec3 half = body.half_length(radius) * body.axis;
  Marker m = marker_of("grips", id, Marker::CUBE, 2.0 * body.half_box(radius), kBodyColor);
  m.pose.position = to_point(body.from_grip);
  if (body.cylinder_radius > 0.0)
    m = cylinder("grips", id, body.from_grip - half, body.from_grip + half, body.cylinder_radius, kBodyColor);
  m.header.frame_id = body.goes_up ? names::kUpperGripFrame : names::kLowerGripFrame;
  m.frame_locked = true;
  return m;
}

/// A tube of this many sides around a centreline, added to a list of triangles.
void add_tube(Marker& m, const std::vector<Ring>& rings, double radius, int sides) {
  const auto add_side = [&](const Ring& ring, double r, int side) {
    const double angle = 2.0 * M_PI * side / sides;
    const Vec3 normal = std::cos(angle) * ring.normal + std::sin(angle) * ring.binormal;
    m.points.push_back(to_point(ring.center + r * normal));
    m.colors.push_back(lit(ring.color, normal));
  };
  const auto add_band = [&](const Ring& a, double radius_a, const Ring& b, double radius_b) {
    for (int side = 0; side < sides; ++side) {
      add_side(a, radius_a, side), add_side(a, radius_a, side + 1), add_side(b, radius_b, side + 1);
      add_side(a, radius_a, side), add_side(b, radius_b, side + 1), add_side(b, radius_b, side);
    }
  };
  add_band(rings.front(), 0.0, rings.front(), radius);
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) add_band(rings[i], radius, rings[i + 1], radius);
  add_band(rings.back(), radius, rings.back(), 0.0);
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

Marker tube_marker(const Points& points, const Colors& colors, const RopeRadii& radius, const std::vector<int>& missing,
                   int sides) {
  Marker m = marker_of("rod", 0, Marker::TRIANGLE_LIST, Vec3::Ones(), kWhite);
  for (const Piece& piece : pieces_between(points.cols(), missing))
    if (piece.nodes() > 1)
      add_tube(m, rings_of(points.middleCols(piece.begin, piece.nodes()), colors.begin() + piece.begin),
               radius(piece.begin), sides);
  return m;
}

std::vector<Marker> cylinder_markers(const Points& points, const Colors& colors, const RopeRadii& radius,
                                     const std::vector<int>& missing) {
  std::vector<Marker> cylinders;
  for (const Piece& piece : pieces_between(points.cols(), missing)) {
    if (piece.nodes() < 2) continue;
    const double r = radius(piece.begin);
    const auto rings = rings_of(points.middleCols(piece.begin, piece.nodes()), colors.begin() + piece.begin);
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      const Vec3 along = (rings[i + 1].center - rings[i].center).normalized();
      const auto to_mitre = [&](const Ring& ring) -> Vec3 {
        const double cosine = std::max(ring.along().dot(along), kRoundBend);
        return r * std::sqrt(std::max(1.0 / (cosine * cosine) - 1.0, 0.0)) * along;
      };
      cylinders.push_back(cylinder("rod", static_cast<int>(cylinders.size()), rings[i].center - to_mitre(rings[i]),
                                   rings[i + 1].center + to_mitre(rings[i + 1]), r, rings[i].color));
    }
  }
  return cylinders;
}

Marker contact_marker(const std::vector<ContactForce>& forces, double radius, const ColorScale& scale, double longest) {
  Marker m = marker_of("contact_forces", 0, Marker::LINE_LIST, {kForceWidth * radius, 0.0, 0.0}, kContactColor);
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
  for (Eigen::Index i = 1; i + 1 < points.cols(); ++i) {
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
  Rod rod;
  const double gap = kPartedGap * radii_.first, parted = view.sample.break_arclength;
  for (Eigen::Index i = 0; i + 1 < view.points.cols(); ++i) {
    const bool gone = arclength_[i + 1] > parted - gap && arclength_[i] < parted + gap;
    if (gone || std::binary_search(cuts_.begin(), cuts_.end(), i)) rod.missing.push_back(static_cast<int>(i));
    if (gone) value.segment(i, 2).setZero();  // no bend is there any more
  }
  if (by_tension && !std::isnan(parted)) value.setConstant(Sample::kNone);
  for (const double x : value) rod.colors.push_back(std::isfinite(x) ? scale().color(x) : kUnknown);
  return rod;
}

Vec3 ScenePicture::knot(const Points& points) const {
  const Eigen::ArrayXd bend = curvature_at_nodes(points, radii_, cuts_).array().max(kNoBend).square();
  return points * bend.matrix() / bend.sum();
}

visualization_msgs::MarkerArray ScenePicture::bodies() const {
  visualization_msgs::MarkerArray array = nothing();
  for (const GripBody& body : bodies_)
    array.markers.push_back(body_marker(static_cast<int>(array.markers.size()), body, thickest(material_)));
  return array;
}

visualization_msgs::MarkerArray ScenePicture::draw(const SceneView& view) const {
  const Rod rod = rod_of(view);
  visualization_msgs::MarkerArray array = nothing();
  std::vector<Marker>& markers = array.markers;
  if (sides_ > 0) {
    markers.push_back(tube_marker(view.points, rod.colors, radii_, rod.missing, sides_));
  } else {
    for (const Marker& one : cylinder_markers(view.points, rod.colors, radii_, rod.missing)) markers.push_back(one);
  }
  for (const Eigen::Index node : gauge_) {
    const Vec3 here = view.points.col(node);
    const Vec3 half = kGaugeMark * radii_(node) * (view.points.col(node + 1) - here).normalized();
    markers.push_back(cylinder("gauge_marks", static_cast<int>(markers.size()), here - half, here + half,
                               kAboveTheRod * radii_(node), kInk));
  }
  if (show_contacts_ && std::isnan(view.sample.break_arclength) && !view.contacts.empty())
    markers.push_back(contact_marker(view.contacts, radii_.first, tension_, kLongestForce * radii_.first));
  for (Marker& marker : markers) marker.header.stamp = view.stamp;
  return array;
}

}  // namespace knot_utm
