#pragma once

#include <visualization_msgs/Marker.h>

#include <string>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/color_scale.hpp"

namespace knot_utm {

/// How a test stands, in words: "running", "broke", "came undone", "ran through itself" or "the physics gave up".
std::string condition_of(const Sample& sample, const std::string& motion_pattern);

/// The readings and the force-extension curve of a test as markers. A bag that has them shows what the panel beside
/// rviz shows (python/knot_utm/panel), while nothing of this package runs. They stand upright beside the machine, in
/// the plane of x and z: the readings at its left, the curve at its right. Where large loads hide those of sliding, the
/// curve is drawn once more with these alone.
class BagPanel {
 public:
  /// `middle` and `half_height` [m]: where it stands, in utm_base.
  BagPanel(std::string title, const Vec3& middle, double half_height)
      : title_(std::move(title)), middle_(middle), half_height_(half_height) {}

  /// Adds a reading of the load cell. `slides`: the knots slide and have not locked.
  void add(const Sample& reading, bool slides);

  std::vector<visualization_msgs::Marker> draw(const Sample& sample, const std::string& motion_pattern,
                                               const ColorScale& scale) const;

 private:
  struct Point {
    double extension, load;
    bool slides;
  };
  std::vector<std::string> lines(const Sample& sample, const std::string& motion_pattern,
                                 const ColorScale& scale) const;
  double small_load() const;  ///< where the axis of the small loads ends [N]; 0: there is none

  std::string title_;
  Vec3 middle_;                ///< [m]
  double half_height_;         ///< [m]
  std::vector<Point> points_;  ///< evenly chosen among the readings, and the latest
  std::size_t readings_ = 0;   ///< number of readings since the zero
  std::size_t stride_ = 1;     ///< one of so many readings is kept
  double zero_ = 0.0;          ///< balance offset of the points [N]
};

}  // namespace knot_utm
