#include "knot_utm/ros/recorder_node.hpp"

#include <ros/callback_queue.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "knot_utm/ros/ask_master.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/knot_node.hpp"
#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/run_bag.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/run_writer.hpp"
#include "wall_time.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kAnswerQueue = 4 * KnotNode::kKeptAnswers;
constexpr double kLastRecords = 1.0;             // wall time for what is under way once the machine died [s]
constexpr double kPatience = 2.0;                // wall time to wait for a record that is missing [s]
constexpr double kPatienceAtEnd = 10.0;          // the same for the final shape [s]
constexpr double kAcknowledgePeriod = 0.005;     // wall time between acknowledgements [s]
constexpr double kDiagnosticsPeriod = 1.0;       // wall time [s]
constexpr double kLongestPause = 0.1;            // between two looks that counts as waiting [s]
constexpr std::uint64_t kAcknowledgeAfter = 16;  // records, where they come faster

EndedBy ended_by_from_name(const std::string& name) { return ended_by_named(name).value_or(EndedBy::kNotYet); }

}  // namespace

RecorderNode::Run::Run(ClaimedFolder claimed_, const Method& method_)
    : claimed(std::move(claimed_)), folder(claimed.path()), method(method_) {}

RecorderNode::RecorderNode(const ros::NodeHandle& node) : node_(node), diagnostics_(node) {
  const ros::SubscriberStatusCallback come = [this](const ros::SingleSubscriberPublisher& s) { on_come(s); };
  const ros::SubscriberStatusCallback gone = [this](const ros::SingleSubscriberPublisher& s) { on_gone(s); };
  status_ = node_.advertise<RecorderStatus>(names::kRecorderStatus, 100, come, gone, ros::VoidConstPtr(), true);
  save_ = node_.advertiseService(names::kSave, &RecorderNode::on_save, this);
  records_ = subscribe_gated(node_, names::kKnotRecord, names::kKnotNode, kAnswerQueue, &RecorderNode::on_record, this);
  test_status_ = subscribe_gated(node_, names::kTestStatus, names::kUtmNode, 10, &RecorderNode::on_status, this);
  diagnostics_.setHardwareID("none");
  diagnostics_.add("files", this, &RecorderNode::diagnose);
  publish_status();
}

int RecorderNode::spin() {
  while (ros::ok()) {
    wait_for_messages();
    if (run_ && !run_->complete && error_.empty()) {
      give_up_gap();
      finish_when_ready();
      if (machine_died_ && waited_ - *machine_died_ > kLastRecords && !run_->complete) finish_early();
    }
    const std::uint64_t next = run_ ? run_->next : 0;
    const bool news = next != published_.next_sequence || run_number_ != published_.run ||
                      is_complete() != (published_.complete != 0) || error_ != published_.error;
    if (news && (seconds_since(published_at_) > kAcknowledgePeriod)) publish_status();
    if (seconds_since(diagnosed_) > kDiagnosticsPeriod) {
      diagnosed_ = Clock::now();
      diagnostics_.force_update();
    }
  }
  if (run_ && !run_->complete && error_.empty()) finish_early();
  return error_.empty() ? 0 : 1;
}

void RecorderNode::wait_for_messages() {
  const Clock::time_point begin = Clock::now();
  ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kAcknowledgePeriod));
  // A process that is stopped, or swapped out, does not wait: what came meanwhile it has not seen yet.
  waited_ += std::min(seconds_since(begin), kLongestPause);
}

void RecorderNode::on_come(const ros::SingleSubscriberPublisher& subscriber) {
  if (subscriber.getSubscriberName() != node_.resolveName(names::kUtmNode)) return;
  ++machines_;
  machine_died_.reset();  // the connection was lost, and not the machine
}

void RecorderNode::on_gone(const ros::SingleSubscriberPublisher& subscriber) {
  if (subscriber.getSubscriberName() == node_.resolveName(names::kUtmNode) && --machines_ == 0) machine_died_ = waited_;
}

void RecorderNode::begin_run(const Crosshead& first) {
  if (run_ && !run_->complete) {
    finish(EndedBy::kOperator, "another test was started", "");
  }
  run_.reset();
  run_number_ = first.run;
  const TestOrder order = given_order(node_);
  const Method method = method_of(order);
  require_no_record_in(order.out, method);
  ClaimedFolder claimed = ClaimedFolder::first_free(order.out);
  if (claimed.path() != order.out) ROS_WARN("%s", moved_notice(order.out, claimed.path()).c_str());
  begin_run_folder(claimed.path(), method);
  run_ = std::make_unique<Run>(std::move(claimed), method);
  run_->samples.emplace(run_->folder);
}

void RecorderNode::on_record(const KnotRecord::ConstPtr& record) {
  if (!error_.empty()) return;
  try {
    const Crosshead& command = record->command;
    if (command.run < run_number_) return;
    if (command.run > run_number_) begin_run(command);
    if (!run_ || run_->complete) return;
    Run& run = *run_;
    if (!record->shape.points.empty() && command.sequence >= run.shape_sequence) {
      run.shape = points_from_message(record->shape);
      run.shape_sequence = command.sequence;
    }
    if (command.sequence == run.next) {
      write(*record);
      write_early();
    } else if (command.sequence > run.next) {
      // Only what is new is progress: as long as something is missing, all behind it is asked for again and again.
      if (run.early.emplace(command.sequence, record).second) run.progress = waited_;
      if (run.early.size() > KnotNode::kKeptAnswers) give_up_gap();
    }
    if (run.next >= published_.next_sequence + kAcknowledgeAfter) publish_status();
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

void RecorderNode::write(const KnotRecord& record) {
  Record kept = from_message(record);
  kept.wall_time = seconds_since(run_->begin);
  run_->samples->append(kept);
  run_->stamp = record.command.header.stamp;
  run_->full_rows += kept.steps.size();
  if (cell_reading(kept)) ++run_->rows;
  run_->failed = kept.answer.status == BenchStatus::kFailed;
  ++run_->recorded;
  run_->next = record.command.sequence + 1;
  run_->progress = waited_;
}

void RecorderNode::write_early() {
  auto& early = run_->early;
  while (!early.empty() && early.begin()->first <= run_->next) {
    if (early.begin()->first == run_->next) write(*early.begin()->second);
    early.erase(early.begin());
  }
}

void RecorderNode::give_up_gap() {
  Run& run = *run_;
  if (run.early.empty()) return;
  if (waited_ - run.progress < kPatience && run.early.size() <= KnotNode::kKeptAnswers) return;
  run.dropped += run.early.begin()->first - run.next;
  ROS_WARN("%llu commands of the test never arrived",
           static_cast<unsigned long long>(run.early.begin()->first - run.next));
  run.next = run.early.begin()->first;
  try {
    write_early();
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

void RecorderNode::on_status(const TestStatus::ConstPtr& status) {
  // A machine that was paused has its end long after its last record.
  if (run_ && status->state == TestStatus::ENDED && test_.state != TestStatus::ENDED) run_->progress = waited_;
  test_ = *status;
}

void RecorderNode::finish_when_ready() {
  if (test_.state != TestStatus::ENDED || test_.run != run_number_) return;
  const bool all = run_->next > test_.sequence;
  const bool shape = run_->shape.cols() > 0 && run_->shape_sequence == test_.sequence;
  // A physics that has failed may not have the specimen any more, and one that has died answers nothing.
  if (all && (shape || run_->failed || test_.reason == kPhysicsDied)) {
    finish_as_told("");
  } else if (waited_ - run_->progress > kPatienceAtEnd) {
    if (!all) miss_the_end();
    finish_as_told("the physics did not answer at the end of the test");
  }
}

void RecorderNode::miss_the_end() {
  run_->missing_at_end = test_.sequence + 1 - run_->next;
  run_->dropped += run_->missing_at_end;
}

void RecorderNode::finish_as_told(const std::string& warning) {
  finish(ended_by_from_name(test_.ended_by), test_.reason, warning);
}

void RecorderNode::finish_early() {
  if (test_.state == TestStatus::ENDED && test_.run == run_number_) {
    if (run_->next <= test_.sequence) miss_the_end();
    return finish_as_told("");
  }
  // Of a master that died its launch ends the nodes in any order: that of the machine may be gone before this one.
  const char* who = !ask_master("getPid") ? "the ROS master died"
                    : machine_died_       ? "utm_node died"
                                          : "ROS was shut down";
  finish(EndedBy::kInterrupted, std::string(who) + " before the test had ended", "");
}

void RecorderNode::write_results(const TestEnd& end, const std::string& warning) {
  run_->samples->end(end, run_->shape);
  ResultsOptions options;
  if (!warning.empty()) options.warnings.push_back(warning);
  options.missing_at_end = run_->missing_at_end;
  make_files("test.bag", options);
}

void RecorderNode::make_files(const std::string& bag_name, ResultsOptions options) {
  Run& run = *run_;
  std::unique_ptr<RunBag> bag;
  options.further = [&](const std::string& folder, const Method& method) {
    bag = std::make_unique<RunBag>((fs::path(folder) / bag_name).string(), method);
    return FurtherWriter{[&](const Record& record) { bag->add(record); }, [&] { bag->close(); }};
  };
  const MadeResults made = make_results(run.folder, run.method, options);
  run.rows = made.rows;
  run.full_rows = made.full_rows;
  run.bag_messages = bag->messages();
}

void RecorderNode::finish(EndedBy ended_by, const std::string& reason, const std::string& warning) {
  Run& run = *run_;
  try {
    write_results({ended_by, reason}, warning);
  } catch (const std::exception& error) {
    return fail(error.what());
  }
  if (run.dropped > 0)
    ROS_WARN("%llu commands of the test were not recorded", static_cast<unsigned long long>(run.dropped));
  ROS_INFO("%zu readings were written to %s", run.rows, run.folder.c_str());
  point_latest_to(run.folder);
  run.complete = true;
}

void RecorderNode::fail(const std::string& why) {
  error_ = why;
  if (run_) error_ += what_stands(run_->folder);
  ROS_ERROR("%s", error_.c_str());
}

bool RecorderNode::on_save(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  response.success = 0;
  if (!run_) {
    response.message = "there is nothing to save yet";
    return true;
  }
  if (!run_->complete && error_.empty()) {
    try {
      ResultsOptions options;
      options.without_end.reason = "saved while the test was running";
      make_files("saved.bag", options);
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }
  response.success = static_cast<std::uint8_t>(error_.empty());
  response.message = error_.empty() ? "saved to " + run_->folder : error_;
  return true;
}

void RecorderNode::publish_status() {
  RecorderStatus status;
  status.run = run_number_;
  status.error = error_;
  status.complete = static_cast<std::uint8_t>(is_complete());
  if (run_) {
    status.header.stamp = run_->stamp;
    status.recorded = run_->recorded;
    status.dropped = run_->dropped;
    status.next_sequence = run_->next;
    status.curve_rows = run_->rows;
    status.full_rows = run_->full_rows;
    status.bag_messages = run_->bag_messages;
    status.directory = run_->folder;
  }
  published_ = status;
  published_at_ = Clock::now();
  status_.publish(status);
}

void RecorderNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!error_.empty()) {
    status.summary(DiagnosticStatus::ERROR, error_);
  } else if (run_ && run_->dropped > 0) {
    status.summary(DiagnosticStatus::WARN, std::to_string(run_->dropped) + " commands of the test never arrived");
  } else if (is_complete()) {
    status.summary(DiagnosticStatus::OK, "complete");
  } else {
    status.summary(DiagnosticStatus::OK, run_ ? "recording" : "nothing to record yet");
  }
  if (!run_) return;
  status.add("folder", run_->folder);
  status.add("commands recorded", run_->recorded);
  status.add("commands dropped", run_->dropped);
  status.add("rows", run_->rows);
  status.add("rows of time steps", run_->full_rows);
  status.add("messages in the bag", run_->bag_messages);
}

}  // namespace knot_utm
