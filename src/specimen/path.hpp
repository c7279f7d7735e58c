#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/polyline.hpp"

namespace knot_utm {

/// Spacing at which curves are drawn before they are resampled.
inline double drawing_spacing(double radius, double edge_length) { return std::min(radius, edge_length) / 16.0; }

/// Radius to draw with so that a circle smoothed by a Gaussian ends up with the given one.
inline double before_smoothing(double radius, double deviation) {
  return radius * std::exp(0.5 * std::pow(deviation / radius, 2));
}

/// A path drawn as points that are dense along curves; arclength as it grows.
class Path {
 public:
  explicit Path(double spacing) : spacing_(spacing) {}

  void add(const Vec3& point) {
    if (!points_.empty()) {
      const double step = (point - points_.back()).norm();
      if (step < 1e-9 * spacing_) return;
      length_ += step;
    }
    points_.push_back(point);
    arclength_.push_back(length_);
  }

  /// Adds curve(0) to curve(1), about `length` long.
  template <typename Curve>
  void add_curve(double length, Curve curve) {
    const int pieces = std::max(8, static_cast<int>(std::ceil(length / spacing_)));
    for (int i = 0; i <= pieces; ++i) add(curve(static_cast<double>(i) / pieces));
  }

  double length() const { return length_; }
  const std::vector<Vec3>& points() const { return points_; }

  Vec3 at(double s) const {
    const auto next = std::upper_bound(arclength_.begin(), arclength_.end(), s);
    const auto i =
        std::clamp<std::ptrdiff_t>(next - arclength_.begin(), 1, static_cast<std::ptrdiff_t>(points_.size()) - 1);
    const auto j = static_cast<std::size_t>(i);
    const double t = (s - arclength_[j - 1]) / (arclength_[j] - arclength_[j - 1]);
    return points_[j - 1] + t * (points_[j] - points_[j - 1]);
  }

 private:
  double spacing_;
  double length_ = 0.0;
  std::vector<Vec3> points_;
  std::vector<double> arclength_;
};

/// The path smoothed along its arclength by a Gaussian, sampled evenly: column i was at arclength i length/(columns-1).
/// Beyond its ends the path goes on straight, so ends with a straight piece stay where they are.
Points smoothed(const Path& path, double deviation, double spacing);

/// Resamples a smoothed path and carries arclengths of the path over to the resampled rod.
class Resampled {
 public:
  /// `wanted` speaks of arclengths of the path.
  Resampled(const Path& path, const Points& smooth, const EdgeGrading& wanted);

  /// Arclength on the rod, along its edges, of the place that was at arclength s of the path.
  double operator()(double s) const;

  Points points;

 private:
  double on_smooth(double s) const;

  double path_length_;
  std::vector<double> arclength_;       // of the smoothed path's points
  std::vector<double> node_position_;   // of the nodes, on the smoothed path
  std::vector<double> node_arclength_;  // of the nodes, along the edges
};

}  // namespace knot_utm
