#include "knot_utm/ros/utm_node.hpp"

#include <ros/callback_queue.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/launched.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/order_of_test.hpp"
#include "knot_utm/run/progress_line.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/study/batch.hpp"
#include "knot_utm/verdict/foreseen.hpp"
#include "wall_time.hpp"

namespace knot_utm {
namespace {

using Seconds = std::chrono::duration<double>;
using std::chrono::steady_clock;

constexpr double kDiagnosticsPeriod = 1.0;  // wall time [s]
constexpr double kCatchUp = 0.1;            // wall time that is made up for after a slow step [s]
constexpr double kLongestPause = 86400.0;   // between two commands, however slow the pace asked for [s]
constexpr double kLongestStart = 60.0;      // wall time after which a physics that nobody saw has died [s]
constexpr std::uint32_t kMachineQueue = 1000;

steady_clock::duration to_duration(double seconds) {
  return std::chrono::duration_cast<steady_clock::duration>(Seconds(seconds));
}

/// The status of goals is latched and published at every change of it. By itself the server would publish it by a
/// timer on /clock, which anybody may set, and which runs as fast as the test does.
const char* without_timer(const ros::NodeHandle& node) {
  node.setParam(std::string(names::kRunTest) + "/actionlib_status_frequency", 0.0);
  return names::kRunTest;
}

}  // namespace

UtmNode::UtmNode(const ros::NodeHandle& node, const MethodSetup& launched, const UtmOptions& options)
    : node_(node),
      launched_(launched),
      options_(options),
      progress_(std::make_unique<ProgressLine>(stderr)),
      factor_(std::numeric_limits<double>::quiet_NaN()),
      actions_(
          node, without_timer(node), [this](const Actions::GoalHandle& goal) { on_goal(goal); },
          [this](const Actions::GoalHandle& goal) { on_cancel(goal); }, false),
      diagnostics_(node) {
  const ros::SubscriberStatusCallback gone = [this](const ros::SingleSubscriberPublisher& s) { on_gone(s); };
  crosshead_ = node_.advertise<Crosshead>(names::kCrosshead, kMachineQueue, ros::SubscriberStatusCallback(), gone);
  joint_states_ = node_.advertise<sensor_msgs::JointState>(names::kJointStates, kMachineQueue);
  status_ = node_.advertise<TestStatus>(names::kTestStatus, 10, true);
  method_text_ = node_.advertise<std_msgs::String>(names::kMethod, 1, true);
  clock_ = node_.advertise<rosgraph_msgs::Clock>(names::kClock, 10);
  states_ = subscribe_gated(node_, names::kKnotState, names::kKnotNode, kMachineQueue, &UtmNode::on_state, this);
  specimens_ = subscribe_gated(node_, names::kSpecimen, names::kKnotNode, 1, &UtmNode::on_specimen, this);
  if (options_.record) {
    recorder_ = subscribe_gated(node_, names::kRecorderStatus, names::kRecorderNode, 10, &UtmNode::on_recorder, this);
  }
  stop_ = node_.advertiseService(names::kStopTest, &UtmNode::on_stop, this);
  balance_ = node_.advertiseService(names::kBalance, &UtmNode::on_balance, this);
  pause_ = node_.advertiseService(names::kPause, &UtmNode::on_pause, this);
  resume_ = node_.advertiseService(names::kResume, &UtmNode::on_resume, this);
  step_ = node_.advertiseService(names::kStep, &UtmNode::on_step, this);
  diagnostics_.add("machine", this, &UtmNode::diagnose);
  pace_.setCallback([this](MachineConfig& wanted, std::uint32_t) { set_pace(wanted); });
  // No other machine of this computer's life has both.
  node_.setParam(names::kTestId,
                 std::to_string(getpid()) + "-" + std::to_string(steady_clock::now().time_since_epoch().count()));
  publish_method(launched_.method);
  publish_status();
}

UtmNode::~UtmNode() = default;

int UtmNode::spin() {
  while (ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(wait_time()));
    if (options_.autostart && run_ == 0 && has_specimen_) {
      const std::string why_not = start_if_possible({});
      if (!why_not.empty()) throw std::runtime_error(why_not);
    }
    if (may_advance()) advance();
    if (seconds_since(sent_) > options_.resend_period) resend();
    if (seconds_since(clock_published_) > kIdleClockPeriod) publish_clock(true);
    if (seconds_since(status_published_) > kStatusPeriod && (active() || !all_is_recorded())) publish_status();
    if (seconds_since(looked_) > kStatusPeriod) look_after_physics();
    if (seconds_since(diagnosed_) > kDiagnosticsPeriod) {
      diagnosed_ = steady_clock::now();
      diagnostics_.force_update();
    }
    if (state_ == State::kEnded && all_is_recorded()) see_to_the_next();
    const bool over = !active() && (run_ == 0 || all_is_recorded());
    if (over && (physics_gone_ || (options_.exit_at_end && state_ == State::kEnded))) {
      end_launch_of_test();
      break;
    }
  }
  // ROS may be shut down by now.
  if (!batch_directory_.empty() && !is_complete_batch(batch_directory_))
    std::printf("not all specimens of the batch in %s were tested; test the others by: %s\n", batch_directory_.c_str(),
                command_to_resume(batch_directory_).c_str());
  std::fflush(stdout);
  return failed() ? 1 : 0;
}

void UtmNode::end_launch_of_test() {
  leaves_ = true;
  write_verdict(options_.verdict, failed() ? 1 : 0, folder());
  ros::WallDuration(kGoodbye).sleep();
  if (physics_died_ || physics_gone_) return end_launch();
  end_launch_when_rviz_is_closed();
}

/// That of the recorder; before it has said one, the one that it will make.
std::string UtmNode::folder() const {
  if (!batch_directory_.empty()) return batch_directory_;
  return directory_.empty() ? batch_.folder : directory_;
}

/// roslaunch does not end where the physics dies: the recorder is to hear first why the test has ended.
void UtmNode::look_after_physics() {
  looked_ = steady_clock::now();
  const std::set<std::string> nodes = nodes_of_launch();
  if (nodes.count(names::kKnotNode) > 0) {
    physics_seen_ = true;
  } else if (physics_seen_ || (!nodes.empty() && !has_specimen_ && seconds_since(began_) > kLongestStart)) {
    physics_gone_ = true;
    physics_lost();
  }
}

double UtmNode::wait_time() const {
  const bool to_be_paced = state_ == State::kRunning && !waiting_ && options_.real_time_factor > 0.0;
  const double until_due = to_be_paced ? Seconds(due_ - steady_clock::now()).count() : kIdleClockPeriod;
  return std::clamp(until_due, 0.0, 0.02);
}

void UtmNode::on_specimen(const SpecimenInfo::ConstPtr& specimen) {
  has_specimen_ = specimen->nodes > 0;
  if (!has_specimen_ || start_) return;
  // Not before: who waits for the service or the action, as ROS has it, may begin a test at once.
  start_ = node_.advertiseService(names::kStartTest, &UtmNode::on_start, this);
  actions_.start();
}

void UtmNode::on_gone(const ros::SingleSubscriberPublisher& subscriber) {
  if (subscriber.getSubscriberName() == node_.resolveName(names::kKnotNode)) physics_lost();
}

void UtmNode::physics_lost() {
  if (active() || (state_ == State::kEnded && another_follows())) physics_died_ = true;
  if (active()) physics_failed(kPhysicsDied);
}

void UtmNode::physics_failed(const std::string& why) {
  sample_.sequence = command_.sequence;
  sample_.status = BenchStatus::kFailed;
  sample_.message = why;
  program_->fail(why);
  // The last command that there will ever be an answer to.
  if (waiting_ && command_.sequence > 0) --command_.sequence;
  waiting_ = false;
  end();
}

void UtmNode::on_state(const KnotState::ConstPtr& answer) {
  const KnotState& state = *answer;
  if (!waiting_ || state.run != run_ || state.sequence != command_.sequence) return;  // an answer given twice
  sample_ = from_message(state);
  motion_pattern_ = state.motion_pattern;
  max_penetration_ = std::max(max_penetration_, sample_.max_penetration);
  waiting_ = false;
  progress_->show(sample_, *program_, seconds_since(run_began_));
  now_ = state.header.stamp;
  publish_clock(false);
  if (joint_states_.getNumSubscribers() > 0) joint_states_.publish(to_joint_state(command_, sample_, now_));
}

void UtmNode::on_recorder(const RecorderStatus::ConstPtr& recorded) {
  const RecorderStatus& status = *recorded;
  if (status.run != run_) return;
  if (status.next_sequence > recorded_) sent_ = steady_clock::now();
  recorded_ = std::max(recorded_, status.next_sequence);
  while (!unrecorded_.empty() && unrecorded_.front().sequence < recorded_) unrecorded_.pop_front();
  recorder_complete_ = status.complete != 0;
  directory_ = status.directory;
  batch_directory_ = status.batch;
  if (!status.error.empty()) {
    recorder_failed_ = true;
    if (active()) {
      ROS_ERROR("the recorder failed: %s", status.error.c_str());
      stop();
    }
  }
}

bool UtmNode::recorder_keeps_up() const {
  // Until the recorder has the first command it may not be connected; ROS would drop what is sent meanwhile.
  return !options_.record || recorder_failed_ || (recorded_ > 0 && command_.sequence < recorded_ + kWindow);
}

bool UtmNode::all_is_recorded() const { return !options_.record || recorder_complete_ || recorder_failed_; }

bool UtmNode::may_advance() const {
  if (!active() || waiting_) return false;
  if (program_->ended()) return true;
  if (!recorder_keeps_up()) return false;
  if (state_ == State::kPaused) return single_steps_ > 0;
  return options_.real_time_factor <= 0.0 || steady_clock::now() >= due_;
}

void UtmNode::advance() {
  const Command next = program_->next(sample_);
  if (program_->ended()) return end();
  if (state_ == State::kPaused) --single_steps_;
  if (options_.real_time_factor > 0.0) {
    const auto period = to_duration(std::min((next.time - command_.time) / options_.real_time_factor, kLongestPause));
    due_ = std::max(due_ + period, steady_clock::now() - to_duration(kCatchUp));
  }
  send(next);
}

void UtmNode::send(const Command& command) {
  command_ = command;
  waiting_ = true;
  sent_ = steady_clock::now();
  const Crosshead message = to_message(command, run_, test_stamp(run_start_, command.time));
  if (options_.record) unrecorded_.push_back(message);
  crosshead_.publish(message);
}

void UtmNode::resend() {
  sent_ = steady_clock::now();
  const bool recorder_lags = options_.record && !all_is_recorded() && !unrecorded_.empty();
  if (recorder_lags) {
    for (const Crosshead& message : unrecorded_) crosshead_.publish(message);
  } else if (waiting_) {
    crosshead_.publish(to_message(command_, run_, test_stamp(run_start_, command_.time)));
  }
}

void UtmNode::end() {
  state_ = State::kEnded;
  progress_->end();
  if (program_->reason().empty()) {
    ROS_INFO("the test ended by %s", ended_by_name(program_->ended_by()));
  } else {
    ROS_INFO("the test ended by %s: %s", ended_by_name(program_->ended_by()), program_->reason().c_str());
  }
  if (program_->ended_by() == EndedBy::kUntangled)
    ROS_WARN("the knot came undone: %s", what_keeps_a_knot(batch_.methods[batch_.specimen]).c_str());
  publish_clock(true);
  publish_status();
}

void UtmNode::publish_clock(bool at_once) {
  if (!at_once && seconds_since(clock_published_) < kClockPeriod) return;
  clock_published_ = steady_clock::now();
  rosgraph_msgs::Clock clock;
  clock.clock = std::max(now_, ros::TIME_MIN);
  clock_.publish(clock);
}

void UtmNode::publish_method(const Method& method) {
  diagnostics_.setHardwareIDf("%s", method.machine.load_cell.name.c_str());
  std_msgs::String text;
  text.data = method_file_text(method);
  method_text_.publish(text);
}

}  // namespace knot_utm
