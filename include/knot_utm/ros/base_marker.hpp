#pragma once

#include <geometry_msgs/Point.h>
#include <visualization_msgs/Marker.h>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

inline geometry_msgs::Point to_point(const Vec3& v) {
  geometry_msgs::Point point;
  point.x = v.x();
  point.y = v.y();
  point.z = v.z();
  return point;
}

/// A marker for rviz that is still without size, colour and content. `ns`: its namespace, within which `id` is unique.
inline visualization_msgs::Marker base_marker(const char* frame, const char* ns, int id, int type) {
  visualization_msgs::Marker m;
  m.header.frame_id = frame;
  m.ns = ns;
  m.id = id;
  m.type = type;
  m.action = visualization_msgs::Marker::ADD;
  m.pose.orientation.w = 1.0;
  return m;
}

}  // namespace knot_utm
