#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotState.h>
#include <knot_utm/MachineConfig.h>
#include <knot_utm/RecorderStatus.h>
#include <knot_utm/SpecimenInfo.h>
#include <knot_utm/TestStatus.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/io/method.hpp"
#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/run_test_server.hpp"

namespace knot_utm {

/// How the machine runs its test.
struct UtmOptions {
  double real_time_factor = 1.0;  ///< time of the test over wall time; 0: as fast as it goes
  bool autostart = true;          ///< starts as soon as a specimen is there
  bool record = false;            ///< never runs further ahead of the recorder than it can ask again for
  bool exit_at_end = false;       ///< `spin` returns when the test has ended and all is recorded
  double resend_period = 0.25;    ///< wall time after which what is not answered is asked again [s]
};

/// The machine as a node: gives the test program's commands and takes the answers, one at a time. A command for time t
/// has stamp t; the next one is given when the answer of the same sequence has come. Whatever is not answered (or, with
/// `record`, not recorded) is asked for again, so that nodes may join late and messages may be lost. A physics whose
/// connection breaks has died: that ends the test, as one that gave up does. One that is only slow is waited for.
class UtmNode {
 public:
  static constexpr double kStatusPeriod = 0.2;  ///< wall time between two statuses [s]
  /// Commands that may be ahead of the recorder. Half of what the physics keeps for asking again.
  static constexpr std::uint64_t kWindow = 128;

  UtmNode(const ros::NodeHandle& node, const Method& method, const UtmOptions& options);

  /// Runs until ROS is shut down, or the test has ended with `exit_at_end`. Returns the exit code of the node: 1 where
  /// the physics or the recorder failed.
  int spin();

 private:
  using Clock = std::chrono::steady_clock;
  enum class State { kIdle, kRunning, kPaused, kEnded };  ///< as numbered in TestStatus

  void on_specimen(const SpecimenInfo::ConstPtr& specimen);
  void on_state(const KnotState::ConstPtr& answer);
  void on_recorder(const RecorderStatus::ConstPtr& recorded);
  void on_gone(const ros::SingleSubscriberPublisher& subscriber);
  bool on_start(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_stop(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_balance(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_pause(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_resume(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_step(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  bool active() const { return state_ == State::kRunning || state_ == State::kPaused; }
  bool recorder_keeps_up() const;
  bool all_is_recorded() const;
  bool may_advance() const;
  std::string start_if_possible();  ///< returns why not; empty: the test runs
  void start();
  void pause(bool paused);
  void advance();
  void send(const Command& command);
  void resend();
  void take_reading();
  void physics_failed(const std::string& why);  ///< ends the test
  void end();
  void publish_clock(bool at_once);
  void publish_status();
  void report_to_goal(const TestStatus& status);
  void finish_goal();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void set_pace(MachineConfig& wanted);
  double wait_time() const;  ///< until there is something to do that no message brings [s]

  ros::NodeHandle node_;
  Method method_;
  UtmOptions options_;
  double longest_step_ = 0.0;             ///< [s]; 0: no specimen yet
  std::optional<ProgramRunner> program_;  ///< of this test
  State state_ = State::kIdle;
  std::uint32_t run_ = 0;
  double run_start_ = 0.0;            ///< on /clock [s]
  Command command_;                   ///< the last given
  Sample sample_;                     ///< the last answer
  std::string motion_pattern_;        ///< that it told
  std::vector<Sample> readings_;      ///< of the load cell in this test
  double max_penetration_ = 0.0;      ///< of all answers [fraction of radius]
  bool waiting_ = false;              ///< for the answer to `command_`
  std::uint64_t single_steps_ = 0;    ///< asked for while paused
  std::deque<Crosshead> unrecorded_;  ///< commands that the recorder has not acknowledged
  std::uint64_t recorded_ = 0;        ///< all before this sequence are
  bool recorder_complete_ = false;
  bool recorder_failed_ = false;
  std::string directory_;  ///< of the recorder's files
  ros::Time now_;          ///< what /clock says
  TopicWarning odd_specimen_{names::kSpecimen};

  Clock::time_point due_;   ///< when the next command may go
  Clock::time_point sent_;  ///< when something was last asked for, or asked again
  Clock::time_point clock_published_;
  Clock::time_point status_published_;
  Clock::time_point diagnosed_;
  Clock::time_point factor_measured_;
  double factor_time_ = 0.0;  ///< of the test when the factor was last measured [s]
  double factor_;             ///< test time over wall time of late

  ros::Publisher crosshead_, joint_states_, status_, method_text_, clock_;
  ros::Subscriber states_, specimens_, recorder_;
  ros::ServiceServer start_, stop_, balance_, pause_, resume_, step_;
  RunTestServer run_test_;
  diagnostic_updater::Updater diagnostics_;
  dynamic_reconfigure::Server<MachineConfig> pace_;
};

}  // namespace knot_utm
