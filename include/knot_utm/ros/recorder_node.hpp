#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/RecorderStatus.h>
#include <knot_utm/TestStatus.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/run_writer.hpp"
#include "knot_utm/run/samples.hpp"

namespace knot_utm {

/// Writes every command and its answer in order, with the same code as tests without ROS. For a missing record it
/// waits, because the machine asks for it again. A record that does not come is counted as dropped. A test goes to the
/// given folder or, where that holds a run, to the first free one beside it with the suffix "-2", "-3" and so on. The
/// service recorder/save writes the results as of now, and saved.bag, the bag so far.
///
/// A record is acknowledged once it is in samples.csv, from which all other files are made at the end of the test. Of a
/// recorder that dies `tensile_test --from-samples` makes them.
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
    Run(ClaimedFolder claimed_, const Method& method_);
    ClaimedFolder claimed;
    std::string folder;
    Method method;
    std::optional<SamplesWriter> samples;
    std::size_t rows = 0, full_rows = 0;  ///< of the curves
    std::uint64_t bag_messages = 0;       ///< of the bag, once it is written
    std::uint64_t next = 0;               ///< sequence number of the next record
    std::uint64_t recorded = 0;           ///< number of records written
    std::uint64_t dropped = 0;
    std::uint64_t missing_at_end = 0;                     ///< those of them behind the last record
    std::map<std::uint64_t, KnotRecord::ConstPtr> early;  ///< records that arrived before record `next`
    Points shape;                                         ///< the latest
    std::uint64_t shape_sequence = 0;                     ///< sequence number of the record with that shape
    ros::Time stamp;                                      ///< stamp of the last record
    Clock::time_point begin = Clock::now();
    double progress = 0.0;  ///< value of `waited_` when something new last arrived [s]
    bool failed = false;    ///< the last answer reports that the simulation failed
    bool complete = false;
  };

  void on_record(const KnotRecord::ConstPtr& record);
  void on_status(const TestStatus::ConstPtr& status);
  void on_come(const ros::SingleSubscriberPublisher& subscriber);
  void on_gone(const ros::SingleSubscriberPublisher& subscriber);
  bool on_save(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  void begin_run(const Crosshead& first);
  void write(const KnotRecord& record);
  void write_early();
  void give_up_gap();
  void finish_when_ready();
  void finish_early();
  void wait_for_messages();
  void finish_as_told(const std::string& warning);  ///< by the last status of the machine
  void finish(EndedBy ended_by, const std::string& reason, const std::string& warning);
  void miss_the_end();  ///< the last records of the test will not come
  void write_results(const TestEnd& end, const std::string& warning);
  void make_files(const std::string& bag_name, ResultsOptions options);
  void fail(const std::string& why);
  bool is_complete() const { return run_ && run_->complete; }
  void publish_status();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle node_;
  std::uint32_t run_number_ = 0;
  std::unique_ptr<Run> run_;            ///< null before the first record
  TestStatus test_;                     ///< the latest
  double waited_ = 0.0;                 ///< time spent waiting for messages while this process was running [s]
  int machines_ = 0;                    ///< number of connections to the machine: two while it connects anew
  std::optional<double> machine_died_;  ///< value of `waited_` when the last of them was lost [s]
  std::string error_;
  RecorderStatus published_;
  Clock::time_point published_at_;
  ros::Publisher status_;
  ros::Subscriber records_, test_status_;
  ros::ServiceServer save_;
  diagnostic_updater::Updater diagnostics_;
  Clock::time_point diagnosed_;
};

}  // namespace knot_utm
