#include "knot_utm/ros/experiment_node.hpp"

#include <geometry_msgs/WrenchStamped.h>
#include <knot_utm/StartTest.h>
#include <ros/callback_queue.h>

#include <utility>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/raw/raw_options.hpp"
#include "knot_utm/raw/raw_zero.hpp"
#include "knot_utm/record/program.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

constexpr double kLook = 0.05;  // wall time between two looks at what has come [s]
constexpr std::uint32_t kRecordQueue = 1000;

/// The zero is looked for in what is pulled, and so a record of compression is turned round for it.
void mirror(std::vector<CurveRow>& rows) {
  for (CurveRow& row : rows) row.extension = -row.extension;
}

}  // namespace

RecordBalance record_balance_named(const std::string& name) {
  if (name == "auto") return RecordBalance::kAuto;
  if (name == "true") return RecordBalance::kYes;
  if (name == "false") return RecordBalance::kNo;
  throw InvalidInput("balance", name, "auto, true or false");
}

std::vector<CurveRow> record_with_zero(std::vector<CurveRow> rows, RecordBalance balance, const Tell& tell) {
  if (rows.empty() || balance == RecordBalance::kNo) return rows;
  if (has_its_zero(rows)) {
    if (balance == RecordBalance::kYes) tell("the record is a curve of knot_utm and keeps its own zero");
    return rows;
  }
  const bool compresses = falls(rows, &CurveRow::extension);
  if (compresses) mirror(rows);
  RawZero zero = zero_at_rest(rows);
  rows = balanced(rows, zero);
  if (compresses) {
    mirror(rows);
    zero.extension = -zero.extension;
  }
  tell(zero_words(zero));
  return rows;
}

ExperimentNode::ExperimentNode(const ros::NodeHandle& node, std::vector<CurveRow> rows, RecordBalance balance,
                               const Tell& tell)
    : node_(node),
      began_(rows.empty() ? 0.0 : rows.front().time),
      rows_(record_with_zero(std::move(rows), balance, tell)),
      load_cell_(node_.advertise<geometry_msgs::WrenchStamped>(names::kExperimentLoad, kRecordQueue)),
      crosshead_(node_.advertise<Crosshead>(names::kExperimentCrosshead, kRecordQueue)),
      commands_(
          subscribe_gated(node_, names::kCrosshead, names::kUtmNode, kRecordQueue, &ExperimentNode::on_command, this)),
      start_(node_.serviceClient<StartTest>(names::kStartTest)) {}

void ExperimentNode::spin(bool autostart) {
  while (ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLook));
    if (autostart && run_ == 0) try_to_start();
  }
}

void ExperimentNode::try_to_start() {
  StartTest start;
  // The machine offers it once the physics is there, and refuses while a test runs.
  if (commands_.getNumPublishers() > 0 && start_.exists() && start_.call(start) && start.response.accepted == 0)
    ros::WallDuration(kLook).sleep();
}

void ExperimentNode::on_command(const Crosshead::ConstPtr& command) {
  if (command->run < run_ || (command->run == run_ && command->sequence < sequence_)) return;  // asked for again
  if (command->run != run_) next_ = 0;
  run_ = command->run;
  sequence_ = command->sequence;
  if (command->phase != phase_name(Phase::kFollow)) {
    if (next_ == 0) begin_ = command->header.stamp;
    return;
  }
  for (; next_ < rows_.size(); ++next_) {
    const ros::Time stamp = begin_ + ros::Duration(rows_[next_].time - began_);
    if (stamp > command->header.stamp) break;
    publish(rows_[next_], stamp);
  }
}

void ExperimentNode::publish(const CurveRow& row, const ros::Time& stamp) {
  Sample measured;
  measured.load = row.load;
  load_cell_.publish(to_wrench(measured, stamp));
  Command place;
  place.sequence = next_;
  place.time = row.time;
  place.displacement = travel_of(row);
  place.phase = Phase::kFollow;
  place.read_cell = true;
  crosshead_.publish(to_message(place, run_, stamp));
}

}  // namespace knot_utm
