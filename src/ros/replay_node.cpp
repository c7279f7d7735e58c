#include "knot_utm/ros/replay_node.hpp"

#include <geometry_msgs/WrenchStamped.h>
#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotState.h>
#include <ros/callback_queue.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "bag_topics.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/launched.hpp"
#include "knot_utm/ros/master_parameters.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/urdf.hpp"
#include "wall_time.hpp"

namespace knot_utm {
namespace {

constexpr std::size_t kAtOnce = 100;  // messages between two looks at what others want
constexpr std::uint32_t kReplayQueue = 1000;

void open(rosbag::Bag& bag, const std::string& file) {
  try {
    bag.open(file, rosbag::bagmode::Read);
  } catch (const ros::Exception& error) {
    throw no_bag(file, error.what());
  }
}

/// What its messages are called in the bag, and by us.
std::map<std::string, std::string> topics_of(const rosbag::Bag& bag, const std::string& file) {
  std::map<std::string, std::string> names;
  for (const char* name : {names::kKnotShape, names::kKnotState}) names[required_topic(bag, file, name)] = name;
  for (const char* name : {names::kCrosshead, names::kJointStates, names::kLoadCell, names::kTestStatus}) {
    const std::string topic = topic_named(bag, file, name);
    if (!topic.empty()) names[topic] = name;
  }
  return names;
}

}  // namespace

ReplayNode::ReplayNode(const ros::NodeHandle& node, const Method& method, const ReplayOptions& options)
    : node_(node),
      options_(options),
      machine_(method.specimen, method.material, method.machine, method.physics),
      tested_(method),
      show_(
          node, [this] { return moment_; }, [] { return std::vector<ContactForce>(); }),
      method_(node_.advertise<std_msgs::String>(names::kMethod, 1, true)),
      clock_(node_.advertise<rosgraph_msgs::Clock>(names::kClock, 10)) {
  open(bag_, options_.bag);
  names_ = topics_of(bag_, options_.bag);
  std::vector<std::string> topics;
  for (const auto& [topic, name] : names_) topics.push_back(topic);
  view_ = std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery(topics));
  next_ = view_->begin();
  start_ = now_ = view_->getBeginTime();
  publishers_[names::kKnotShape] = node_.advertise<KnotShape>(names::kKnotShape, kReplayQueue);
  publishers_[names::kKnotState] = node_.advertise<KnotState>(names::kKnotState, kReplayQueue);
  publishers_[names::kCrosshead] = node_.advertise<Crosshead>(names::kCrosshead, kReplayQueue);
  publishers_[names::kJointStates] = node_.advertise<sensor_msgs::JointState>(names::kJointStates, kReplayQueue);
  publishers_[names::kTestStatus] = node_.advertise<TestStatus>(names::kTestStatus, kReplayQueue, true);
  publishers_[names::kLoadCell] = node_.advertise<geometry_msgs::WrenchStamped>(names::kLoadCell, kReplayQueue);
  std_msgs::String text;
  text.data = method_yaml(method);
  method_.publish(text);
  set_on_master(node_.resolveName(names::kRobotDescription),
                machine_urdf(method, machine_.lower_grip(), machine_.upper_grip()));
  show_.begin(tested_, machine_.lower_grip(), Points(3, 0), machine_.rod().cuts);
  begin_ = Clock::now();
}

int ReplayNode::spin() {
  while (ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(until_due()));
    if (!begun_ && (show_.somebody_looks() || seconds_since(begin_) > options_.patience)) begin();
    if (begun_) play_what_is_due();
    if (seconds_since(clock_published_) > kIdleClockPeriod) publish_clock();
    if (begun_ && next_ == view_->end() && !ended_) publish_end();
    if (options_.exit_at_end && next_ == view_->end()) {
      publish_clock();
      show_.show_latest();
      ROS_INFO("%s has been replayed", options_.bag.c_str());
      ros::WallDuration(kGoodbye).sleep();
      end_launch_when_rviz_is_closed();
      break;
    }
  }
  return 0;
}

void ReplayNode::begin() {
  begun_ = true;
  begin_ = Clock::now();
}

double ReplayNode::until_due() const {
  constexpr double kLook = 0.02;
  if (!begun_ || next_ == view_->end()) return kLook;
  if (options_.rate <= 0.0) return 0.0;
  return std::clamp((next_->getTime() - start_).toSec() / options_.rate - seconds_since(begin_), 0.0, kLook);
}

void ReplayNode::play_what_is_due() {
  for (std::size_t played = 0; played < kAtOnce && next_ != view_->end() && until_due() <= 0.0; ++played) {
    play(*next_);
    ++next_;
    if (seconds_since(clock_published_) > kClockPeriod) publish_clock();
  }
}

template <class Message>
boost::shared_ptr<Message> ReplayNode::replay(const rosbag::MessageInstance& instance) {
  boost::shared_ptr<Message> message = message_of<Message>(instance, options_.bag);
  publishers_.at(names_.at(instance.getTopic())).publish(*message);
  return message;
}

void ReplayNode::play(const rosbag::MessageInstance& instance) {
  now_ = std::max(now_, instance.getTime());
  const std::string& name = names_.at(instance.getTopic());
  if (name == names::kKnotShape) {
    show(*replay<KnotShape>(instance));
  } else if (name == names::kKnotState) {
    const boost::shared_ptr<KnotState> state = replay<KnotState>(instance);
    try {
      sample_ = from_message(*state);
    } catch (const std::invalid_argument& fault) {
      throw InvalidInput::sentence(name, "", "a message on " + name + " is not that of a test: " + shown(fault.what()))
          .in_file(options_.bag);
    }
    run_ = state->run;
    motion_pattern_ = state->motion_pattern;
  } else if (name == names::kCrosshead) {
    replay<Crosshead>(instance);
  } else if (name == names::kJointStates) {
    replay<sensor_msgs::JointState>(instance);
  } else if (name == names::kTestStatus) {
    status_ = *replay<TestStatus>(instance);
  } else {
    replay<geometry_msgs::WrenchStamped>(instance);
  }
}

/// A bag is the same whether its test ran under ROS or not, and says "running" to its end.
void ReplayNode::publish_end() {
  ended_ = true;
  status_.header.stamp = now_;
  status_.run = run_;
  status_.state = TestStatus::ENDED;
  status_.ended_by = options_.ended_by;
  publishers_.at(names::kTestStatus).publish(status_);
}

void ReplayNode::publish_clock() {
  clock_published_ = Clock::now();
  rosgraph_msgs::Clock clock;
  clock.clock = std::max(now_, ros::TIME_MIN);
  clock_.publish(clock);
}

void ReplayNode::show(const KnotShape& shape) {
  const Points points = points_from_message(shape);
  if (moment_.points.cols() == 0) show_.begin(tested_, machine_.lower_grip(), points, machine_.rod().cuts);
  const Eigen::VectorXd tension =
      Eigen::Map<const Eigen::VectorXd>(shape.tension.data(), static_cast<Eigen::Index>(shape.tension.size()));
  // On a compliant frame the grip goes less far than the crosshead.
  const double travel =
      sample_.end_to_end > 0.0 ? sample_.end_to_end - (machine_.upper_grip() - machine_.lower_grip()).norm() : 0.0;
  moment_ = {now_, points, tension, machine_.upper_grip() + travel * Vec3::UnitZ(), sample_, motion_pattern_};
  show_.state_changed();
}

}  // namespace knot_utm
