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

/// Blue in compression, light grey without force, yellow to red in tension.
std_msgs::ColorRGBA tension_color(double tension, double highest) {
  const double x = highest > 0.0 ? std::clamp(tension / highest, -1.0, 1.0) : 0.0;
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

std::string reading_text(const Sample& sample, const std::string& motion_pattern) {
  char text[160];
  std::snprintf(text, sizeof text, "%s\nF = %.4g N\ns = %.1f mm\n%s", phase_name(sample.phase), sample.load,
                1e3 * sample.extension, motion_pattern.c_str());
  return text;
}

}  // namespace

Marker tube_marker(const Points& points, const Eigen::VectorXd& tension, double radius, const TubeOptions& options) {
  Marker m = base_marker("rod", 0, Marker::TRIANGLE_LIST);
  m.scale.x = m.scale.y = m.scale.z = 1.0;
  m.color = color(1.0, 1.0, 1.0);
  const Eigen::Index n = points.cols();
  if (n < 2) return m;

  const std::vector<Ring> rings = rings_of(points);
  const auto outwards = [&](std::size_t ring, int side) -> Vec3 {
    const double angle = 2.0 * kPi * side / options.sides;
    return std::cos(angle) * rings[ring].normal + std::sin(angle) * rings[ring].binormal;
  };
  const auto color_at = [&](std::size_t node) {
    const Eigen::Index i = static_cast<Eigen::Index>(node);
    if (tension.size() == 0) return tension_color(0.0, 1.0);
    const Eigen::Index last = tension.size() - 1;
    const double mean = 0.5 * (tension[std::clamp<Eigen::Index>(i - 1, 0, last)] + tension[std::min(i, last)]);
    return tension_color(mean, options.highest_tension);
  };
  const auto add = [&](const Vec3& point, const std_msgs::ColorRGBA& c) {
    m.points.push_back(to_point(point));
    m.colors.push_back(c);
  };

  const std::size_t triangles = static_cast<std::size_t>(options.sides) * 2 * rings.size();
  m.points.reserve(3 * triangles);
  m.colors.reserve(3 * triangles);
  const auto surface = [&](std::size_t ring, int side, const std_msgs::ColorRGBA& c) {
    const Vec3 normal = outwards(ring, side);
    add(rings[ring].center + radius * normal, lit(c, normal));
  };
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const std_msgs::ColorRGBA low = color_at(i);
    const std_msgs::ColorRGBA high = color_at(i + 1);
    for (int side = 0; side < options.sides; ++side) {
      surface(i, side, low), surface(i, side + 1, low), surface(i + 1, side + 1, high);
      surface(i, side, low), surface(i + 1, side + 1, high), surface(i + 1, side, high);
    }
  }
  const auto end_cap = [&](std::size_t ring, int from, int to) {
    const Ring& r = rings[ring];
    const double direction = to > from ? 1.0 : -1.0;
    const std_msgs::ColorRGBA c = lit(color_at(ring), direction * r.normal.cross(r.binormal));
    add(r.center, c);
    add(r.center + radius * outwards(ring, from), c);
    add(r.center + radius * outwards(ring, to), c);
  };
  for (int side = 0; side < options.sides; ++side) {
    end_cap(0, side + 1, side);
    end_cap(rings.size() - 1, side, side + 1);
  }
  return m;
}

visualization_msgs::MarkerArray scene_markers(const SceneView& view, const ros::Time& stamp) {
  visualization_msgs::MarkerArray array;
  TubeOptions tube;
  tube.highest_tension = view.highest_tension;
  array.markers.push_back(tube_marker(view.points, view.tension, view.radius, tube));
  array.markers.push_back(grip_marker(0, view.machine, view.lower_grip, view.radius));
  array.markers.push_back(grip_marker(1, view.machine, view.upper_grip, view.radius));

  Marker text = base_marker("reading", 0, Marker::TEXT_VIEW_FACING);
  const double height = 0.04 * std::max((view.upper_grip - view.lower_grip).norm(), 0.1);
  text.pose.position = to_point(view.upper_grip - Vec3(4.0 * height + view.machine.roller_diameter, 0.0, height));
  text.scale.z = height;
  text.color = color(1.0, 1.0, 1.0);
  text.text = reading_text(view.sample, view.motion_pattern);
  array.markers.push_back(text);

  for (Marker& marker : array.markers) marker.header.stamp = stamp;
  return array;
}

}  // namespace knot_utm
