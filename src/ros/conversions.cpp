#include "knot_utm/ros/conversions.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

static_assert(static_cast<int>(KnotType::kKept) == KnotState::KNOT_KEPT);
static_assert(static_cast<int>(KnotType::kChanged) == KnotState::KNOT_CHANGED);
static_assert(static_cast<int>(KnotType::kCrossed) == KnotState::KNOT_CROSSED);
static_assert(static_cast<int>(BreakPlace::kNone) == KnotState::BREAK_NONE);
static_assert(static_cast<int>(BreakPlace::kStrand) == KnotState::BREAK_STRAND);
static_assert(static_cast<int>(BreakPlace::kKnot) == KnotState::BREAK_KNOT);
static_assert(static_cast<int>(BreakPlace::kGrip) == KnotState::BREAK_GRIP);
static_assert(static_cast<int>(BenchStatus::kRunning) == KnotState::RUNNING);
static_assert(static_cast<int>(BenchStatus::kPhaseDone) == KnotState::PHASE_DONE);
static_assert(static_cast<int>(BenchStatus::kNotEquilibrated) == KnotState::NOT_EQUILIBRATED);
static_assert(static_cast<int>(BenchStatus::kBroken) == KnotState::BROKEN);
static_assert(static_cast<int>(BenchStatus::kFailed) == KnotState::FAILED);

/// What a command and its message call by the same name, there or back.
template <class From, class To>
void copy_command(const From& from, To& to) {
  to.sequence = from.sequence;
  to.time = from.time;
  to.displacement = from.displacement;
  to.velocity = from.velocity;
  to.step = from.step;
  to.speed = from.speed;
  to.duration = from.duration;
  to.balance = from.balance != 0;
  to.read_cell = from.read_cell != 0;
}

/// The same of a sample.
template <class From, class To>
void copy_sample(const From& from, To& to) {
  to.sequence = from.sequence;
  to.time = from.time;
  to.displacement = from.displacement;
  to.extension = from.extension;
  to.end_to_end = from.end_to_end;
  to.knot_distance = from.knot_distance;
  to.load = from.load;
  to.highest_load = from.highest_load;
  to.lowest_load = from.lowest_load;
  to.break_arclength = from.break_arclength;
  to.balance_offset = from.balance_offset;
  to.force_upper = from.force_upper;
  to.force_lower = from.force_lower;
  std::copy(std::begin(from.tail_force), std::end(from.tail_force), std::begin(to.tail_force));
  std::copy(std::begin(from.excess_length), std::end(from.excess_length), std::begin(to.excess_length));
  to.max_penetration = from.max_penetration;
  to.normal_force = from.normal_force;
  to.contacts = from.contacts;
  to.fastest_node = from.fastest_node;
  to.stretching_energy = from.stretching_energy;
  to.bending_energy = from.bending_energy;
  to.twisting_energy = from.twisting_energy;
  to.contact_energy = from.contact_energy;
  to.kinetic_energy = from.kinetic_energy;
  to.grip_work = from.grip_work;
  to.dissipation = from.dissipation;
  to.friction_loss = from.friction_loss;
  to.numerical_dissipation = from.numerical_dissipation;
  to.reweighting_loss = from.reweighting_loss;
  to.moment_imbalance = from.moment_imbalance;
  to.steps = from.steps;
  to.rejected_steps = from.rejected_steps;
  to.newton_iterations = from.newton_iterations;
  to.message = from.message;
  to.knots_force = from.knots_force;
  to.knot_on_roller = from.knot_on_roller;
  to.raw_extension = from.raw_extension;
}

}  // namespace

ros::Time test_stamp(double start, double time) {
  // The start is worked out from a stamp, and may come out a little before the clock's, which no ros::Time can hold.
  return std::max(ros::Time(std::max(start + time, 0.0)), ros::TIME_MIN);
}

Phase phase_from_name(const std::string& name) {
  if (const std::optional<Phase> phase = phase_named(name)) return *phase;
  throw std::invalid_argument("\"" + name + "\" is not a phase");
}

Crosshead to_message(const Command& command, std::uint32_t run, const ros::Time& stamp) {
  Crosshead m;
  m.header.stamp = stamp;
  m.header.frame_id = names::kCrossheadFrame;
  m.run = run;
  m.phase = phase_name(command.phase);
  copy_command(command, m);
  return m;
}

Command from_message(const Crosshead& m) {
  Command command;
  command.phase = phase_from_name(m.phase);
  copy_command(m, command);
  return command;
}

KnotState to_message(const Sample& sample, std::uint32_t run, const ros::Time& stamp) {
  KnotState m;
  m.header.stamp = stamp;
  m.header.frame_id = names::kBaseFrame;
  m.run = run;
  m.phase = phase_name(sample.phase);
  m.break_place = static_cast<std::uint8_t>(sample.break_place);
  m.knot_type = static_cast<std::uint8_t>(sample.knot_type);
  m.status = static_cast<std::uint8_t>(sample.status);
  copy_sample(sample, m);
  return m;
}

Sample from_message(const KnotState& m) {
  if (m.status > KnotState::FAILED) throw std::invalid_argument("status " + std::to_string(m.status) + " is unknown");
  if (m.knot_type > KnotState::KNOT_CROSSED) {
    throw std::invalid_argument("knot type " + std::to_string(m.knot_type) + " is unknown");
  }
  if (m.break_place > KnotState::BREAK_GRIP)
    throw std::invalid_argument("place of the break " + std::to_string(m.break_place) + " is unknown");
  Sample sample;
  sample.phase = phase_from_name(m.phase);
  sample.break_place = static_cast<BreakPlace>(m.break_place);
  sample.knot_type = static_cast<KnotType>(m.knot_type);
  sample.status = static_cast<BenchStatus>(m.status);
  copy_sample(m, sample);
  return sample;
}

void put_motion(const MotionPatternTracker& motion, KnotState& message) {
  message.motion_pattern = motion_pattern_name(motion.pattern());
  message.locked = static_cast<std::uint8_t>(motion.lock_extension().has_value());
}

KnotShape to_message(const Points& points, const Eigen::VectorXd& tension, double radius) {
  KnotShape m;
  m.header.frame_id = names::kBaseFrame;
  m.radius = radius;
  m.points.resize(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    geometry_msgs::Point& point = m.points[static_cast<std::size_t>(i)];
    point.x = points(0, i);
    point.y = points(1, i);
    point.z = points(2, i);
  }
  m.tension.assign(tension.data(), tension.data() + tension.size());
  return m;
}

Points points_from_message(const KnotShape& message) {
  Points points(3, static_cast<Eigen::Index>(message.points.size()));
  Eigen::Index i = 0;
  for (const geometry_msgs::Point& point : message.points) points.col(i++) << point.x, point.y, point.z;
  return points;
}

Record from_message(const KnotRecord& message) {
  Record record;
  record.command = from_message(message.command);
  record.answer = from_message(message.answer);
  record.steps.reserve(message.steps.size());
  for (const KnotState& step : message.steps) record.steps.push_back(from_message(step));
  record.shape = points_from_message(message.shape);
  const std::vector<double>& tension = message.shape.tension;
  record.tension = Eigen::Map<const Eigen::VectorXd>(tension.data(), static_cast<Eigen::Index>(tension.size()));
  return record;
}

geometry_msgs::WrenchStamped to_wrench(const Sample& sample, const ros::Time& stamp) {
  geometry_msgs::WrenchStamped m;
  m.header.stamp = stamp;
  m.header.frame_id = names::kLoadCellFrame;
  m.wrench.force.z = sample.load;
  return m;
}

sensor_msgs::JointState to_joint_state(const Command& command, const Sample& sample, const ros::Time& stamp) {
  sensor_msgs::JointState m;
  m.header.stamp = stamp;
  m.name = {names::kCrossheadJoint};
  m.position = {command.displacement};
  m.velocity = {command.velocity};
  m.effort = {sample.load};
  return m;
}

}  // namespace knot_utm
