#include "knot_utm/ros/run_test_server.hpp"

#include <utility>

#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

/// The status of goals is latched and published at every change of it. By itself the server would publish it by a
/// timer on /clock, which anybody may set, and which runs as fast as the test does.
const char* without_timer(const ros::NodeHandle& node) {
  node.setParam(std::string(names::kRunTest) + "/actionlib_status_frequency", 0.0);
  return names::kRunTest;
}

}  // namespace

RunTestServer::RunTestServer(const ros::NodeHandle& node, Machine machine)
    : machine_(std::move(machine)),
      server_(
          node, without_timer(node), [this](Server::GoalHandle goal) { on_goal(std::move(goal)); },
          [this](Server::GoalHandle goal) { on_cancel(std::move(goal)); }, false) {
  server_.start();
}

void RunTestServer::on_goal(Server::GoalHandle goal) {
  const std::string why_not = machine_.start(goal.getGoal()->count);
  if (!why_not.empty()) return goal.setRejected(RunTestResult(), why_not);
  goal_ = goal;
  goal_->setAccepted("the test is running");
}

void RunTestServer::on_cancel(Server::GoalHandle goal) {
  if (goal_ && *goal_ == goal) machine_.stop();
}

void RunTestServer::report(const RunTestFeedback& feedback) {
  if (goal_) goal_->publishFeedback(feedback);
}

void RunTestServer::finish(GoalEnd end, const RunTestResult& result, const std::string& text) {
  if (!goal_) return;
  switch (end) {
    case GoalEnd::kSucceeded:
      goal_->setSucceeded(result, text);
      break;
    case GoalEnd::kPreempted:
      goal_->setCanceled(result, text);
      break;
    case GoalEnd::kAborted:
      goal_->setAborted(result, text);
      break;
  }
  goal_.reset();
}

}  // namespace knot_utm
