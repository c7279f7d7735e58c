// What is measured goes to the disk.
#include <diagnostic_updater/diagnostic_updater.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/RecorderStatus.h>
#include <knot_utm/TestStatus.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/process.hpp"
#include "knot_utm/ros/run_bag.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/run_writer.hpp"

namespace knot_utm {
namespace {

constexpr double kLastRecords = 1.0;   // wall time for what is under way once a node died [s]
constexpr double kLookPeriod = 0.1;    // longest wall time between two looks at what is due [s]
constexpr double kStatusPeriod = 1.0;  // wall time between two messages of the recorder's status [s]

constexpr char kRecorderHelp[] = R"(Writes what a test measures: curve, result and bag.
It is a part of: roslaunch knot_utm tighten.launch. What is tested, and where it goes, utm_node says (doc/ros.md).
)";

/// Writes every command and its answer as they arrive, with the same code as tests without ROS. A gap between them is
/// an error, which ends the test. A test goes to the given folder or, where that holds a run, to the first free one
/// beside it with the suffix "-2", "-3" and so on. The service recorder/save writes the results as of now, and
/// saved.bag, the bag so far.
///
/// A record goes to samples.csv at once, from which all other files are made at the end of the test. Of a recorder that
/// dies `tensile_test --from-samples` makes them.
class RecorderNode {
 public:
  explicit RecorderNode(const ros::NodeHandle& node) : node_(node), diagnostics_(node) {
    const auto machine_is_there = [this](bool is_there) {
      if (!is_there) died_at_ = Clock::now();
      machine_died_ = !is_there;
    };
    status_ = advertise_watched<RecorderStatus>(node_, names::kRecorderStatus, names::kUtmNode, machine_is_there, true);
    save_ = offer(node_, names::kSave, [this](std::string& said) { return save(said); });
    records_ = subscribe_gated(node_, names::kKnotRecord, names::kKnotNode, &RecorderNode::on_record, this);
    test_status_ = subscribe_gated(node_, names::kTestStatus, names::kUtmNode, &RecorderNode::on_status, this);
    diagnostics_.setHardwareID("none");
    diagnostics_.add("files", this, &RecorderNode::diagnose);
    publish_status();
  }

  /// Runs until ROS is shut down. A test that has not ended then, or whose machine died, is closed with the reason.
  /// Returns the exit code: 1 where something could not be written.
  int spin() {
    while (ros::ok()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLookPeriod));
      if (is_under_way()) finish_when_ready();
      const bool news =
          run_number_ != published_.run || is_complete() != (published_.complete != 0) || error_ != published_.error;
      const bool due = seconds_since(published_at_) > kStatusPeriod;
      if (news || due) publish_status();
      if (due) diagnostics_.force_update();
    }
    if (is_under_way()) finish_early();
    return error_.empty() ? 0 : 1;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// The test that is being written.
  struct Run {
    ClaimedFolder folder;
    Method method;
    std::string beside;  ///< (TestOrder)
    std::optional<SamplesWriter> samples{};
    std::size_t rows = 0, full_rows = 0;  ///< of the curves
    std::uint64_t bag_messages = 0;       ///< of the bag, once it is written
    std::uint64_t recorded = 0;           ///< number of records written: the sequence number of the next
    Points shape{};                       ///< the latest
    bool is_shaped = false;               ///< that shape is the one of the last record
    ros::Time stamp{};                    ///< stamp of the last record
    Clock::time_point begin = Clock::now();
    bool failed = false;  ///< the last answer reports that the simulation failed
    bool complete = false;
  };

  void on_record(const KnotRecord::ConstPtr& record) {
    if (!error_.empty()) return;
    try {
      const Crosshead& command = record->command;
      if (command.run != run_number_ && command.sequence == 0) begin_run(command);
      if (!run_ || run_->complete || command.run != run_number_) return;
      Run& run = *run_;
      const bool is_shape = !record->shape.points.empty();
      // The last one comes again with the shape at the end of the test.
      const bool again = is_shape && command.sequence + 1 == run.recorded;
      if (!again && command.sequence != run.recorded)
        throw std::runtime_error(out_of_order(command.sequence, run.recorded));
      if (is_shape) run.shape = points_from_message(record->shape);
      run.is_shaped = is_shape;
      if (!again) write(*record);
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

  void on_status(const TestStatus::ConstPtr& status) {
    test_ = *status;
    if (test_.reason == kPhysicsDied) died_at_ = Clock::now();
  }

  bool save(std::string& said) {
    if (!run_) {
      said = "there is nothing to save yet";
      return false;
    }
    if (is_under_way()) {
      try {
        ResultsOptions options;
        options.without_end.reason = "saved while the test was running";
        make_files("saved.bag", options);
      } catch (const std::exception& error) {
        fail(error.what());
      }
    }
    said = error_.empty() ? "saved to " + run_->folder.path() : error_;
    return error_.empty();
  }

  void begin_run(const Crosshead& first) {
    if (run_ && !run_->complete) finish(EndedBy::kOperator, "another test was started");
    run_.reset();
    run_number_ = first.run;
    const TestOrder order = given_order(node_);
    ClaimedFolder folder = ClaimedFolder::first_free(order.out);
    if (folder.path() != order.out) ROS_WARN("%s", moved_notice(order.out, folder.path()).c_str());
    begin_run_folder(folder.path(), order.method);
    run_ = Run{std::move(folder), order.method, order.beside};
    run_->samples.emplace(run_->folder.path());
  }

  void write(const KnotRecord& record) {
    Record kept = from_message(record);
    kept.wall_time = seconds_since(run_->begin);
    run_->samples->append(kept);
    run_->stamp = record.command.header.stamp;
    run_->full_rows += kept.steps.size();
    if (cell_reading(kept)) ++run_->rows;
    run_->failed = kept.answer.status == BenchStatus::kFailed;
    ++run_->recorded;
  }

  void finish_when_ready() {
    const bool nothing_comes = seconds_since(died_at_) > kLastRecords;
    if (!test_has_ended()) {
      if (machine_died_ && nothing_comes) finish_early();
      return;
    }
    // A physics that has failed may not have the specimen any more, and one that has died answers nothing.
    const bool physics_died = test_.reason == kPhysicsDied;
    const bool all = run_->recorded > test_.sequence && (run_->is_shaped || run_->failed || physics_died);
    if (all || ((machine_died_ || physics_died) && nothing_comes)) finish_as_it_ended();
  }

  void finish_as_it_ended() { finish(ended_by_named(test_.ended_by).value_or(EndedBy::kNotYet), test_.reason); }

  void finish_early() {
    if (test_has_ended()) return finish_as_it_ended();
    // Of a master that died its launch ends the nodes in any order: that of the machine may be gone before this one.
    const char* who = !ask_master("getPid") ? "the ROS master died"
                      : machine_died_       ? "utm_node died"
                                            : "ROS was shut down";
    finish(EndedBy::kInterrupted, std::string(who) + " before the test had ended");
  }

  void finish(EndedBy ended_by, const std::string& reason) {
    Run& run = *run_;
    try {
      run.samples->end({ended_by, reason}, run.shape);
      make_files("test.bag", {});
    } catch (const std::exception& error) {
      return fail(error.what());
    }
    const std::string said = std::to_string(run.rows) + " readings were written to " + run.folder.path();
    if (ros::ok())
      ROS_INFO("%s", said.c_str());
    else  // as after Ctrl-C, when ROS prints nothing any more
      std::printf("%s\n", said.c_str());
    point_latest_to(run.folder.path());
    run.complete = true;
  }

  void make_files(const std::string& bag_name, const ResultsOptions& options) {
    Run& run = *run_;
    const std::string folder = run.folder.path();
    run.bag_messages = write_run_bag(folder + "/" + bag_name, folder, run.method, run.beside);
    const MadeResults made = make_results(folder, run.method, options);
    run.rows = made.rows;
    run.full_rows = made.full_rows;
  }

  void fail(const std::string& why) {
    error_ = why;
    if (run_) error_ += what_stands(run_->folder.path());
    ROS_ERROR("%s", error_.c_str());
  }
  bool is_complete() const { return run_ && run_->complete; }
  bool is_under_way() const { return run_ && !run_->complete && error_.empty(); }
  bool test_has_ended() const { return test_.state == TestStatus::ENDED && test_.run == run_number_; }

  void publish_status() {
    published_ = RecorderStatus();
    published_.run = run_number_;
    published_.error = error_;
    published_.complete = static_cast<std::uint8_t>(is_complete());
    if (run_) {
      published_.header.stamp = run_->stamp;
      published_.recorded = run_->recorded;
      published_.curve_rows = run_->rows;
      published_.full_rows = run_->full_rows;
      published_.bag_messages = run_->bag_messages;
      published_.directory = run_->folder.path();
    }
    published_at_ = Clock::now();
    status_.publish(published_);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    if (!error_.empty()) {
      status.summary(DiagnosticStatus::ERROR, error_);
    } else {
      status.summary(DiagnosticStatus::OK, !run_ ? "nothing to record yet" : run_->complete ? "complete" : "recording");
    }
    if (!run_) return;
    status.add("folder", run_->folder.path());
    status.add("commands recorded", run_->recorded);
    status.add("rows", run_->rows);
    status.add("rows of time steps", run_->full_rows);
    status.add("messages in the bag", run_->bag_messages);
  }

  ros::NodeHandle node_;
  std::uint32_t run_number_ = 0;
  std::optional<Run> run_;     ///< empty before the first record
  TestStatus test_;            ///< the latest
  bool machine_died_ = false;  ///< its connection broke
  Clock::time_point died_at_;  ///< when the machine or the physics died, if one has
  std::string error_;
  RecorderStatus published_;
  Clock::time_point published_at_;
  ros::Publisher status_;
  ros::Subscriber records_, test_status_;
  ros::ServiceServer save_;
  diagnostic_updater::Updater diagnostics_;
};

}  // namespace

int run_recorder_node(int argc, char** argv) {
  // A file as large as is allowed is an error like a full disk, which says what was being written.
  std::signal(SIGXFSZ, SIG_IGN);
  return run_node(argc, argv, names::kRecorderNode, kRecorderHelp,
                  [&] { return RecorderNode(join_ros(argc, argv, names::kRecorderNode)).spin(); });
}

}  // namespace knot_utm
