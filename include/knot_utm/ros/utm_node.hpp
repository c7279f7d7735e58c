#pragma once

#include <actionlib/server/action_server.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotState.h>
#include <knot_utm/MachineConfig.h>
#include <knot_utm/MoveAction.h>
#include <knot_utm/RecorderStatus.h>
#include <knot_utm/RunTestAction.h>
#include <knot_utm/SpecimenInfo.h>
#include <knot_utm/StartTest.h>
#include <knot_utm/TestStatus.h>
#include <ros/ros.h>

#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/run/summary.hpp"

namespace knot_utm {

/// How the machine runs its tests.
struct UtmOptions {
  double real_time_factor = 1.0;  ///< test time over wall time; 0: as fast as possible
  bool autostart = true;          ///< starts a test as soon as there is a specimen
  bool record = false;            ///< begins no test before a recorder is connected, and ends with it
  bool exit_at_end = false;       ///< the launch ends when the test has ended and everything is recorded
  std::string verdict;            ///< file that `write_verdict` writes; empty: none
};

/// The machine as a node. It publishes the commands of the test program and receives the answers, one at a time. A
/// command for time t has the stamp t, and the next one is published when the answer with the same sequence number has
/// arrived. A test begins once all nodes are connected with each other; from then on no message is lost while the
/// connections last (their queues have no limit). If the connection to the simulation breaks, the simulation has died,
/// and the test ends as it does where the simulation gives up; if that of the recorder breaks, the test is stopped. A
/// slow simulation is waited for.
class UtmNode {
 public:
  static constexpr double kStatusPeriod = 0.2;  ///< wall time between two status messages [s]
  static constexpr double kPaceWindow = 2.0;    ///< wall time over which the pace is measured [s]

  /// `launched`: the setup of a test of which nothing else is asked.
  UtmNode(const ros::NodeHandle& node, const MethodSetup& launched, const UtmOptions& options);

  /// Runs until ROS is shut down. Ends the launch with `exit_at_end` when the test has ended, and where the simulation
  /// has died. Returns the exit code of the node: 1 where the simulation failed or died, or the recorder failed.
  int spin();

 private:
  using Clock = std::chrono::steady_clock;
  using Actions = actionlib::ActionServer<RunTestAction>;
  using Moves = actionlib::ActionServer<MoveAction>;
  enum class State { kIdle, kRunning, kPaused, kEnded };  ///< numbered as in TestStatus

  void on_specimen(const SpecimenInfo::ConstPtr& specimen);
  void on_state(const KnotState::ConstPtr& answer);
  void on_recorder(const RecorderStatus::ConstPtr& recorded);
  bool on_start(StartTest::Request& request, StartTest::Response& response);
  void offer_services();
  void on_goal(Actions::GoalHandle goal);
  void on_move(Moves::GoalHandle goal);
  void on_move_cancelled(const Moves::GoalHandle& goal);

  bool active() const { return state_ == State::kRunning || state_ == State::kPaused; }
  bool paused() const { return state_ == State::kPaused; }
  bool all_is_recorded() const { return !options_.record || test_.recorder_complete || recorder_failed_; }
  bool may_advance() const;
  std::string missing() const;  ///< what a test needs and is not there yet; empty: nothing
  /// Starts a test, for whoever asks: the launch, the service or the action. Returns why it cannot, in one line, and
  /// has then changed nothing; empty: the test runs.
  std::string start(const StartTest::Request& request);
  bool failed() const { return recorder_failed_ || test_.physics_died || (program_ && program_->failed()); }
  void pause(bool paused);
  void step();
  void begin_pace();
  void measure_pace();
  void advance();
  void send(const Command& command);
  void physics_died();
  void recorder_failed(const std::string& why);
  void end_launch_of_test();
  void end();
  ros::Time clock_now() const;
  void publish_clock(bool at_once);
  void publish_method(const Method& method);
  void publish_status();
  void report_to_goal(const TestStatus& status);
  void finish_goal();
  void report_to_move();
  void finish_move(EndedBy by);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void set_pace(MachineConfig& wanted);
  double wait_time() const;  ///< wall time until the next action that no message triggers [s]

  /// What is of one test alone.
  struct Test {
    Command command{};               ///< the last one
    Sample sample{};                 ///< the last answer
    bool waiting = false;            ///< whether the answer to `command` is still awaited
    std::string motion_pattern;      ///< motion pattern in the last answer
    double max_penetration = 0.0;    ///< largest overlap in all answers [fraction of radius]
    std::uint64_t single_steps = 0;  ///< number of single steps requested while paused
    bool physics_died = false;
    bool recorder_complete = false;
    Clock::time_point began = Clock::now();
    Clock::time_point due = Clock::now();  ///< time at which the next command may be sent
    struct {
      Clock::time_point wall = Clock::now();
      double time = 0.0;  ///< of the test [s]
    } older{}, newer{};   ///< answers, of which the older one is a pace window back or two, or where the test went on
    double factor = std::numeric_limits<double>::quiet_NaN();  ///< test time over wall time since the older one
  };

  ros::NodeHandle node_;
  TestWords launched_;
  UtmOptions options_;
  SpecimenInfo specimen_;                 ///< what the simulation last said of itself
  bool commands_arrive_ = false;          ///< knot_node is connected to utm/crosshead
  bool leaves_ = false;                   ///< the launch ends; no other test begins
  Method method_;                         ///< of this test
  std::optional<ProgramRunner> program_;  ///< program of this test
  State state_ = State::kIdle;
  std::uint32_t run_ = 0;
  Test test_;
  double run_start_ = 0.0;  ///< beginning of the test on /clock [s]
  bool recorder_failed_ = false;
  std::string folder_;  ///< of the recorder's files or, before it has said it, the one that it will make; empty: none
  ros::Time now_;       ///< time on /clock of the last answer
  Clock::time_point stands_since_ = Clock::now();  ///< since when no test runs

  ProgressLine progress_{stderr};  ///< on the terminal of the launch
  Clock::time_point clock_published_;
  Clock::time_point status_published_;
  Clock::time_point diagnosed_;

  ros::Publisher crosshead_, joint_states_, status_, method_text_, clock_;
  ros::Subscriber states_, specimens_, recorder_;
  ros::ServiceServer start_;
  std::vector<ros::ServiceServer> services_;
  std::optional<Actions::GoalHandle> goal_;  ///< its test runs, or is still being recorded
  Actions actions_;
  std::optional<Moves::GoalHandle> move_;  ///< the crosshead goes there, or will
  Moves moves_;
  diagnostic_updater::Updater diagnostics_;
  dynamic_reconfigure::Server<MachineConfig> pace_;
};

}  // namespace knot_utm
