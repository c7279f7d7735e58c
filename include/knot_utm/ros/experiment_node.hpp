#pragma once

#include <knot_utm/Crosshead.h>
#include <ros/ros.h>

#include <cstddef>
#include <string>
#include <vector>

#include "knot_utm/io/csv.hpp"

namespace knot_utm {

/// Tells an experiment's own record beside the test that follows it: load and extension as they were measured, each at
/// the time of the test at which the crosshead is led past it.
class ExperimentNode {
 public:
  /// `file`: curve.csv, or raw data of a testing machine. Throws InvalidInput.
  ExperimentNode(const ros::NodeHandle& node, const std::string& file);

  /// Runs until ROS is shut down. `autostart`: starts the test, once no command of it can be missed.
  void spin(bool autostart);

 private:
  void try_to_start();
  void on_command(const Crosshead::ConstPtr& command);
  void publish(const CurveRow& row, const ros::Time& stamp);

  ros::NodeHandle node_;
  std::vector<CurveRow> rows_;  ///< of the phases that pull
  std::size_t next_ = 0;        ///< row to be told
  std::uint32_t run_ = 0;       ///< test whose commands these are
  std::uint64_t sequence_ = 0;  ///< of its latest command
  ros::Time begin_;             ///< when the record does: the stamp of the last command before it is followed
  ros::Publisher load_cell_, crosshead_;
  ros::Subscriber commands_;
  ros::ServiceClient start_;
};

}  // namespace knot_utm
