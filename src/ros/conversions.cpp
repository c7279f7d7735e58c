#include "knot_utm/ros/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/program.hpp"
#include "knot_utm/record/sample_fields.hpp"
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/words/number.hpp"

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

Phase phase_from_name(const std::string& name) {
  if (const std::optional<Phase> phase = phase_named(name)) return *phase;
  throw std::invalid_argument("\"" + name + "\" is not a phase");
}

/// What a command and its message call by the same name, there or back.
template <class From, class To>
void copy_command(const From& from, To& to) {
  to.sequence = from.sequence;
  to.time = from.time;
  to.displacement = from.displacement;
  to.velocity = from.velocity;
  to.turn = from.turn;
  to.step = from.step;
  to.speed = from.speed;
  to.duration = from.duration;
  to.stop_load = from.stop_load;
  to.balance = from.balance != 0;
  to.read_cell = from.read_cell != 0;
}

void put(Phase phase, std::string& to) { to = phase_name(phase); }
template <class From, class To>
void put(const From& from, To& to) {
  to = static_cast<To>(from);
}
template <class To>
void put(const PerKnot& from, To& to) {
  to.assign(from.begin(), from.end());
}

/// What `name` is called is for complaints.
void take(const std::string& from, Phase& phase, const char* /*name*/) { phase = phase_from_name(from); }
template <class From, class To>
void take(const From& from, To& to, const char* name) {
  if constexpr (std::is_enum_v<To>) {
    if (from > static_cast<From>(last_of(To())))
      throw std::invalid_argument(std::string(name) + " " + std::to_string(from) + " is unknown");
    to = static_cast<To>(from);
  } else {
    to = from;
  }
}
template <class From>
void take(const From& from, PerKnot& to, const char* name) {
  if (from.size() > PerKnot::kMost) throw std::invalid_argument(std::string(name) + " is of too many knots");
  to = PerKnot::of(from);
}

geometry_msgs::TransformStamped transform(const char* parent, const char* child, const Vec3& translation,
                                          const ros::Time& stamp) {
  geometry_msgs::TransformStamped t;
  t.header.stamp = stamp;
  t.header.frame_id = parent;
  t.child_frame_id = child;
  t.transform.translation.x = translation.x();
  t.transform.translation.y = translation.y();
  t.transform.translation.z = translation.z();
  t.transform.rotation.w = 1.0;
  return t;
}

std::string text(const Vec3& v) {
  return format_number(v.x()) + " " + format_number(v.y()) + " " + format_number(v.z());
}

/// How a cylinder, which stands along z, is turned to lie along an axis: about y, and then about z.
Vec3 turn_to(const Vec3& axis) {
  return {0.0, std::acos(std::clamp(axis.z(), -1.0, 1.0)), std::atan2(axis.y(), axis.x())};
}

std::string visual(const GripBody& body, double radius) {
  const bool box = body.cylinder_radius == 0.0;
  const std::string shape = box ? "<box size=\"" + text(2.0 * body.half_box(radius)) + "\"/>"
                                : "<cylinder radius=\"" + format_number(body.cylinder_radius) + "\" length=\"" +
                                      format_number(2.0 * body.half_length(radius)) + "\"/>";
  return "    <visual>\n      <origin xyz=\"" + text(body.from_grip) + "\" rpy=\"" +
         text(box ? Vec3(Vec3::Zero()) : turn_to(body.axis)) + "\"/>\n      <geometry>" + shape +
         "</geometry>\n    </visual>\n";
}

std::string link(const char* name, const std::string& visuals = "") {
  return std::string("  <link name=\"") + name + "\">\n" + visuals + "  </link>\n";
}

std::string joint(const char* name, const char* type, const char* parent, const char* child, const Vec3& at,
                  const std::string& more = "") {
  return std::string("  <joint name=\"") + name + "\" type=\"" + type + "\">\n    <parent link=\"" + parent +
         "\"/>\n    <child link=\"" + child + "\"/>\n    <origin xyz=\"" + text(at) + "\" rpy=\"0 0 0\"/>\n" + more +
         "  </joint>\n";
}

}  // namespace

ros::Time test_stamp(double start, double time) {
  // The start is worked out from a stamp, and may come out a little before the clock's, which no ros::Time can hold.
  return std::max(ros::Time(std::max(start + time, 0.0)), ros::TIME_MIN);
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
  visit_sample_fields([&](const auto& field) { put(field.of(sample), field.of(m)); });
  return m;
}

Sample from_message(const KnotState& m) {
  Sample sample;
  visit_sample_fields([&](const auto& field) { take(field.of(m), field.of(sample), field.name); });
  return sample;
}

void put_motion(const MotionPatternTracker& motion, KnotState& message) {
  message.motion_pattern = motion_pattern_name(motion.pattern());
  message.locked = static_cast<std::uint8_t>(motion.lock_extension().has_value());
}

void put_specimen(const Method& method, const Points& drawn, const std::vector<int>& cuts, SpecimenInfo& message) {
  const RopeRadii radii(method.material, cuts);
  message.header.frame_id = names::kBaseFrame;
  message.longest_step = tolerances(method.physics, method.specimen, method.material).longest_step;
  message.radius = radii.first;
  message.length = length_of_pieces(drawn, cuts);
  message.nodes = static_cast<std::uint32_t>(drawn.cols());
  message.other_radius = radii.others;
  message.first_of_other = static_cast<std::uint32_t>(std::min(radii.first_of_others, drawn.cols()));
}

std::string in_words(const TestEnd& end) {
  return std::string("the test ended by ") + ended_by_name(end.ended_by) +
         (end.reason.empty() ? "" : ": " + end.reason);
}

geometry_msgs::Point to_point(const Vec3& place) {
  geometry_msgs::Point point;
  point.x = place.x();
  point.y = place.y();
  point.z = place.z();
  return point;
}

KnotShape to_message(const Points& points, const Eigen::VectorXd& tension, double radius, const Crosshead& command) {
  KnotShape m;
  m.header.stamp = command.header.stamp;
  m.header.frame_id = names::kBaseFrame;
  m.run = command.run;
  m.sequence = command.sequence;
  m.radius = radius;
  for (Eigen::Index i = 0; i < points.cols(); ++i) m.points.push_back(to_point(points.col(i)));
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

tf2_msgs::TFMessage fixed_frames(const Vec3& lower_grip, const ros::Time& stamp) {
  tf2_msgs::TFMessage frames;
  frames.transforms = {transform(names::kWorldFrame, names::kBaseFrame, Vec3::Zero(), stamp),
                       transform(names::kBaseFrame, names::kLowerGripFrame, lower_grip, stamp),
                       transform(names::kUpperGripFrame, names::kLoadCellFrame, Vec3::Zero(), stamp)};
  return frames;
}

tf2_msgs::TFMessage moving_frames(const Vec3& crosshead, double displacement, const Vec3& upper_grip, const Vec3& knot,
                                  const ros::Time& stamp) {
  const Vec3 now = crosshead + Vec3(0.0, 0.0, displacement);
  tf2_msgs::TFMessage frames;
  frames.transforms = {transform(names::kBaseFrame, names::kCrossheadFrame, now, stamp),
                       transform(names::kCrossheadFrame, names::kUpperGripFrame, upper_grip - now, stamp),
                       transform(names::kBaseFrame, names::kKnotFrame, knot, stamp)};
  return frames;
}

std::string machine_urdf(const Method& method, const Vec3& lower_grip, const Vec3& upper_grip) {
  const MachineOptions& machine = method.machine;
  std::string lower, upper;
  for (const GripBody& body : grip_bodies(method.specimen, machine, method.material))
    (body.goes_up ? upper : lower) += visual(body, thickest(method.material));
  const std::string moves = "    <axis xyz=\"0 0 1\"/>\n    <limit lower=\"" + format_number(-machine.travel) +
                            "\" upper=\"" + format_number(machine.travel) + "\" velocity=\"" +
                            format_number(kFastestCrosshead) + "\" effort=\"" +
                            format_number(machine.load_cell.capacity) + "\"/>\n";
  const Vec3 crosshead = lower_grip + Vec3(0.0, 0.0, method.specimen.end_to_end);
  return "<?xml version=\"1.0\"?>\n<robot name=\"knot_utm\">\n" + link(names::kWorldFrame) + link(names::kBaseFrame) +
         link(names::kLowerGripFrame, lower) + link(names::kCrossheadFrame) + link(names::kUpperGripFrame, upper) +
         link(names::kLoadCellFrame) + joint("base", "fixed", names::kWorldFrame, names::kBaseFrame, Vec3::Zero()) +
         joint("lower_grip", "fixed", names::kBaseFrame, names::kLowerGripFrame, lower_grip) +
         joint(names::kCrossheadJoint, "prismatic", names::kBaseFrame, names::kCrossheadFrame, crosshead, moves) +
         joint("upper_grip", "fixed", names::kCrossheadFrame, names::kUpperGripFrame, upper_grip - crosshead) +
         joint("load_cell", "fixed", names::kUpperGripFrame, names::kLoadCellFrame, Vec3::Zero()) + "</robot>\n";
}

}  // namespace knot_utm
