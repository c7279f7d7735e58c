// What the operator asks of the machine.
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/utm_node.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

using std::chrono::steady_clock;

constexpr char kNoTest[] = "no test is running", kNotPaused[] = "the test is not paused";

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

void UtmNode::offer_services() {
  const auto serve = [this](const char* name, bool (UtmNode::*may)() const, const char* why_not, const char* done,
                            const std::function<void()>& act) {
    services_.push_back(offer(node_, name, [=](std::string& said) {
      const bool allowed = (this->*may)();
      said = allowed ? done : why_not;
      if (allowed) act();
      return allowed;
    }));
  };
  serve(names::kStopTest, &UtmNode::active, kNoTest, "the test ends", [this] { program_->stop(); });
  serve(names::kBalance, &UtmNode::active, kNoTest, "the load cell is balanced with the next command",
        [this] { program_->balance(); });
  serve(names::kResume, &UtmNode::paused, kNotPaused, "the test goes on", [this] { pause(false); });
  serve(names::kStep, &UtmNode::paused, kNotPaused, "the test went on by one command", [this] { ++single_steps_; });
  services_.push_back(offer(node_, names::kPause, [this](std::string& said) {
    const bool goes_on = paused();
    said = !active() ? kNoTest : goes_on ? "the test goes on" : "the test is paused";
    if (active()) pause(!goes_on);
    return active();
  }));
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

}  // namespace knot_utm
