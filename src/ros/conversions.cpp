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
static_assert(static_cast<int>(BenchStatus::kRunning) == KnotState::RUNNING);
static_assert(static_cast<int>(BenchStatus::kPhaseDone) == KnotState::PHASE_DONE);
static_assert(static_cast<int>(BenchStatus::kNotEquilibrated) == KnotState::NOT_EQUILIBRATED);
static_assert(static_cast<int>(BenchStatus::kBroken) == KnotState::BROKEN);
static_assert(static_cast<int>(BenchStatus::kFailed) == KnotState::FAILED);

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
  m.sequence = command.sequence;
  m.time = command.time;
  m.displacement = command.displacement;
  m.velocity = command.velocity;
  m.step = command.step;
  m.phase = phase_name(command.phase);
  m.speed = command.speed;
  m.duration = command.duration;
  m.balance = static_cast<std::uint8_t>(command.balance);
  m.read_cell = static_cast<std::uint8_t>(command.read_cell);
  return m;
}

Command from_message(const Crosshead& m) {
  Command command;
  command.sequence = m.sequence;
  command.time = m.time;
  command.displacement = m.displacement;
  command.velocity = m.velocity;
  command.step = m.step;
  command.phase = phase_from_name(m.phase);
  command.speed = m.speed;
  command.duration = m.duration;
  command.balance = m.balance != 0;
  command.read_cell = m.read_cell != 0;
  return command;
}

KnotState to_message(const Sample& sample, std::uint32_t run, const ros::Time& stamp) {
  KnotState m;
  m.header.stamp = stamp;
  m.header.frame_id = names::kBaseFrame;
  m.run = run;
  m.sequence = sample.sequence;
  m.time = sample.time;
  m.phase = phase_name(sample.phase);
  m.displacement = sample.displacement;
  m.extension = sample.extension;
  m.end_to_end = sample.end_to_end;
  m.knot_distance = sample.knot_distance;
  m.load = sample.load;
  m.balance_offset = sample.balance_offset;
  m.force_upper = sample.force_upper;
  m.force_lower = sample.force_lower;
  std::copy(std::begin(sample.tail_force), std::end(sample.tail_force), m.tail_force.begin());
  std::copy(std::begin(sample.excess_length), std::end(sample.excess_length), m.excess_length.begin());
  m.max_penetration = sample.max_penetration;
  m.normal_force = sample.normal_force;
  m.contacts = sample.contacts;
  m.fastest_node = sample.fastest_node;
  m.stretching_energy = sample.stretching_energy;
  m.bending_energy = sample.bending_energy;
  m.twisting_energy = sample.twisting_energy;
  m.contact_energy = sample.contact_energy;
  m.kinetic_energy = sample.kinetic_energy;
  m.grip_work = sample.grip_work;
  m.dissipation = sample.dissipation;
  m.friction_loss = sample.friction_loss;
  m.numerical_dissipation = sample.numerical_dissipation;
  m.reweighting_loss = sample.reweighting_loss;
  m.moment_imbalance = sample.moment_imbalance;
  m.steps = sample.steps;
  m.rejected_steps = sample.rejected_steps;
  m.newton_iterations = sample.newton_iterations;
  m.knot_type = static_cast<std::uint8_t>(sample.knot_type);
  m.status = static_cast<std::uint8_t>(sample.status);
  m.message = sample.message;
  return m;
}

Sample from_message(const KnotState& m) {
  if (m.status > KnotState::FAILED) throw std::invalid_argument("status " + std::to_string(m.status) + " is unknown");
  if (m.knot_type > KnotState::KNOT_CROSSED) {
    throw std::invalid_argument("knot type " + std::to_string(m.knot_type) + " is unknown");
  }
  Sample sample;
  sample.sequence = m.sequence;
  sample.time = m.time;
  sample.phase = phase_from_name(m.phase);
  sample.displacement = m.displacement;
  sample.extension = m.extension;
  sample.end_to_end = m.end_to_end;
  sample.knot_distance = m.knot_distance;
  sample.load = m.load;
  sample.balance_offset = m.balance_offset;
  sample.force_upper = m.force_upper;
  sample.force_lower = m.force_lower;
  std::copy(m.tail_force.begin(), m.tail_force.end(), std::begin(sample.tail_force));
  std::copy(m.excess_length.begin(), m.excess_length.end(), std::begin(sample.excess_length));
  sample.max_penetration = m.max_penetration;
  sample.normal_force = m.normal_force;
  sample.contacts = m.contacts;
  sample.fastest_node = m.fastest_node;
  sample.stretching_energy = m.stretching_energy;
  sample.bending_energy = m.bending_energy;
  sample.twisting_energy = m.twisting_energy;
  sample.contact_energy = m.contact_energy;
  sample.kinetic_energy = m.kinetic_energy;
  sample.grip_work = m.grip_work;
  sample.dissipation = m.dissipation;
  sample.friction_loss = m.friction_loss;
  sample.numerical_dissipation = m.numerical_dissipation;
  sample.reweighting_loss = m.reweighting_loss;
  sample.moment_imbalance = m.moment_imbalance;
  sample.steps = m.steps;
  sample.rejected_steps = m.rejected_steps;
  sample.newton_iterations = m.newton_iterations;
  sample.knot_type = static_cast<KnotType>(m.knot_type);
  sample.status = static_cast<BenchStatus>(m.status);
  sample.message = m.message;
  return sample;
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
