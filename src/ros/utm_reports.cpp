// What the machine tells of itself: its status, the action's feedback and result, its health.
#include <limits>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/process.hpp"
#include "knot_utm/ros/utm_node.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {

void UtmNode::publish_status() {
  status_published_ = Clock::now();
  if (test_.waiting) measure_pace();  // also while knot_node stands still
  TestStatus status;
  status.header.stamp = now_;
  status.state = static_cast<std::uint8_t>(state_);
  status.run = run_;
  status.sequence = test_.command.sequence;
  status.time = test_.sample.time;
  status.phase = phase_name(program_ ? program_->phase() : Phase::kIdle);
  status.time_left = std::numeric_limits<double>::quiet_NaN();
  if (program_) {
    if (state_ == State::kEnded) {
      status.ended_by = ended_by_name(program_->ended_by());
      status.reason = program_->reason();
    }
    status.progress = program_->progress();
    if (test_.factor > 0.0) status.time_left = program_->time_left() / test_.factor;
  }
  status.real_time_factor = test_.factor;
  status_.publish(status);
  if (active()) report_to_goal(status);
}

void UtmNode::begin_pace() {
  test_.due = Clock::now();
  test_.older = test_.newer = {Clock::now(), test_.sample.time};
}

void UtmNode::measure_pace() {
  const double wall = seconds_since(test_.older.wall);
  if (wall > kStatusPeriod) test_.factor = (test_.sample.time - test_.older.time) / wall;
  if (seconds_since(test_.newer.wall) < kPaceWindow) return;
  test_.older = test_.newer;
  test_.newer = {Clock::now(), test_.sample.time};
}

void UtmNode::report_to_goal(const TestStatus& status) {
  if (!goal_) return;
  RunTestFeedback feedback;
  feedback.phase = status.phase;
  feedback.time = test_.sample.time;
  feedback.extension = test_.sample.extension;
  feedback.force = test_.sample.force_upper;
  feedback.load = test_.sample.load;
  feedback.knot_distance = test_.sample.knot_distance;
  feedback.motion_pattern = test_.motion_pattern;
  feedback.progress = status.progress;
  feedback.real_time_factor = status.real_time_factor;
  feedback.time_left = status.time_left;
  goal_->publishFeedback(feedback);
}

void UtmNode::finish_goal() {
  if (!goal_) return;
  const auto recorded = [this](const char* key) {
    return parse_number(result_of(folder_, key).value_or("")).value_or(Sample::kNone);
  };
  RunTestResult result;
  result.run = run_;
  result.ended_by = ended_by_name(program_->ended_by());
  result.reason = recorder_failed_ ? "the recorder failed" : program_->reason();
  result.motion_pattern = test_.motion_pattern;
  result.time = test_.sample.time;
  result.extension = test_.sample.extension;
  result.peak_force = recorded("peak_force");
  result.true_peak_force = recorded("true_peak_force");
  result.balance_offset = recorded("balance_offset");
  result.max_penetration = test_.max_penetration;
  result.directory = folder_;
  const std::string text = "ended by " + result.ended_by + (result.reason.empty() ? "" : ": " + result.reason);
  if (failed()) {
    goal_->setAborted(result, text);
  } else if (program_->ended_by() == EndedBy::kOperator) {
    goal_->setCanceled(result, text);
  } else {
    goal_->setSucceeded(result, text);
  }
  goal_.reset();
}

void UtmNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  constexpr double kKeepsPace = 0.9;  // of the pace asked for: below it the machine says so
  const double asked = options_.real_time_factor;
  const bool late = state_ == State::kRunning && asked > 0.0 && test_.factor < kKeepsPace * asked;
  if (recorder_failed_) {
    status.summary(DiagnosticStatus::ERROR, "the recorder failed");
  } else if (late) {
    status.summary(DiagnosticStatus::WARN,
                   "slower than asked for: a real-time factor of " + short_number(test_.factor));
  } else if (state_ == State::kEnded) {
    status.summary(program_->failed() ? DiagnosticStatus::ERROR : DiagnosticStatus::OK,
                   in_words({program_->ended_by(), program_->reason()}));
  } else {
    const char* states[] = {"idle", "running", "paused"};
    status.summary(DiagnosticStatus::OK, states[static_cast<int>(state_)]);
  }
  status.add("test", run_);
  status.add("phase", phase_name(program_ ? program_->phase() : Phase::kIdle));
  status.add("time [s]", test_.sample.time);
  status.add("real-time factor", test_.factor);
  status.add("real-time factor asked for", asked);
  status.add("commands", test_.command.sequence);
}

}  // namespace knot_utm
