#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/specimen/options.hpp"
#include "knot_utm/specimen/polyline.hpp"

namespace knot_utm {

/// Spacing of the points of a curve before it is resampled [m].
inline double sketch_spacing(double radius, double edge_length) { return std::min(radius, edge_length) / 16.0; }

/// Radius of a circle that has the given radius after it is smoothed by a Gaussian with the standard deviation
/// `deviation` [m].
inline double before_smoothing(double radius, double deviation) {
  return radius * std::exp(0.5 * std::pow(deviation / radius, 2));
}

/// A path given by closely spaced points, with their arclengths.
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

  /// Adds the points of curve(t) for t from 0 to 1. `length`: its approximate length [m].
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

/// The path smoothed along its arclength by a Gaussian with the standard deviation `deviation`, sampled evenly. Column
/// i was at the arclength i length/(columns - 1). Beyond its ends the path is continued straight, so straight ends stay
/// where they are.
Points smoothed(const Path& path, double deviation, double spacing);

/// Resamples a smoothed path, and converts arclengths of the path to those of the resampled rod.
class Resampled {
 public:
  /// `wanted`: edge lengths by arclength of the path.
  Resampled(const Path& path, const Points& smooth, const EdgeGrading& wanted);

  /// Arclength on the rod, along its edges, of the place at arclength s of the path [m].
  double operator()(double s) const;

  Points points;

 private:
  double on_smooth(double s) const;

  double path_length_;
  std::vector<double> arclength_;       // of the smoothed path's points
  std::vector<double> node_position_;   // of the nodes, on the smoothed path
  std::vector<double> node_arclength_;  // of the nodes, along the edges
};

/// A length for a message, with four digits.
std::string text(double value);
/// A place for a message, "(1.2, 0.0, -3.0)".
std::string place_text(const Vec3& place);

/// Throw InvalidInput where a rod of this radius [m] cannot be sketched, or cannot be sketched with edges of this
/// length [m].
void check_radius(double radius);
void check_edge_length(double edge_length, double radius);

void check_edges_of_length(const SpecimenOptions& specimen);

}  // namespace knot_utm
