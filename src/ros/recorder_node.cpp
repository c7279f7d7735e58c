#include "knot_utm/ros/recorder_node.hpp"

#include <ros/callback_queue.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/knot_node.hpp"
#include "knot_utm/ros/master_parameters.hpp"
#include "knot_utm/ros/run_bag.hpp"
#include "knot_utm/run/claimed_folder.hpp"
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

RecorderNode::RecorderNode(const ros::NodeHandle& node, const std::string& out) : node_(node), diagnostics_(node) {
  order_.out = out;
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
  const std::uint32_t run = first.run;
  run_number_ = run;
  order_ = given_order(node_);
  test_id_ = id_of_test(run);
  std::string recorded;
  node_.getParam(names::kRecordedTest, recorded);
  completed_before_ = !test_id_.empty() && recorded == test_id_;
  completed_folder_ = completed_before_ ? told_folder(names::kFolderOfTest, test_id_) : "";
  begin_batch(id_of_test(run + 1 - static_cast<std::uint32_t>(order_.place.number)));
  if (!order_.place.alone()) take_up_specimen();
  if (completed_before_) return;
  const Method method = batch_ ? batch_->method_of(order_.place.number) : method_of(order_);
  const std::string before = told_folder(names::kFolderOfTest, test_id_);
  if (!before.empty() && fs::exists(samples_file(before))) return go_on(before);
  const std::string asked = batch_ ? batch_->folder_of(order_.place.number) : order_.out;
  if (batch_ && before.empty() && holds_run(asked))
    throw std::runtime_error(asked + " holds another run, which is not written over");
  // A folder that was named before is that of a recorder that died before it had recorded anything.
  ClaimedFolder claimed = before.empty() ? claim(asked, method) : ClaimedFolder(before);
  // Before anything is written, so that whoever follows finds it.
  if (!test_id_.empty()) tell_master(names::kFolderOfTest, test_id_ + " " + claimed.path());
  begin_run_folder(claimed.path(), method);
  run_ = std::make_unique<Run>(std::move(claimed), method);
  run_->samples.emplace(run_->folder);
}

/// What a recorder that died has left to do of a specimen whose result is complete.
void RecorderNode::take_up_specimen() {
  completed_folder_ = specimen_folder(batch_folder_, order_.place.number);
  if (!batch_) {
    completed_before_ = true;  // the whole batch is
  } else if (completed_before_ || has_complete_result(completed_folder_)) {
    completed_before_ = conclude_specimen();  // it may have died before its tables were written
  }
}

void RecorderNode::begin_batch(const std::string& id) {
  if (!order_.place.alone() && batch_ && batch_id_ == id) return;
  batch_.reset();
  batch_id_ = id;
  batch_folder_.clear();
  if (order_.place.alone()) return;
  const Method method = method_of(order_);
  const std::string before = told_folder(names::kFolderOfBatch, id);
  if (!before.empty()) {
    batch_folder_ = before;
    if (!is_complete_batch(before)) batch_.emplace(method, ClaimedFolder(before));
    return;
  }
  ClaimedFolder claimed = claim(order_.out, method);
  batch_folder_ = claimed.path();
  begin_run_folder(batch_folder_, method);
  batch_.emplace(method, std::move(claimed));
  if (!id.empty()) tell_master(names::kFolderOfBatch, id + " " + batch_folder_);
}

std::string RecorderNode::id_of_test(std::uint32_t run) const {
  std::string machine;
  return node_.getParam(names::kTestId, machine) ? machine + "/" + std::to_string(run) : "";
}

ClaimedFolder RecorderNode::claim(const std::string& asked, const Method& method) {
  require_no_record_in(asked, method);
  ClaimedFolder claimed = ClaimedFolder::first_free(asked);
  if (claimed.path() != asked) ROS_WARN("%s", moved_notice(asked, claimed.path()).c_str());
  return claimed;
}

std::string RecorderNode::told_folder(const char* parameter, const std::string& id) const {
  std::string told;
  node_.getParam(parameter, told);
  const std::string begin = id + " ";
  return !id.empty() && told.rfind(begin, 0) == 0 ? told.substr(begin.size()) : "";
}

void RecorderNode::go_on(const std::string& folder) {
  ClaimedFolder claimed(folder);
  run_ = std::make_unique<Run>(std::move(claimed), load_method((fs::path(folder) / "method.yaml").string()));
  SamplesReader reader(folder);
  Record record;
  while (reader.next(record)) keep(record);
  run_->samples.emplace(folder, reader);
  run_->dropped = run_->next - run_->recorded;
  run_->begin -= std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(record.wall_time));
  ROS_WARN("the recorder goes on with %s after %llu commands", folder.c_str(),
           static_cast<unsigned long long>(run_->recorded));
}

void RecorderNode::on_record(const KnotRecord::ConstPtr& record) {
  if (!error_.empty()) return;
  try {
    const Crosshead& command = record->command;
    if (command.run < run_number_) return;
    if (command.run > run_number_) begin_run(command);
    if (is_complete()) return;
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
  keep(kept);
  run_->stamp = record.command.header.stamp;
}

void RecorderNode::keep(const Record& record) {
  run_->full_rows += record.steps.size();
  if (cell_reading(record)) ++run_->rows;
  if (record.shape.cols() > 0) {
    run_->shape = record.shape;
    run_->shape_sequence = record.command.sequence;
  }
  run_->failed = record.answer.status == BenchStatus::kFailed;
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
  if (batch_ && test_.reason == kPhysicsDied) return interrupt(test_.reason);
  finish(ended_by_from_name(test_.ended_by), test_.reason, warning);
}

void RecorderNode::finish_early() {
  if (test_.state == TestStatus::ENDED && test_.run == run_number_) {
    const bool all = run_->next > test_.sequence;
    if (!all && batch_) return interrupt("the last records of the test never arrived");
    if (!all) miss_the_end();
    finish_as_told("");
  } else if (!master_answers()) {
    // Its launch then ends the nodes in any order: that of the machine may be gone before this one.
    cut_off("the ROS master died before the test had ended");
  } else if (machine_died_) {
    cut_off("utm_node died before the test had ended");
  } else {
    cut_off("ROS was shut down before the test had ended");
  }
}

void RecorderNode::cut_off(const std::string& why) {
  if (batch_) return interrupt(why);
  finish(EndedBy::kInterrupted, why, "");
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
    // Whoever begins anew from here on has nothing left to do.
    if (ros::ok() && !test_id_.empty()) tell_master(names::kRecordedTest, test_id_);
  } catch (const std::exception& error) {
    return fail(error.what());
  }
  if (run.dropped > 0)
    ROS_WARN("%llu commands of the test were not recorded", static_cast<unsigned long long>(run.dropped));
  ROS_INFO("%zu readings were written to %s", run.rows, run.folder.c_str());
  if (batch_ && !conclude_specimen()) return;
  if (!batch_) point_latest_to(run.folder);
  run.complete = true;
}

void RecorderNode::interrupt(const std::string& why) {
  try {
    // As an interrupted test without ROS: `tensile_test --resume` tests the specimen once more.
    write_results({EndedBy::kNotYet, kInterrupted}, why);
    run_->complete = true;
    ROS_WARN("%s: %s is left to be tested again", why.c_str(), order_.place.text().c_str());
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

bool RecorderNode::conclude_specimen() {
  try {
    if (batch_->conclude(order_.place.number)) {
      point_latest_to(batch_->folder());
      ROS_INFO("the statistics of all %d specimens were written to %s", order_.place.count,
               statistics_file(batch_->folder()).c_str());
    }
    return true;
  } catch (const std::exception& error) {
    error_ = error.what();  // what was measured is in the folder of the specimen
    ROS_ERROR("%s", error_.c_str());
    return false;
  }
}

void RecorderNode::tell_master(const char* parameter, const std::string& text) const {
  set_on_master(node_.resolveName(parameter), text);
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
  status.directory = order_.out;
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
  if (!run_ && completed_before_) status.directory = completed_folder_;
  status.batch = batch_folder_;
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
