#pragma once

#include <actionlib/server/action_server.h>
#include <knot_utm/RunTestAction.h>
#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace knot_utm {

/// How a goal ends.
enum class GoalEnd { kSucceeded, kPreempted, kAborted };

/// The server of the action utm/run_test. A goal is one test, or a batch, from its start until its last file is
/// complete. The server itself starts nothing: the machine runs one test at a time, and stops it where the goal is
/// cancelled.
class RunTestServer {
 public:
  /// What a goal needs of the machine.
  struct Machine {
    /// Starts tests of `count` specimens (0: as many as the method says). Returns why it cannot; empty: the first runs.
    std::function<std::string(std::uint32_t count)> start;
    std::function<void()> stop;  ///< stops the test, as an operator does
  };

  RunTestServer(const ros::NodeHandle& node, Machine machine);

  bool has_goal() const { return goal_.has_value(); }

  /// Sends feedback to the client whose goal runs.
  void report(const RunTestFeedback& feedback);

  /// Ends the goal; its client gets `text` beside the result.
  void finish(GoalEnd end, const RunTestResult& result, const std::string& text);

 private:
  using Server = actionlib::ActionServer<RunTestAction>;

  void on_goal(Server::GoalHandle goal);
  void on_cancel(Server::GoalHandle goal);

  Machine machine_;
  std::optional<Server::GoalHandle> goal_;  ///< goal whose test runs or is still being recorded
  Server server_;
};

}  // namespace knot_utm
