#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/ros/bag_writer.hpp"
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/settings/step_settings.hpp"

namespace knot_utm {

/// Writes test.bag: the topics of one test, at the stamps of their headers. Tests with and without ROS give the same
/// bag. It has utm/crosshead, utm/joint_states and knot/state for every command, utm/load_cell for every reading
/// (cell_reading), and knot/shape at sampling instants. The load cell is also read in the time step in which a rod
/// parts, and the bag has a knot/state for that step, too.
///
/// `rosbag play`, rviz and panel_node can show the bag while nothing else runs. For this it contains utm/method,
/// knot/colors and all frames on /tf, and at every reading knot/markers (ScenePicture::draw_small). utm/status is
/// included without the fields that depend on wall time.
class RunBag {
 public:
  /// Throws InvalidInput where the specimen does not fit the machine. All functions throw std::runtime_error where the
  /// file cannot be written.
  RunBag(const std::string& file, const Method& method)
      : RunBag(file, method, specimen_centreline(method.specimen, method.material, method.machine, method.physics)) {}
  void add(const Record& record);
  void close() { bag_.close(); }

  std::uint64_t messages() const { return bag_.messages(); }  ///< number of messages written so far

 private:
  RunBag(const std::string& file, const Method& method, const Centreline& centreline);
  void add_reading(const Sample& reading, const ros::Time& answered);
  void begin(const ros::Time& stamp, const Points& shape);
  void add_status(const Record& record, const ros::Time& stamp);
  void add_picture(const Record& record, const ros::Time& stamp);

  BagWriter bag_;
  std::string method_;     ///< text of the method
  double radius_;          ///< [m]
  std::vector<int> cuts_;  ///< edges between one rope and the next
  Grips grips_;
  Vec3 crosshead_;  ///< at the beginning of the test [m]
  ScenePicture picture_;
  bool begun_ = false;
  bool broken_ = false;
  MotionPatternTracker motion_;
};

}  // namespace knot_utm
