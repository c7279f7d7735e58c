#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// Two strands of one rod of radius 1. A node far away lies between them, so that what joins them touches nothing.
/// The rod is as long at rest as it is drawn.
struct TwoStrandsOfARod {
  static constexpr double kRadius = 1.0;
  RodProperties rod;
  Points position;
  int second = 0;  ///< first node of the second strand

  TwoStrandsOfARod(const Points& one, const Points& two) {
    second = static_cast<int>(one.cols()) + 1;
    position.resize(3, second + two.cols());
    position << one, Vec3(300.0, 400.0, 500.0), two;
    const Eigen::Index edges = position.cols() - 1;
    RodMaterial material;
    material.radius = kRadius;
    rod = make_rod(material, (position.rightCols(edges) - position.leftCols(edges)).colwise().norm());
  }

  /// The second strand at another place.
  Points moved(const Vec3& way) const {
    Points out = position;
    out.rightCols(out.cols() - second).colwise() += way;
    return out;
  }
};

/// Nodes along `direction` from `begin` on, one behind each of these edges.
inline Points straight_strand(const Vec3& begin, const Vec3& direction, const std::vector<double>& edges) {
  Points out(3, static_cast<Eigen::Index>(edges.size()) + 1);
  out.col(0) = begin;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto node = static_cast<Eigen::Index>(i);
    out.col(node + 1) = Vec3(out.col(node)) + edges[i] * direction;
  }
  return out;
}

/// Of the points on one segment.
inline std::vector<ContactPoint> on_segment(const std::vector<ContactPoint>& contacts, int segment) {
  std::vector<ContactPoint> out;
  std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(out),
               [&](const ContactPoint& contact) { return contact.a0 == segment - 1; });
  return out;
}

}  // namespace knot_utm
