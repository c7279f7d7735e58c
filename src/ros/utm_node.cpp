#include "knot_utm/ros/utm_node.hpp"

#include <ros/callback_queue.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/process.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

using Seconds = std::chrono::duration<double>;
using std::chrono::steady_clock;

// How the machine publishes /clock and its health [s of the wall clock]
constexpr double kClockPeriod = 0.002;    // shortest time between two messages of the clock
constexpr double kIdleClockPeriod = 0.1;  // longest time between them
constexpr double kHealthPeriod = 1.0;
constexpr double kGoodbye = 0.3;  // for the last messages to leave before the node ends

constexpr double kLongestWait = 0.02;      // for messages, before the next look at what is due
constexpr double kCatchUp = 0.1;           // wall time that is made up for after a slow step [s]
constexpr double kLongestPause = 86400.0;  // between two commands, however slow the pace asked for [s]
constexpr double kGapBetweenTests = 1.0;   // on /clock [s]
constexpr std::uint32_t kJointStates = 1000;
constexpr char kNoTest[] = "no test is running", kNotPaused[] = "the test is not paused";

steady_clock::duration to_duration(double seconds) {
  return std::chrono::duration_cast<steady_clock::duration>(Seconds(seconds));
}

/// The status of goals is latched and published at every change of it. By itself the server would publish it by a
/// timer on /clock, which anybody may set, and which runs as fast as the test does.
const char* without_timer(const ros::NodeHandle& node, const char* action) {
  node.setParam(std::string(action) + "/actionlib_status_frequency", 0.0);
  return action;
}

constexpr char kUtmNodeHelp[] =
    R"(The machine: runs the test program against the physics of knot_node, one command at a time.
It is a part of: roslaunch knot_utm tighten.launch. It reads the test from the parameters test/..., which the launch
file sets (doc/ros.md).

  _real_time_factor:=NUMBER   simulated time over wall-clock time; 1: as on the bench; 0: as fast as possible [1]
  _autostart:=FLAG            starts the test when knot_node is there; false: utm/start_test starts it [true]
  _record:=FLAG               waits for recorder_node [false]
  _exit_at_end:=FLAG          ends when the test has ended, and the launch with it [false]
)";

constexpr int kInvalidInput = 2;

void require_pace(double factor, const std::string& text) {
  if (!(factor >= 0.0))  // not-a-number is none either
    throw InvalidInput("real_time_factor", text, "0 (as fast as possible) or more");
}

/// For launch/check, before there is a master: utm_node --check NAME:=VALUE..., with arguments of the launch file.
int check(int argc, char** argv) {
  std::map<std::string, std::string> given;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t end = word.find(":=");
    if (end != std::string::npos) given[word.substr(0, end)] = word.substr(end + 2);
  }
  try {
    const std::string factor = given["real_time_factor"];
    require_pace(parse_number(factor).value_or(-1.0), factor);
    set_up(read_words([&](const std::string& name) { return given[name]; }));
  } catch (const InvalidInput& invalid) {
    std::fprintf(stderr, "utm_node: %s\n", invalid.what());
    return kInvalidInput;
  }
  return 0;
}

}  // namespace

UtmNode::UtmNode(const ros::NodeHandle& node, const MethodSetup& launched, const UtmOptions& options)
    : node_(node),
      launched_(launched.words),
      options_(options),
      actions_(
          node, without_timer(node, names::kRunTest), [this](const Actions::GoalHandle& goal) { on_goal(goal); },
          [this](const Actions::GoalHandle& goal) {
            if (active() && goal_ && *goal_ == goal) program_->stop();
          },
          false),
      moves_(
          node, without_timer(node, names::kMove), [this](const Moves::GoalHandle& goal) { on_move(goal); },
          [this](const Moves::GoalHandle& goal) { on_move_cancelled(goal); }, false),
      diagnostics_(node) {
  crosshead_ = advertise_watched<Crosshead>(node_, names::kCrosshead, names::kKnotNode, [this](bool is_there) {
    commands_arrive_ = is_there;
    if (!is_there && active()) physics_died();
  });
  joint_states_ = node_.advertise<sensor_msgs::JointState>(names::kJointStates, kJointStates);
  status_ = node_.advertise<TestStatus>(names::kTestStatus, kNoLimit, true);
  method_text_ = node_.advertise<std_msgs::String>(names::kMethod, 1, true);
  clock_ = node_.advertise<rosgraph_msgs::Clock>(names::kClock, 10);
  states_ = subscribe_gated(node_, names::kKnotState, names::kKnotNode, &UtmNode::on_state, this);
  specimens_ = subscribe_gated(node_, names::kSpecimen, names::kKnotNode, &UtmNode::on_specimen, this);
  if (options_.record)
    recorder_ = subscribe_gated(node_, names::kRecorderStatus, names::kRecorderNode, &UtmNode::on_recorder, this);
  offer_services();
  diagnostics_.add("machine", this, &UtmNode::diagnose);
  pace_.setCallback([this](MachineConfig& wanted, std::uint32_t) { set_pace(wanted); });
  publish_method(launched.method);
  publish_status();
}

int UtmNode::spin() {
  while (ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(wait_time()));
    if (run_ == 0 && missing().empty()) {
      if (!start_) {  // not before: who waits for the service or the action, as ROS has it, may begin a test at once
        start_ = node_.advertiseService(names::kStartTest, &UtmNode::on_start, this);
        actions_.start();
        moves_.start();
      }
      if (options_.autostart) {
        const std::string why_not = start({});
        if (!why_not.empty()) throw std::runtime_error(why_not);
      }
    }
    if (may_advance()) advance();
    if (seconds_since(clock_published_) > kIdleClockPeriod) publish_clock(true);
    if (seconds_since(status_published_) > kStatusPeriod && active()) publish_status();
    if (seconds_since(diagnosed_) > kHealthPeriod) {
      diagnosed_ = steady_clock::now();
      diagnostics_.force_update();
    }
    if (state_ != State::kEnded || !all_is_recorded()) continue;
    finish_goal();
    if (test_.physics_died || options_.exit_at_end) {
      end_launch_of_test();
      break;
    }
  }
  return failed() ? 1 : 0;
}

void UtmNode::end_launch_of_test() {
  leaves_ = true;
  write_verdict(options_.verdict, failed() ? 1 : 0, folder_);
  ros::WallDuration(kGoodbye).sleep();
  if (test_.physics_died) return end_launch();
  end_launch_when_rviz_is_closed();
}

std::string UtmNode::missing() const {
  if (specimen_.nodes == 0) return "there is no specimen yet";
  // Who publishes alone knows for certain that what it says arrives; knot_node tells of its own topics.
  if (!commands_arrive_ || specimen_.answers_arrive == 0) return "knot_node is not connected yet";
  if (!options_.record) return "";
  if (recorder_failed_) return "the recorder failed";
  return specimen_.records_arrive == 0 ? "the recorder is not connected yet" : "";
}

std::string UtmNode::start(const StartTest::Request& request) {
  // What is told in the same breath as this request: the last goal gets the result of its own test.
  if (state_ == State::kEnded && all_is_recorded()) finish_goal();
  if (leaves_) return "the launch is about to end";
  if (active()) return "a test is running";
  if (std::string what = missing(); !what.empty()) return what;
  if (run_ > 0 && !all_is_recorded()) return "the last test is still being recorded";
  try {
    const MethodSetup setup = set_up(asked_for(launched_, request));
    const Method& method = setup.method;
    // The same on both sides: the physics makes its steps by the same method.
    const double longest_step = tolerances(method.physics, method.specimen, method.material).longest_step;
    ProgramRunner program = make_program(method, longest_step);
    if (options_.record) require_no_record_in(setup.out, method);
    const std::string folder = options_.record ? free_folder(setup.out) : "";
    if (!give_order(node_, {method, setup.out, setup.beside})) return "the ROS master does not answer";
    for (const std::string& line : setup.notices) ROS_INFO("%s", line.c_str());
    folder_ = folder;
    method_ = method;
    program_.emplace(std::move(program));
  } catch (const InvalidInput& invalid) {
    return invalid.what();
  }
  publish_method(method_);
  now_ = clock_now();
  if (now_ > ros::TIME_MIN) run_start_ = now_.toSec() + kGapBetweenTests;
  ++run_;
  test_ = Test();
  state_ = State::kRunning;
  write_verdict(options_.verdict, std::nullopt, folder_);
  send(program_->last());
  publish_status();
  return "";
}

double UtmNode::wait_time() const {
  const bool to_be_paced = state_ == State::kRunning && !test_.waiting && options_.real_time_factor > 0.0;
  const double until_due = to_be_paced ? Seconds(test_.due - steady_clock::now()).count() : kIdleClockPeriod;
  return std::clamp(until_due, 0.0, kLongestWait);
}

void UtmNode::on_specimen(const SpecimenInfo::ConstPtr& specimen) {
  specimen_ = *specimen;
  if (active() && specimen_.answers_arrive == 0) physics_died();
  if (run_ > 0 && !all_is_recorded() && specimen_.records_arrive == 0)
    recorder_failed("its connection to knot_node broke");
}

void UtmNode::physics_died() {
  test_.physics_died = true;
  test_.sample.sequence = test_.command.sequence;
  test_.sample.status = BenchStatus::kFailed;
  test_.sample.message = kPhysicsDied;
  program_->fail(kPhysicsDied);
  // The last command that there will ever be an answer to.
  if (test_.waiting && test_.command.sequence > 0) --test_.command.sequence;
  test_.waiting = false;
  end();
}

void UtmNode::on_state(const KnotState::ConstPtr& answer) {
  const KnotState& state = *answer;
  if (!test_.waiting || state.run != run_ || state.sequence != test_.command.sequence)
    return;  // of a test that has ended
  test_.sample = from_message(state);
  test_.motion_pattern = state.motion_pattern;
  test_.max_penetration = std::max(test_.max_penetration, test_.sample.max_penetration);
  test_.waiting = false;
  measure_pace();
  progress_.show(test_.sample, *program_, seconds_since(test_.began));
  now_ = state.header.stamp;
  publish_clock(false);
  report_to_move();
  if (joint_states_.getNumSubscribers() > 0) joint_states_.publish(to_joint_state(test_.command, test_.sample, now_));
}

void UtmNode::on_recorder(const RecorderStatus::ConstPtr& recorded) {
  const RecorderStatus& status = *recorded;
  if (status.run != run_) return;
  test_.recorder_complete = status.complete != 0;
  folder_ = status.directory;
  if (!status.error.empty()) recorder_failed(status.error);
}

void UtmNode::recorder_failed(const std::string& why) {
  if (recorder_failed_) return;
  recorder_failed_ = true;
  if (!active()) return;
  ROS_ERROR("the recorder failed: %s", why.c_str());
  program_->stop();
}

bool UtmNode::may_advance() const {
  if (!active() || test_.waiting || program_->waits()) return false;
  if (program_->ended()) return true;
  if (state_ == State::kPaused) return test_.single_steps > 0;
  return options_.real_time_factor <= 0.0 || steady_clock::now() >= test_.due;
}

void UtmNode::advance() {
  const Command next = program_->next(test_.sample);
  if (program_->ended()) return end();
  if (program_->waits()) return finish_move(program_->led_by());
  if (state_ == State::kPaused) --test_.single_steps;
  if (options_.real_time_factor > 0.0) {
    const auto period =
        to_duration(std::min((next.time - test_.command.time) / options_.real_time_factor, kLongestPause));
    test_.due = std::max(test_.due + period, steady_clock::now() - to_duration(kCatchUp));
  }
  send(next);
}

void UtmNode::send(const Command& command) {
  test_.command = command;
  test_.waiting = true;
  crosshead_.publish(to_message(command, run_, test_stamp(run_start_, command.time)));
}

void UtmNode::end() {
  state_ = State::kEnded;
  stands_since_ = steady_clock::now();
  finish_move(program_->ended_by());
  progress_.end();
  ROS_INFO("%s", in_words({program_->ended_by(), program_->reason()}).c_str());
  if (program_->ended_by() == EndedBy::kUntangled)
    ROS_WARN("the knot came undone: %s", what_keeps_a_knot(method_).c_str());
  publish_clock(true);
  publish_status();
}

/// While nothing is tested the clock goes on with the wall, so that who sleeps by it wakes up.
ros::Time UtmNode::clock_now() const {
  const bool stands = active() ? program_->waits() : run_ > 0 || !options_.autostart;
  return std::max(now_ + ros::Duration(stands ? seconds_since(stands_since_) : 0.0), ros::TIME_MIN);
}

void UtmNode::publish_clock(bool at_once) {
  if (!at_once && seconds_since(clock_published_) < kClockPeriod) return;
  clock_published_ = steady_clock::now();
  rosgraph_msgs::Clock clock;
  clock.clock = clock_now();
  clock_.publish(clock);
}

void UtmNode::publish_method(const Method& method) {
  diagnostics_.setHardwareIDf("%s", method.machine.load_cell.name.c_str());
  std_msgs::String text;
  text.data = method_file_text(method);
  method_text_.publish(text);
}

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
  serve(names::kPause, &UtmNode::active, kNoTest, "the test is paused", [this] { pause(true); });
  services_.push_back(offer(node_, names::kStep, [this](std::string& said) {
    const bool allowed = paused();
    if (allowed) step();
    said = allowed ? "the test went on by one command, to " + format_number(test_.sample.time) + " s" : kNotPaused;
    return allowed;
  }));
}

void UtmNode::pause(bool paused) {
  state_ = paused ? State::kPaused : State::kRunning;
  test_.single_steps = 0;
  begin_pace();
  publish_status();
}

/// Returns once the physics has answered, which is also how the call ends.
void UtmNode::step() {
  ++test_.single_steps;
  while (ros::ok() && paused() && (test_.waiting || may_advance())) {
    if (may_advance()) advance();
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLongestWait));
  }
}

void UtmNode::set_pace(MachineConfig& wanted) {
  if (!(wanted.real_time_factor >= 0.0)) {  // not-a-number is none either
    ROS_WARN("utm_node: real_time_factor: %s is refused: 0 or more is allowed; it stays %s",
             format_number(wanted.real_time_factor).c_str(), format_number(options_.real_time_factor).c_str());
    wanted.real_time_factor = options_.real_time_factor;
  }
  options_.real_time_factor = wanted.real_time_factor;
  begin_pace();
}

int run_utm_node(int argc, char** argv) {
  if (argc > 1 && argv[1] == std::string("--check")) return check(argc, argv);
  UtmOptions options;
  std::string sim_time_found;
  const int code = run_node(argc, argv, names::kUtmNode, kUtmNodeHelp, [&] {
    const ros::NodeHandle node = join_ros(argc, argv, names::kUtmNode);
    read_parameter(node, names::kSimTimeFound, &sim_time_found, "a text");
    const ros::NodeHandle own("~");
    read_parameter(own, "verdict", &options.verdict, "a file");
    read_parameter(own, "real_time_factor", &options.real_time_factor, "a number, 0 or more");
    read_parameter(own, "autostart", &options.autostart, "true or false");
    read_parameter(own, "record", &options.record, "true or false");
    read_parameter(own, "exit_at_end", &options.exit_at_end, "true or false");
    require_pace(options.real_time_factor, std::to_string(options.real_time_factor));
    return UtmNode(node, read_test_setup(node), options).spin();
  });
  put_back_sim_time(sim_time_found);
  if (code == kInvalidInput) write_verdict(options.verdict, code, "");
  return code;
}

}  // namespace knot_utm
