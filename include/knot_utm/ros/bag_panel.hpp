#pragma once

#include <visualization_msgs/Marker.h>

#include <string>
#include <vector>

#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/color_scale.hpp"

namespace knot_utm {

/// How a test stands, in words: "running", "broke", "came undone", "ran through itself" or "the physics gave up".
std::string condition_of(const Sample& sample, const std::string& motion_pattern);

/// The readings and the force-extension curve of a test as markers. A bag that has them shows what the panel beside
/// rviz shows (python/knot_utm/panel), while nothing of this package runs. They stand at fixed places in the picture of
/// config/bag.rviz, in front of everything else: the readings at its left, the curve at its right. Where large loads
/// hide those of sliding, the curve is drawn once more with these alone.
class BagPanel {
 public:
  /// Width over height of the narrowest picture that shows all of it.
  static constexpr double kNarrowest = 1.55;

  explicit BagPanel(std::string title) : title_(std::move(title)) {}

  /// Adds a reading of the load cell. `slides`: the knots slide and have not locked.
  void add(const Sample& reading, bool slides);

  /// `distance` [m]: from the camera to what it looks at.
  std::vector<visualization_msgs::Marker> draw(const Sample& sample, const std::string& motion_pattern,
                                               const ColorScale& scale, double distance) const;

 private:
  struct Point {
    double extension, load;
    bool slides;
  };
  std::vector<std::string> lines(const Sample& sample, const std::string& motion_pattern,
                                 const ColorScale& scale) const;
  double small_load() const;  ///< where the axis of the small loads ends [N]; 0: there is none

  std::string title_;
  std::vector<Point> points_;  ///< evenly chosen among the readings, and the latest
  std::size_t readings_ = 0;   ///< number of readings since the zero
  std::size_t stride_ = 1;     ///< one of so many readings is kept
  double zero_ = 0.0;          ///< balance offset of the points [N]
};

}  // namespace knot_utm
