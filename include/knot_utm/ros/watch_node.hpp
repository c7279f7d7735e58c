#pragma once

#include <knot_utm/RecorderStatus.h>
#include <ros/ros.h>
#include <sys/types.h>

#include <map>
#include <optional>
#include <string>

namespace knot_utm {

/// Ends the launch. roslaunch by itself does so only where a node that it calls required ends, and calls that a death,
/// even after a success. This node asks roslaunch which nodes have ended:
///   - the one that runs the test (utm_node or replay_node), by itself: the test is over. The launch ends as soon as
///     nobody looks at the picture any more, that is when rviz is closed, where there is one.
///   - another one, or by a signal, or because its input was wrong: the launch ends at once.
/// The nodes that it watches are the names in the parameter test/exit_codes, into which each of them puts its exit code
/// (run_node).
class WatchNode {
 public:
  /// `verdict`: a file for the exit code of the test and, in a second line, the recorder's folder; empty: none.
  WatchNode(const ros::NodeHandle& node, std::string verdict);

  /// Until ROS is shut down.
  int spin();

 private:
  /// Processes of the launch by the names of their nodes, true: alive.
  using Processes = std::map<std::string, bool>;

  bool find_launch();
  void on_recorder(const RecorderStatus::ConstPtr& status);
  std::optional<Processes> ask_launch() const;
  std::optional<int> exit_code(const std::string& node) const;
  void look(const Processes& processes);
  void test_is_over(int code, bool somebody_looks);
  void tell(int code) const;
  void end_launch();

  ros::NodeHandle node_;
  std::string verdict_;
  std::string folder_;  ///< of the recorder; empty: nothing is recorded
  std::string host_;    ///< of roslaunch's own server
  int port_ = 0;
  std::map<std::string, std::string> watched_;  ///< node -> its parameter, both full names
  bool over_ = false;                           ///< the test
  bool ended_ = false;                          ///< roslaunch was told so
  ros::Subscriber recorder_;
};

}  // namespace knot_utm
