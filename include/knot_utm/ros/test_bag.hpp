#pragma once

#include <cstdint>
#include <string>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/record.hpp"
#include "knot_utm/ros/bag_writer.hpp"

namespace knot_utm {

/// test.bag: the topics of one test with the stamps of their headers, the same from a live and from a headless run.
/// utm/crosshead, utm/joint_states and knot/state for every command; utm/load_cell for every reading (cell_reading),
/// knot/shape at sampling instants. A rod that parts is read in the time step that parts it, of which there is a
/// knot/state, too.
class TestBag {
 public:
  /// Throws std::runtime_error where the file cannot be written, as all of it does.
  TestBag(const std::string& file, const Method& method);
  void add(const Record& record);
  void close() { bag_.close(); }

  std::uint64_t messages() const { return bag_.messages(); }  ///< written so far

 private:
  void add_reading(const Sample& reading, const ros::Time& answered);

  BagWriter bag_;
  double radius_;  ///< [m]
  bool broken_ = false;
  MotionPatternTracker motion_;
};

}  // namespace knot_utm
