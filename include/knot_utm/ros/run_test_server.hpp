#pragma once

#include <actionlib/server/action_server.h>
#include <knot_utm/RunTestAction.h>
#include <ros/ros.h>

#include <functional>
#include <optional>
#include <string>

#include "knot_utm/machine/program_runner.hpp"

namespace knot_utm {

/// The server of the action utm/run_test. A goal is one test, from its start until its last file is complete. The
/// server itself starts nothing: the machine runs one test at a time, and stops it where the goal is cancelled.
class RunTestServer {
 public:
  /// What a goal needs of the machine.
  struct Machine {
    std::function<std::string()> start;  ///< starts a test; returns why it cannot, empty: it runs
    std::function<void()> stop;          ///< stops the test, as an operator does
  };

  RunTestServer(const ros::NodeHandle& node, Machine machine);

  bool has_goal() const { return goal_.has_value(); }

  /// Sends feedback to the client whose goal runs.
  void report(const RunTestFeedback& feedback);

  /// Ends the goal. Its state is aborted where the test `failed`, preempted where the test was stopped by an operator
  /// or by cancelling, and succeeded otherwise.
  void finish(EndedBy ended_by, bool failed, const RunTestResult& result);

 private:
  using Server = actionlib::ActionServer<RunTestAction>;

  void on_goal(Server::GoalHandle goal);
  void on_cancel(Server::GoalHandle goal);

  Machine machine_;
  std::optional<Server::GoalHandle> goal_;  ///< goal whose test runs or is still being recorded
  Server server_;
};

}  // namespace knot_utm
