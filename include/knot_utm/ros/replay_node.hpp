#pragma once

#include <knot_utm/KnotShape.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "knot_utm/io/method.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/frame_broadcaster.hpp"
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/ros/shown_state.hpp"
#include "knot_utm/ros/view_parameters.hpp"
#include "knot_utm/ros/views.hpp"

namespace knot_utm {

/// What is replayed, and how.
struct ReplayOptions {
  std::string bag;           ///< a test.bag
  double rate = 1.0;         ///< time of the test over wall time; 0: as fast as it goes
  bool exit_at_end = false;  ///< `spin` returns when the bag has ended
  double patience = 5.0;     ///< wall time for somebody to look at the pictures before it begins [s]
};

/// A recorded test, played without physics: its messages on their topics, /clock, frames and the pictures for rviz,
/// made of the recorded shapes. The method says only what the machine looks like. It begins when somebody looks at the
/// pictures, or after the patience is over.
class ReplayNode {
 public:
  /// Throws InvalidInput where the bag cannot be read, or has no shapes and states.
  ReplayNode(const ros::NodeHandle& node, const Method& method, const ReplayOptions& options);

  /// Runs until ROS is shut down, or the bag has ended with `exit_at_end`. Returns the exit code of the node. Throws
  /// InvalidInput where a message of the bag is of another version.
  int spin();

 private:
  using Clock = std::chrono::steady_clock;

  bool somebody_looks() const { return markers_.getNumSubscribers() > 0; }
  void begin();
  void play_what_is_due();
  double until_due() const;  ///< wall time until the next message is to be played [s]
  void play(const rosbag::MessageInstance& instance);
  template <class Message>
  boost::shared_ptr<Message> replay(const rosbag::MessageInstance& instance);
  void publish_clock();
  void on_view_timer(const ros::SteadyTimerEvent& event);
  void show(const KnotShape& shape);

  ros::NodeHandle node_;
  ReplayOptions options_;
  rosbag::Bag bag_;
  std::map<std::string, std::string> names_;  ///< of its topics, what we call them
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator next_;
  TestingMachine bench_;  ///< as it stands before the test
  FrameBroadcaster frames_;
  ScenePicture picture_;
  Views views_;
  ShownState shown_;
  bool begun_ = false;
  ros::Time start_;  ///< of the bag
  ros::Time now_;    ///< of what was played last
  Clock::time_point begin_, clock_published_;
  Sample sample_;
  std::string motion_pattern_;
  bool picture_is_old_ = false;
  std::uint32_t viewers_ = 0;

  std::map<std::string, ros::Publisher> publishers_;  ///< by our names
  ros::Publisher markers_, colors_, method_, clock_;
  ros::SteadyTimer view_timer_;
  ViewParameters parameters_;
};

}  // namespace knot_utm
