#include "knot_utm/ros/markers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/ros/base_marker.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

using visualization_msgs::Marker;

constexpr double kPi = 3.14159265358979323846;

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

const std_msgs::ColorRGBA kInk = color(0.12, 0.12, 0.15);
const std_msgs::ColorRGBA kUnknown = color(0.58, 0.6, 0.63);  // of what has no known value
const std_msgs::ColorRGBA kContactColor = color(0.25, 0.85, 0.95);

/// One ring of the tube at a node.
struct Ring {
  Vec3 center, normal, binormal;  ///< normal x binormal points along the rod
};

std::vector<Ring> rings_of(const Points& points) {
  const Eigen::Index n = points.cols();
  std::vector<Ring> rings;
  rings.reserve(static_cast<std::size_t>(n));
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
  Marker m = base_marker(names::kBaseFrame, "grips", id, cylinder ? Marker::CYLINDER : Marker::CUBE);
  m.pose.position = to_point(grip + body.from_grip);
  Vec3 size = 2.0 * body.half_box(radius);
  if (cylinder) {
    // A marker's cylinder stands along z.
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), body.axis);
    m.pose.orientation.w = turn.w();
    m.pose.orientation.x = turn.x();
    m.pose.orientation.y = turn.y();
    m.pose.orientation.z = turn.z();
    size = 2.0 * Vec3(body.cylinder_radius, body.cylinder_radius, body.half_length(radius));
  }
  m.scale.x = size.x();
  m.scale.y = size.y();
  m.scale.z = size.z();
  m.color = color(0.45, 0.47, 0.52);
  return m;
}

/// What one ring of triangles to the next is made of.
class Tube {
 public:
  Tube(Marker& marker, const Points& points, double radius, int sides)
      : marker_(marker), rings_(rings_of(points)), radius_(radius), sides_(sides) {}

  template <class ColorAt>
  void draw(ColorAt color_at) {
    for (std::size_t i = 0; i + 1 < rings_.size(); ++i) {
      const std_msgs::ColorRGBA low = color_at(i), high = color_at(i + 1);
      for (int side = 0; side < sides_; ++side) {
        surface(i, side, low), surface(i, side + 1, low), surface(i + 1, side + 1, high);
        surface(i, side, low), surface(i + 1, side + 1, high), surface(i + 1, side, high);
      }
    }
    for (int side = 0; side < sides_; ++side) {
      end_cap(0, side + 1, side, color_at(0));
      end_cap(rings_.size() - 1, side, side + 1, color_at(rings_.size() - 1));
    }
  }

 private:
  Vec3 outwards(std::size_t ring, int side) const {
    const double angle = 2.0 * kPi * side / sides_;
    return std::cos(angle) * rings_[ring].normal + std::sin(angle) * rings_[ring].binormal;
  }
  void add(const Vec3& point, const std_msgs::ColorRGBA& c) {
    marker_.points.push_back(to_point(point));
    marker_.colors.push_back(c);
  }
  void surface(std::size_t ring, int side, const std_msgs::ColorRGBA& c) {
    const Vec3 normal = outwards(ring, side);
    add(rings_[ring].center + radius_ * normal, lit(c, normal));
  }
  void end_cap(std::size_t ring, int from, int to, const std_msgs::ColorRGBA& c) {
    const Ring& r = rings_[ring];
    const double direction = to > from ? 1.0 : -1.0;
    const std_msgs::ColorRGBA shade = lit(c, direction * r.normal.cross(r.binormal));
    add(r.center, shade);
    add(r.center + radius_ * outwards(ring, from), shade);
    add(r.center + radius_ * outwards(ring, to), shade);
  }

  Marker& marker_;
  std::vector<Ring> rings_;
  double radius_;
  int sides_;
};

Marker triangles(const char* ns) {
  Marker m = base_marker(names::kBaseFrame, ns, 0, Marker::TRIANGLE_LIST);
  m.scale.x = m.scale.y = m.scale.z = 1.0;
  m.color = color(1.0, 1.0, 1.0);
  return m;
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
    Tube(m, band, kAboveTheRod * radius(node), TubeOptions().sides).draw([](std::size_t) { return kInk; });
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

Marker tube_marker(const Points& points, const Colors& colors, const RopeRadii& radius, const TubeOptions& options) {
  Marker m = triangles("rod");
  if (points.cols() < 2) return m;
  const std::size_t corners = 6 * static_cast<std::size_t>(options.sides) * static_cast<std::size_t>(points.cols());
  m.points.reserve(corners);
  m.colors.reserve(corners);
  for (const Piece& piece : pieces_between(points.cols(), options.missing)) {
    if (piece.nodes() < 2) continue;
    Tube(m, points.middleCols(piece.begin, piece.nodes()), radius(piece.begin), options.sides)
        .draw([&](std::size_t node) { return colors[static_cast<std::size_t>(piece.begin) + node]; });
  }
  return m;
}

Marker spheres_marker(const Points& points, const Colors& colors, double radius, const std::vector<int>& missing,
                      const NodesOfRopes& nodes) {
  Marker m = base_marker(names::kBaseFrame, "rod", 0, Marker::SPHERE_LIST);
  m.scale.x = m.scale.y = m.scale.z = 2.0 * radius;
  m.color = color(1.0, 1.0, 1.0);
  for (Eigen::Index i = nodes.begin; i < std::min(nodes.end, points.cols()); ++i) {
    const std_msgs::ColorRGBA& here = colors[static_cast<std::size_t>(i)];
    m.points.push_back(to_point(points.col(i)));
    m.colors.push_back(here);
    if (i + 1 == points.cols() || std::binary_search(missing.begin(), missing.end(), i)) continue;
    const Vec3 edge = points.col(i + 1) - points.col(i);
    const int between = std::min(static_cast<int>(edge.norm() / (kSphereDistance * radius)), kMostBetween);
    for (int k = 1; k <= between; ++k) {
      m.points.push_back(to_point(points.col(i) + edge * k / (between + 1)));
      m.colors.push_back(here);
    }
  }
  return m;
}

Marker contact_marker(const std::vector<ContactForce>& forces, double radius, const ColorScale& scale, double longest) {
  Marker m = base_marker(names::kBaseFrame, "contact_forces", 0, Marker::LINE_LIST);
  m.scale.x = 0.35 * radius;
  m.color = kContactColor;
  m.points.reserve(2 * forces.size());
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

Eigen::Index ScenePicture::parted_edge(const SceneView& view) const {
  if (std::isnan(view.sample.break_arclength)) return -1;
  const double* end = arclength_.data() + arclength_.size();
  const Eigen::Index edge =
      std::upper_bound(arclength_.data(), end, view.sample.break_arclength) - arclength_.data() - 1;
  return std::min(edge, view.points.cols() - 2);
}

std::vector<int> ScenePicture::missing(Eigen::Index parted) const {
  std::vector<int> out = cuts_;
  if (parted >= 0) out.insert(std::upper_bound(out.begin(), out.end(), parted), static_cast<int>(parted));
  return out;
}

Colors ScenePicture::colors(const SceneView& view, Eigen::Index parted) const {
  const bool by_tension = color_by_ == ColorBy::kTension;
  Eigen::VectorXd value =
      by_tension ? tension_at_nodes(view.tension, cuts_) : curvature_at_nodes(view.points, radii_, cuts_);
  value.conservativeResizeLike(Eigen::VectorXd::Constant(view.points.cols(), Sample::kNone));
  if (parted >= 0 && by_tension) value.setConstant(Sample::kNone);
  if (parted >= 0 && !by_tension) value.segment(parted, 2).setZero();  // no bend is there any more
  Colors out;
  out.reserve(static_cast<std::size_t>(value.size()));
  for (const double x : value) out.push_back(std::isfinite(x) ? scale().color(x) : kUnknown);
  return out;
}

Marker ScenePicture::rod_marker(const SceneView& view) const {
  const Eigen::Index parted = parted_edge(view);
  TubeOptions tube;
  tube.missing = missing(parted);
  return tube_marker(view.points, colors(view, parted), radii_, tube);
}

void ScenePicture::add_bodies(const SceneView& view, std::vector<Marker>& markers) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    markers.push_back(body_marker(static_cast<int>(i), bodies_[i],
                                  bodies_[i].goes_up ? view.upper_grip : view.lower_grip, thickest(material_)));
}

namespace {

visualization_msgs::MarkerArray stamped(std::vector<Marker> markers, const ros::Time& stamp) {
  for (Marker& marker : markers) {
    marker.header.stamp = stamp;
    const bool a_list = marker.type == Marker::TRIANGLE_LIST || marker.type == Marker::LINE_LIST;
    if (a_list && marker.points.empty()) marker.action = Marker::DELETE;  // rviz takes an empty list for an error
  }
  visualization_msgs::MarkerArray array;
  array.markers = std::move(markers);
  return array;
}

}  // namespace

visualization_msgs::MarkerArray ScenePicture::draw(const SceneView& view) const {
  std::vector<Marker> markers{rod_marker(view), gauge_marker(view.points, gauge_, radii_),
                              contact_marker(show_contacts_ ? view.contacts : std::vector<ContactForce>(), radii_.first,
                                             tension_, kLongestForce * radii_.first)};
  add_bodies(view, markers);
  return stamped(std::move(markers), view.stamp);
}

visualization_msgs::MarkerArray ScenePicture::draw_small(const SceneView& view) const {
  const Eigen::Index parted = parted_edge(view);
  Colors shown = colors(view, parted);
  for (const Eigen::Index node : gauge_)
    if (node < view.points.cols()) shown[static_cast<std::size_t>(node)] = kInk;
  const auto row = [&](double radius, const NodesOfRopes& nodes) {
    return spheres_marker(view.points, shown, radius, missing(parted), nodes);
  };
  std::vector<Marker> markers{row(radii_.first, {0, radii_.first_of_others})};
  if (radii_.first_of_others < view.points.cols()) {
    markers.push_back(row(radii_.others, {radii_.first_of_others}));
    markers.back().id = 1;
  }
  add_bodies(view, markers);
  return stamped(std::move(markers), view.stamp);
}

}  // namespace knot_utm
