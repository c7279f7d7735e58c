#pragma once

#include <cstdint>
#include <string>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/record.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/ros/bag_writer.hpp"
#include "knot_utm/ros/machine_frames.hpp"
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/ros/views.hpp"

namespace knot_utm {

/// test.bag: the topics of one test with the stamps of their headers, the same from a live and from a headless run.
/// utm/crosshead, utm/joint_states and knot/state for every command; utm/load_cell for every reading (cell_reading),
/// knot/shape at sampling instants. A rod that parts is read in the time step that parts it, of which there is a
/// knot/state, too.
///
/// `rosbag play` and rviz show it, with nothing else running: for that it holds utm/method, knot/colors and, at every
/// reading, knot/markers (small ones, ScenePicture::draw_small), all frames on /tf, and utm/status without what only
/// the clock on the wall tells.
class RunBag {
 public:
  /// Throws std::runtime_error where the file cannot be written, as all of it does, and InvalidInput where the specimen
  /// does not fit the machine.
  RunBag(const std::string& file, const Method& method);
  void add(const Record& record);
  void close() { bag_.close(); }

  std::uint64_t messages() const { return bag_.messages(); }  ///< written so far

 private:
  void add_reading(const Sample& reading, const ros::Time& answered);
  void begin(const ros::Time& stamp, const Points& shape);
  void add_status(const Record& record, const ros::Time& stamp);
  void add_picture(const Record& record, const ros::Time& stamp);

  BagWriter bag_;
  std::string method_;  ///< its text
  double radius_;       ///< [m]
  Grips grips_;
  MachineFrames frames_;
  ScenePicture picture_;
  Views views_;
  bool begun_ = false;
  bool broken_ = false;
  MotionPatternTracker motion_;
};

}  // namespace knot_utm
