// What the operator asks of the machine.
#include "knot_utm/ros/utm_node.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

using std::chrono::steady_clock;

bool refuse(std_srvs::Trigger::Response& response, const std::string& why) {
  response.success = 0;
  response.message = why;
  return true;
}

bool accept(std_srvs::Trigger::Response& response, const std::string& what) {
  response.success = 1;
  response.message = what;
  return true;
}

}  // namespace

bool UtmNode::on_start(StartTest::Request& request, StartTest::Response& response) {
  const std::string why_not = start(request);
  response.accepted = static_cast<std::uint8_t>(why_not.empty());
  response.message = why_not.empty() ? "test " + std::to_string(run_) + " is running" : why_not;
  if (why_not.empty()) response.folder = folder_;
  return true;
}

void UtmNode::on_goal(Actions::GoalHandle goal) {
  StartTest::Request request;
  request.method = goal.getGoal()->method;
  request.material = goal.getGoal()->material;
  request.preload = goal.getGoal()->preload;
  request.overrides = goal.getGoal()->overrides;
  const std::string why_not = start(request);
  if (!why_not.empty()) return goal.setRejected(RunTestResult(), why_not);
  goal_ = goal;
  goal_->setAccepted("the test is running");
}

void UtmNode::on_cancel(const Actions::GoalHandle& goal) {
  if (active() && goal_ && *goal_ == goal) program_->stop();
}

bool UtmNode::on_stop(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  if (!active()) return refuse(response, "no test is running");
  program_->stop();
  return accept(response, "the test ends");
}

bool UtmNode::on_balance(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  if (!active()) return refuse(response, "no test is running");
  program_->balance();
  return accept(response, "the load cell is balanced with the next command");
}

bool UtmNode::on_pause(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  if (!active()) return refuse(response, "no test is running");
  const bool goes_on = state_ == State::kPaused;
  pause(!goes_on);
  return accept(response, goes_on ? "the test goes on" : "the test is paused");
}

bool UtmNode::on_resume(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  if (state_ != State::kPaused) return refuse(response, "the test is not paused");
  pause(false);
  return accept(response, "the test goes on");
}

void UtmNode::pause(bool paused) {
  state_ = paused ? State::kPaused : State::kRunning;
  single_steps_ = 0;
  due_ = steady_clock::now();
  publish_status();
}

void UtmNode::set_pace(MachineConfig& wanted) {
  if (!(wanted.real_time_factor >= 0.0)) {  // not-a-number is none either
    ROS_WARN("utm_node: real_time_factor: %s is refused: 0 or more is allowed; it stays %s",
             format_number(wanted.real_time_factor).c_str(), format_number(options_.real_time_factor).c_str());
    wanted.real_time_factor = options_.real_time_factor;
  }
  options_.real_time_factor = wanted.real_time_factor;
  due_ = steady_clock::now();
}

bool UtmNode::on_step(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  if (state_ != State::kPaused) return refuse(response, "the test is not paused");
  ++single_steps_;
  return accept(response, "the test went on by one command");
}

}  // namespace knot_utm
