#pragma once

#include <knot_utm/Crosshead.h>
#include <ros/ros.h>

#include <cstddef>
#include <string>
#include <vector>

#include "knot_utm/raw/raw_options.hpp"

namespace knot_utm {

/// Whether the record gets its zero where its crosshead begins to move, as `compare --balance` does (raw/raw_zero.hpp).
enum class RecordBalance {
  kAuto,  ///< raw data get it; a curve of ours has its own
  kYes,   ///< the same, and says so where the record has its own
  kNo     ///< the record is published as it was read
};

/// Reads "auto", "true" or "false". Throws InvalidInput.
RecordBalance record_balance_named(const std::string& name);

/// The readings of a record, from their zero on where they get one. `tell` receives one line that says what was taken
/// for zero.
std::vector<CurveRow> record_with_zero(std::vector<CurveRow> rows, RecordBalance balance, const Tell& tell);

/// Publishes the record of an experiment beside the test that follows it: measured load and extension, each at the test
/// time at which the crosshead passes the reading.
class ExperimentNode {
 public:
  /// `rows`: the readings of the record. `tell`: see above.
  ExperimentNode(const ros::NodeHandle& node, std::vector<CurveRow> rows, RecordBalance balance, const Tell& tell);

  /// Runs until ROS is shut down. With `autostart` it starts the test as soon as it can receive every command of it.
  void spin(bool autostart);

 private:
  void try_to_start();
  void on_command(const Crosshead::ConstPtr& command);
  void publish(const CurveRow& row, const ros::Time& stamp);

  ros::NodeHandle node_;
  /// Time of the first reading, whether it is published or lies before the zero [s]. Declared before `rows_`, which
  /// takes the readings as it is made.
  double began_;
  std::vector<CurveRow> rows_;  ///< readings of the record, from the first that pulls to the last
  std::size_t next_ = 0;        ///< index of the next row to be published
  std::uint32_t run_ = 0;       ///< number of the test whose commands are followed
  std::uint64_t sequence_ = 0;  ///< sequence number of its latest command
  ros::Time begin_;  ///< beginning of the record: the stamp of the last command before the record is followed
  ros::Publisher load_cell_, crosshead_;
  ros::Subscriber commands_;
  ros::ServiceClient start_;
};

}  // namespace knot_utm
