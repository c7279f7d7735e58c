#include "knot_utm/ros/markers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

using visualization_msgs::Marker;

constexpr double kPi = 3.14159265358979323846;

geometry_msgs::Point to_point(const Vec3& v) {
  geometry_msgs::Point point;
  point.x = v.x();
  point.y = v.y();
  point.z = v.z();
  return point;
}

std_msgs::ColorRGBA color(double red, double green, double blue) {
  std_msgs::ColorRGBA c;
  c.r = static_cast<float>(red);
  c.g = static_cast<float>(green);
  c.b = static_cast<float>(blue);
  c.a = 1.0f;
  return c;
}

/// Blue below zero, light grey at zero, yellow to red above.
std_msgs::ColorRGBA value_color(double value, double highest) {
  const double x = highest > 0.0 ? std::clamp(value / highest, -1.0, 1.0) : 0.0;
  if (x < 0.0) return color(0.85 + 0.7 * x, 0.85 + 0.5 * x, 0.85 - 0.1 * x);
  if (x < 0.5) return color(0.85 + 0.3 * x, 0.85 - 0.1 * x, 0.85 - 1.5 * x);
  return color(1.0 - 0.3 * (x - 0.5), 0.8 - 1.5 * (x - 0.5), 0.1);
}

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
constexpr double kLongestForce = 6.0;   // half of the line of the largest contact force [radius]

const std_msgs::ColorRGBA kInk = color(0.12, 0.12, 0.15);
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

Marker base_marker(const char* ns, int id, int type) {
  Marker m;
  m.header.frame_id = names::kBaseFrame;
  m.ns = ns;
  m.id = id;
  m.type = type;
  m.action = Marker::ADD;
  m.pose.orientation.w = 1.0;
  return m;
}

Marker grip_marker(int id, const MachineOptions& machine, const Vec3& center, double radius) {
  const bool roller = machine.grips == GripKind::kRollers;
  Marker m = base_marker("grips", id, roller ? Marker::CYLINDER : Marker::CUBE);
  m.pose.position = to_point(center);
  if (roller) {
    // A marker's cylinder stands along z; the rollers lie along y.
    m.pose.orientation.x = std::sqrt(0.5);
    m.pose.orientation.w = std::sqrt(0.5);
    m.scale.x = m.scale.y = machine.roller_diameter;
    m.scale.z = 12.0 * radius;
  } else {
    m.scale.x = m.scale.y = 6.0 * radius;
    m.scale.z = 4.0 * radius;
  }
  m.color = color(0.45, 0.47, 0.52);
  return m;
}

std::string reading_text(const SceneView& view, ColorBy color_by, double highest) {
  const Sample& sample = view.sample;
  char text[256];
  std::snprintf(text, sizeof text, "%s\nF = %.4g N\ns = %.1f mm\n", phase_name(sample.phase), sample.load,
                1e3 * sample.extension);
  std::string out = text;
  if (!std::isnan(sample.knot_distance)) {
    std::snprintf(text, sizeof text, "e = %.1f mm\n", 1e3 * sample.knot_distance);
    out += text;
  }
  std::snprintf(text, sizeof text,
                color_by == ColorBy::kTension ? "\nred: %.3g N in the rod" : "\nred: bent to %.2g radii",
                color_by == ColorBy::kTension || highest <= 0.0 ? highest : 1.0 / highest);
  return out + view.motion_pattern + text;
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
  Marker m = base_marker(ns, 0, Marker::TRIANGLE_LIST);
  m.scale.x = m.scale.y = m.scale.z = 1.0;
  m.color = color(1.0, 1.0, 1.0);
  return m;
}

/// Dark bands on the rod, each along the edges beside its node.
Marker gauge_marker(const Points& points, const std::vector<Eigen::Index>& nodes, double radius) {
  Marker m = triangles("gauge_marks");
  for (const Eigen::Index node : nodes) {
    if (node < 1 || node + 1 >= points.cols()) continue;
    const Vec3 here = points.col(node);
    const auto towards = [&](Eigen::Index other) -> Vec3 {
      const Vec3 way = points.col(other) - here;
      return here + std::min(1.0, kGaugeMark * radius / way.norm()) * way;
    };
    Points band(3, 3);
    band << towards(node - 1), here, towards(node + 1);
    Tube(m, band, kAboveTheRod * radius, TubeOptions().sides).draw([](std::size_t) { return kInk; });
  }
  return m;
}

}  // namespace

Eigen::VectorXd tension_at_nodes(const Eigen::VectorXd& tension) {
  const Eigen::Index edges = tension.size();
  if (edges == 0) return {};
  Eigen::VectorXd out(edges + 1);
  out[0] = tension[0];
  out[edges] = tension[edges - 1];
  for (Eigen::Index i = 1; i < edges; ++i) out[i] = 0.5 * (tension[i - 1] + tension[i]);
  return out;
}

Eigen::VectorXd curvature_at_nodes(const Points& points, double radius) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(points.cols());
  for (Eigen::Index i = 1; i + 1 < points.cols(); ++i) {
    const Vec3 before = points.col(i) - points.col(i - 1), after = points.col(i + 1) - points.col(i);
    const double lengths = before.norm() * after.norm();
    if (lengths <= 0.0) continue;
    // 2 tan(angle/2) over the mean length.
    const double tangent = before.cross(after).norm() / (lengths + before.dot(after));
    out[i] = radius * 4.0 * tangent / (before.norm() + after.norm());
  }
  return out;
}

Marker tube_marker(const Points& points, const Eigen::VectorXd& value, double radius, const TubeOptions& options) {
  Marker m = triangles("rod");
  if (points.cols() < 2) return m;
  const std::size_t corners = 6 * static_cast<std::size_t>(options.sides) * static_cast<std::size_t>(points.cols());
  m.points.reserve(corners);
  m.colors.reserve(corners);
  const auto piece = [&](Eigen::Index first, Eigen::Index end) {
    if (end - first < 2) return;
    Tube(m, points.middleCols(first, end - first), radius, options.sides).draw([&](std::size_t node) {
      return value_color(value.size() > 0 ? value[first + static_cast<Eigen::Index>(node)] : 0.0, options.highest);
    });
  };
  piece(0, options.parted + 1);
  piece(options.parted + 1, points.cols());
  return m;
}

Marker contact_marker(const std::vector<ContactForce>& forces, double radius, double highest, double longest) {
  Marker m = base_marker("contact_forces", 0, Marker::LINE_LIST);
  m.scale.x = 0.35 * radius;
  m.color = kContactColor;
  m.points.reserve(2 * forces.size());
  for (const ContactForce& contact : forces) {
    const Vec3 half = highest > 0.0 ? Vec3(longest / highest * contact.force) : Vec3::Zero();
    m.points.push_back(to_point(contact.place - half));
    m.points.push_back(to_point(contact.place + half));
  }
  return m;
}

void ScenePicture::begin(const Points& points) {
  forget_largest();
  gauge_.clear();
  arclength_ = Eigen::VectorXd::Zero(points.cols());
  for (Eigen::Index i = 1; i < points.cols(); ++i)
    arclength_[i] = arclength_[i - 1] + (points.col(i) - points.col(i - 1)).norm();
  for (Eigen::Index i = 1; i < points.cols(); ++i) {
    const double next = arclength_[points.cols() - 1] * static_cast<double>(gauge_.size() + 1) / (kGaugeMarks + 1.0);
    if (gauge_.size() < kGaugeMarks && arclength_[i] >= next) gauge_.push_back(i);
  }
}

Eigen::Index ScenePicture::parted_edge(const Sample& sample) const {
  if (std::isnan(sample.break_arclength)) return -1;
  const double* end = arclength_.data() + arclength_.size();
  return std::upper_bound(arclength_.data(), end, sample.break_arclength) - arclength_.data() - 1;
}

Marker ScenePicture::rod_marker(const SceneView& view) {
  const bool by_tension = color_by_ == ColorBy::kTension;
  Eigen::VectorXd value = by_tension ? tension_at_nodes(view.tension) : curvature_at_nodes(view.points, radius_);
  TubeOptions tube;
  tube.parted = std::min(parted_edge(view.sample), view.points.cols() - 2);
  if (tube.parted >= 0 && !by_tension) value.segment(tube.parted, 2).setZero();  // no bend is there any more
  double& highest = by_tension ? highest_tension_ : highest_curvature_;
  if (value.size() > 0) highest = std::max(highest, value.maxCoeff());
  tube.highest = highest;
  return tube_marker(view.points, value, radius_, tube);
}

Marker ScenePicture::text_marker(const SceneView& view) const {
  Marker m = base_marker("reading", 0, Marker::TEXT_VIEW_FACING);
  const double height = 0.04 * std::max((view.upper_grip - view.lower_grip).norm(), 0.1);
  m.pose.position = to_point(view.upper_grip - Vec3(4.0 * height + machine_.roller_diameter, 0.0, 2.0 * height));
  m.scale.z = height;
  m.color = color(1.0, 1.0, 1.0);
  m.text = reading_text(view, color_by_, color_by_ == ColorBy::kTension ? highest_tension_ : highest_curvature_);
  return m;
}

visualization_msgs::MarkerArray ScenePicture::draw(const SceneView& view, const ros::Time& stamp) {
  if (view.sample.phase != phase_) forget_largest();
  phase_ = view.sample.phase;
  for (const ContactForce& contact : view.contacts) highest_contact_ = std::max(highest_contact_, contact.force.norm());
  visualization_msgs::MarkerArray array;
  array.markers.push_back(rod_marker(view));
  array.markers.push_back(gauge_marker(view.points, gauge_, radius_));
  array.markers.push_back(contact_marker(show_contacts_ ? view.contacts : std::vector<ContactForce>(), radius_,
                                         highest_contact_, kLongestForce * radius_));
  array.markers.push_back(grip_marker(0, machine_, view.lower_grip, radius_));
  array.markers.push_back(grip_marker(1, machine_, view.upper_grip, radius_));
  array.markers.push_back(text_marker(view));
  for (Marker& marker : array.markers) {
    marker.header.stamp = stamp;
    const bool a_list = marker.type == Marker::TRIANGLE_LIST || marker.type == Marker::LINE_LIST;
    if (a_list && marker.points.empty()) marker.action = Marker::DELETE;  // rviz takes an empty list for an error
  }
  return array;
}

}  // namespace knot_utm
