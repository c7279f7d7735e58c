#pragma once

#include <knot_utm/KnotShape.h>
#include <knot_utm/TestStatus.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/show.hpp"

namespace knot_utm {

/// The bag that is replayed, and how.
struct ReplayOptions {
  std::string bag;           ///< a test.bag
  double rate = 1.0;         ///< test time over wall time; 0: as fast as possible
  std::string ended_by;      ///< how the test ended, as result.yaml names it; empty: not known
  bool exit_at_end = false;  ///< the launch ends at the end of the bag
  double patience = 5.0;     ///< longest wall time to wait for a viewer of the pictures before beginning [s]
};

/// Replays a recorded test without simulating it. It publishes the recorded messages on their topics, /clock, the
/// frames, and pictures for rviz made from the recorded shapes. The method only says what the machine looks like. The
/// replay begins when somebody views the pictures, or at the end of the waiting time.
class ReplayNode {
 public:
  /// Throws InvalidInput where the bag cannot be read, or contains no shapes or no states.
  ReplayNode(const ros::NodeHandle& node, const Method& method, const ReplayOptions& options);

  /// Runs until ROS is shut down or, with `exit_at_end`, until the bag has ended. Returns the exit code of the node.
  /// Throws InvalidInput where a message of the bag has another version.
  int spin();

 private:
  using Clock = std::chrono::steady_clock;

  void begin();
  void play_what_is_due();
  double until_due() const;  ///< wall time until the next message is due [s]
  void play(const rosbag::MessageInstance& instance);
  template <class Message>
  boost::shared_ptr<Message> replay(const rosbag::MessageInstance& instance);
  void publish_clock();
  void publish_end();
  void show(const KnotShape& shape);

  ros::NodeHandle node_;
  ReplayOptions options_;
  rosbag::Bag bag_;
  std::map<std::string, std::string> names_;  ///< topics of the bag, each with the package's own name of it
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator next_;
  TestingMachine machine_;  ///< in its state before the test
  Method tested_;
  Moment moment_;  ///< the last shape, and what was published with it
  Show show_;
  bool begun_ = false;
  ros::Time start_;  ///< time of the first message of the bag
  ros::Time now_;    ///< time of the last message that was published
  Clock::time_point begin_, clock_published_;
  TestStatus status_;  ///< the latest of the bag
  bool ended_ = false;
  std::uint32_t run_ = 1;  ///< number of the test in the bag
  Sample sample_;
  std::string motion_pattern_;

  std::map<std::string, ros::Publisher> publishers_;  ///< by the package's own names
  ros::Publisher method_, clock_;
};

}  // namespace knot_utm
