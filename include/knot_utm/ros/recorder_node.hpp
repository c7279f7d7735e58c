#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/RecorderStatus.h>
#include <knot_utm/TestStatus.h>
#include <ros/ros.h>

#include <chrono>
#include <optional>
#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/run_writer.hpp"
#include "knot_utm/run/samples.hpp"

namespace knot_utm {

/// Writes every command and its answer as they arrive, with the same code as tests without ROS. A gap between them is
/// an error, which ends the test. A test goes to the given folder or, where that holds a run, to the first free one
/// beside it with the suffix "-2", "-3" and so on. The service recorder/save writes the results as of now, and
/// saved.bag, the bag so far.
///
/// A record goes to samples.csv at once, from which all other files are made at the end of the test. Of a recorder that
/// dies `tensile_test --from-samples` makes them.
class RecorderNode {
 public:
  explicit RecorderNode(const ros::NodeHandle& node);

  /// Runs until ROS is shut down. A test that has not ended then, or whose machine died, is closed with the reason.
  /// Returns the exit code: 1 where something could not be written.
  int spin();

 private:
  using Clock = std::chrono::steady_clock;

  /// The test that is being written.
  struct Run {
    ClaimedFolder folder;
    Method method;
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

  void on_record(const KnotRecord::ConstPtr& record);
  void on_status(const TestStatus::ConstPtr& status);
  bool save(std::string& said);

  void begin_run(const Crosshead& first);
  void write(const KnotRecord& record);
  void finish_when_ready();
  void finish_early();
  void finish(EndedBy ended_by, const std::string& reason);
  void make_files(const std::string& bag_name, ResultsOptions options);
  void fail(const std::string& why);
  bool is_complete() const { return run_ && run_->complete; }
  bool is_under_way() const { return run_ && !run_->complete && error_.empty(); }
  bool test_has_ended() const { return test_.state == TestStatus::ENDED && test_.run == run_number_; }
  void publish_status();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

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

}  // namespace knot_utm
