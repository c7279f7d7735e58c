#pragma once

#include <actionlib/server/action_server.h>
#include <knot_utm/RunTestAction.h>
#include <ros/ros.h>

#include <functional>
#include <optional>
#include <string>

#include "knot_utm/machine/program_runner.hpp"

namespace knot_utm {

/// The action utm/run_test: a goal is one test, from its start until the last file is complete. It starts nothing by
/// itself: the machine does, which runs one test at a time, and stops it where the goal is cancelled.
class RunTestServer {
 public:
  /// What a goal asks of the machine.
  struct Machine {
    std::function<std::string()> start;  ///< a test; returns why not, empty: it runs
    std::function<void()> stop;          ///< as the operator does
  };

  RunTestServer(const ros::NodeHandle& node, Machine machine);

  bool has_goal() const { return goal_.has_value(); }

  /// To the client whose goal runs.
  void report(const RunTestFeedback& feedback);

  /// Ends the goal: aborted where the test `failed`, preempted where the operator ended it, whoever that was, else
  /// succeeded.
  void finish(EndedBy ended_by, bool failed, const RunTestResult& result);

 private:
  using Server = actionlib::ActionServer<RunTestAction>;

  void on_goal(Server::GoalHandle goal);
  void on_cancel(Server::GoalHandle goal);

  Machine machine_;
  std::optional<Server::GoalHandle> goal_;  ///< whose test runs, or is being recorded
  Server server_;
};

}  // namespace knot_utm
