#pragma once

#include <knot_utm/RecorderStatus.h>
#include <ros/ros.h>
#include <sys/types.h>

#include <map>
#include <optional>
#include <string>

namespace knot_utm {

/// Ends the launch when the test is over. roslaunch itself ends only where a node that is marked as required ends, and
/// reports that as a death, even after a success. This node asks roslaunch which nodes have ended:
/// - If the node that runs the test (utm_node or replay_node) has ended by itself, the test is over. The launch ends as
///   soon as nobody views the picture, that is, when rviz is closed where it was started.
/// - If another node has ended, or one was ended by a signal or by invalid input, the launch ends at once.
/// - If roslaunch itself was killed, the nodes of the test are shut down, because nobody else would do it.
/// The watched nodes are the names below the parameter test/exit_codes, where each node sets its exit code (run_node).
class WatchNode {
 public:
  /// `verdict`: a file to which the exit code of the test is written and, in a second line, the recorder's folder. The
  /// first line is empty until the test is over. Empty: none.
  WatchNode(const ros::NodeHandle& node, std::string verdict);

  /// Runs until ROS is shut down.
  int spin();

 private:
  /// The processes of the launch by the names of their nodes; true: it is alive.
  using Processes = std::map<std::string, bool>;

  bool find_launch();
  void on_recorder(const RecorderStatus::ConstPtr& status);
  std::optional<Processes> ask_launch() const;
  std::optional<int> exit_code(const std::string& node) const;
  void look(const Processes& processes);
  void test_is_over(int code, bool somebody_looks);
  void tell(std::optional<int> code) const;
  std::string told_folder() const;
  void tell_unfinished_batch() const;
  void end_launch();
  void end_nodes() const;

  ros::NodeHandle node_;
  std::string verdict_;
  std::string folder_;  ///< folder of the recorder; empty: nothing is recorded
  std::string batch_;   ///< folder of the batch; empty: the test stands alone
  std::string host_;    ///< host of roslaunch's own server
  int port_ = 0;
  pid_t launch_ = 0;                            ///< process of roslaunch
  std::map<std::string, std::string> watched_;  ///< node -> its parameter, both full names
  bool over_ = false;                           ///< whether the test is over
  bool ended_ = false;                          ///< whether roslaunch was asked to end
  ros::Subscriber recorder_;
};

}  // namespace knot_utm
