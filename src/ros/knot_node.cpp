// The simulation as a node, and what it shows of a test.
#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <knot_utm/ColorBar.h>
#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/Reset.h>
#include <knot_utm/SpecimenInfo.h>
#include <knot_utm/TestStatus.h>
#include <knot_utm/ViewConfig.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/process.hpp"
#include "knot_utm/tying/tied_loop.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr char kFrames[] = "/tf";  // where tf2 listens
constexpr std::uint32_t kShownQueue = 100;
constexpr double kSlowest = 0.1, kFastest = 60.0;  // pictures in a second [Hz]
constexpr int kFewestSides = 3, kMostSides = 24;   // of the tube

std::optional<InvalidInput> fault_of(const ViewConfig& wanted) {
  if (!(wanted.marker_rate >= kSlowest && wanted.marker_rate <= kFastest))
    return InvalidInput("marker_rate", format_number(wanted.marker_rate),
                        format_number(kSlowest) + " to " + format_number(kFastest));
  if (wanted.color_by != View_tension && wanted.color_by != View_curvature)
    return InvalidInput("color_by", "\"" + wanted.color_by + "\"", "tension or curvature");
  if (wanted.sides != 0 && (wanted.sides < kFewestSides || wanted.sides > kMostSides))
    return InvalidInput("sides", std::to_string(wanted.sides),
                        "0, or " + std::to_string(kFewestSides) + " to " + std::to_string(kMostSides));
  return std::nullopt;
}

/// What a node shows of a test: the frames on /tf and /tf_static, the pictures for rviz, and the meaning of their
/// colours. Pictures show the latest state, at most ~marker_rate of them, while somebody subscribes. Whoever subscribes
/// late gets the last moving frames: before a test and after it nothing moves, and no others come.
///
/// The parameters ~marker_rate, ~color_by, ~contact_forces and ~sides can be changed by dynamic_reconfigure while the
/// node runs. Where a value is not allowed all of them stay as they were, which the client is told, and a line says
/// what is allowed.
class Show {
 public:
  /// `latest`: the state to be shown. Throws InvalidInput where a parameter has a value that is not allowed.
  Show(ros::NodeHandle node, std::function<SceneView()> latest)
      : latest_(std::move(latest)),
        markers_(node.advertise<visualization_msgs::MarkerArray>(names::kMarkers, 1,
                                                                 [this](const auto&) { is_old_ = true; })),
        bodies_(node.advertise<visualization_msgs::MarkerArray>(names::kBodies, 1, true)),
        colors_(node.advertise<ColorBar>(names::kColors, 1, true)),
        moving_(node.advertise<tf2_msgs::TFMessage>(
            kFrames, kShownQueue,
            [this](const auto&) { publish_frames(latest_(), published_ + ros::Duration(0, 1)); })),
        timer_(node.createSteadyTimer(ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { show_latest(); })),
        server_(ros::NodeHandle("~")) {
    server_.setCallback([this](ViewConfig& wanted, std::uint32_t) { take(wanted); });
  }

  /// Begins a new specimen on its machine.
  void begin(const Method& method, const TestingMachine& machine) {
    crosshead_ = machine.lower_grip() + Vec3(0.0, 0.0, method.specimen.end_to_end);
    fixed_.sendTransform(fixed_frames(machine.lower_grip(), ros::TIME_MIN).transforms);
    picture_.emplace(method.specimen, method.machine, method.material);
    picture_->begin(machine.state().position, machine.rod().cuts);
    bodies_.publish(picture_->bodies());
    apply();
  }

  void state_changed() { is_old_ = true; }  ///< to be called when there is another latest state

  /// Now, for the node may end before the next picture.
  void show_latest() {
    const SceneView view = latest_();
    publish_frames(view);
    if (markers_.getNumSubscribers() == 0 || !is_old_) return;
    is_old_ = false;
    markers_.publish(picture_->draw(view));
  }

 private:
  void take(ViewConfig& wanted) {
    if (const std::optional<InvalidInput> fault = fault_of(wanted)) {
      if (!view_) throw *fault;
      ROS_WARN("%s: refused: %s", ros::this_node::getName().c_str() + 1, fault->what());
      wanted = *view_;
    }
    view_ = wanted;
    timer_.setPeriod(ros::WallDuration(1.0 / wanted.marker_rate));
    if (picture_) apply();
  }

  /// The parameters to the picture.
  void apply() {
    picture_->color_by(view_->color_by == View_tension ? ColorBy::kTension : ColorBy::kCurvature);
    picture_->show_contacts(view_->contact_forces);
    picture_->sides(view_->sides);
    colors_.publish(picture_->scale().bar());
    is_old_ = true;
  }

  /// The moving frames once for each stamp, because tf2 warns of repeated ones. Somebody new gets them a nanosecond
  /// later: what is latched arrives twice where somebody subscribes as it is published.
  void publish_frames(const SceneView& view, const ros::Time& earliest = ros::TIME_MIN) {
    const ros::Time valid = std::max(view.stamp, earliest);
    if (valid <= published_) return;
    published_ = valid;
    moving_.publish(
        moving_frames(crosshead_, view.sample.displacement, view.upper_grip, picture_->knot(view.points), valid));
  }

  std::function<SceneView()> latest_;
  std::optional<ViewConfig> view_;
  Vec3 crosshead_ = Vec3::Zero();        ///< at the beginning of the test [m]
  std::optional<ScenePicture> picture_;  ///< empty: before the first specimen
  bool is_old_ = true;
  ros::Time published_;  ///< stamp of the last moving frames
  ros::Publisher markers_, bodies_, colors_, moving_;
  tf2_ros::StaticTransformBroadcaster fixed_;
  ros::SteadyTimer timer_;
  dynamic_reconfigure::Server<ViewConfig> server_;
};

constexpr double kDiagnosticsPeriod = 1.0;  // wall time [s]
constexpr double kManyRejected = 0.5;       // of the time steps that were tried
constexpr std::uint32_t kReadings = 1000;

TestingMachine make_bench(const Method& method) {
  return TestingMachine(method.specimen, method.material, method.machine, method.physics);
}

constexpr char kKnotNodeHelp[] = R"(The physics: answers each command of utm_node with forces and shape.
It is a part of: roslaunch knot_utm tighten.launch. It reads the test from the parameters test/..., which the launch
file sets (doc/ros.md).

  _marker_rate:=NUMBER        most pictures per second for rviz [25]
  _color_by:=WORD             what the colours of the rod show, tension or curvature [tension]
  _contact_forces:=FLAG       shows them in the picture [true]
  _sides:=NUMBER              of the rod's tube; 0: cylinders, with the fewest bytes [0]
)";

/// The simulation as a node. It answers each command with the state of the same sequence number and stamp. Command 0 of
/// a new test begins with a new specimen, which is that of the test's order (method_setup.hpp). A command out of order,
/// as when the specimen was reset during a test, is answered with a failure. Only commands of the machine's node are
/// accepted.
class KnotNode {
 public:
  KnotNode(const ros::NodeHandle& node, const Method& method)
      : node_(node),
        method_(method),
        machine_(make_bench(method)),
        motion_(rollers_hold(method.specimen, method.machine)),
        show_(node, [this] { return view(); }),
        diagnostics_(node_) {
    specimen_ = node_.advertise<SpecimenInfo>(names::kSpecimen, kNoLimit, true);
    const auto tell_in = [this](std::uint8_t SpecimenInfo::*connected) {
      return [=](bool is_there) {
        info_.*connected = static_cast<std::uint8_t>(is_there);
        specimen_.publish(info_);
      };
    };
    state_ =
        advertise_watched<KnotState>(node_, names::kKnotState, names::kUtmNode, tell_in(&SpecimenInfo::answers_arrive));
    record_ = advertise_watched<KnotRecord>(node_, names::kKnotRecord, names::kRecorderNode,
                                            tell_in(&SpecimenInfo::records_arrive));
    load_cell_ = node_.advertise<geometry_msgs::WrenchStamped>(names::kLoadCell, kReadings);
    shape_ = node_.advertise<KnotShape>(names::kKnotShape, 10);
    commands_ = subscribe_gated(node_, names::kCrosshead, names::kUtmNode, &KnotNode::on_command, this);
    status_ = subscribe_gated(node_, names::kTestStatus, names::kUtmNode, &KnotNode::on_status, this);
    reset_ = node_.advertiseService(names::kReset, &KnotNode::on_reset, this);

    diagnostics_.setHardwareID(method_.material.name);
    diagnostics_.add("physics", this, &KnotNode::diagnose);
    diagnostics_timer_ = node_.createSteadyTimer(ros::WallDuration(kDiagnosticsPeriod),
                                                 [this](const ros::SteadyTimerEvent&) { diagnostics_.force_update(); });
    begin_specimen();
  }

 private:
  void on_command(const Crosshead::ConstPtr& command) {
    const Crosshead& message = *command;
    if (message.run != run_) {
      if (message.sequence != 0) return refuse(message, "the specimen was reset during the test");
      try {
        const Method method = given_order(node_).method;
        if (next_ != 0 || method_yaml(method) != method_yaml(method_)) put_in(method);
      } catch (const InvalidInput& invalid) {
        return refuse(message, invalid.what());
      }
      run_ = message.run;
    }
    if (message.sequence == next_) return answer(message);
    refuse(message, out_of_order(message.sequence, next_));
  }

  bool on_reset(Reset::Request& request, Reset::Response& response) {
    response.success = static_cast<std::uint8_t>(!testing_ || request.force != 0);
    response.message = response.success ? "a new specimen" : "a test is running, and would fail: force resets it";
    if (response.success) put_in(method_);
    return true;
  }

  void on_status(const TestStatus::ConstPtr& status) {
    testing_ = status->state == TestStatus::RUNNING || status->state == TestStatus::PAUSED;
    // The recorder wants the shape at the very end, which nobody could foresee.
    if (status->state != TestStatus::ENDED || status->run != run_ || next_ != status->sequence + 1) return;
    show_.show_latest();
    readings_.end(read_);
    KnotRecord end;
    end.command = last_;
    put_shape(end);
    record_.publish(end);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const auto since = [&](std::uint64_t Sample::*count) {
      return static_cast<double>(sample_.*count - std::min(sample_.*count, diagnosed_.*count));
    };
    const double rejected = since(&Sample::rejected_steps), tried = since(&Sample::steps) + rejected;
    if (sample_.status == BenchStatus::kFailed) {
      status.summary(DiagnosticStatus::ERROR, "gave up: " + sample_.message);
    } else if (sample_.status == BenchStatus::kNotEquilibrated) {
      status.summary(DiagnosticStatus::WARN, "did not come to rest in time");
    } else if (sample_.knot_type == KnotType::kCrossed) {
      status.summary(DiagnosticStatus::ERROR, "the rod ran through itself");
    } else if (sample_.max_penetration > deepest_contact(method_.material)) {
      status.summaryf(DiagnosticStatus::WARN, "strands are pressed into each other by %.3g of the radius",
                      sample_.max_penetration);
    } else if (rejected > kManyRejected * tried) {
      status.summaryf(DiagnosticStatus::WARN, "hard: %.0f of %.0f time steps had to be shortened", rejected, tried);
    } else if (sample_.status == BenchStatus::kBroken) {
      status.summary(DiagnosticStatus::OK, "the rod broke");
    } else {
      status.summary(DiagnosticStatus::OK, phase_name(sample_.phase));
    }
    status.add("time [s]", sample_.time);
    status.add("time steps", sample_.steps);
    status.add("rejected time steps", sample_.rejected_steps);
    status.add("Newton iterations", sample_.newton_iterations);
    status.add("Newton iterations per time step of late",
               tried > 0.0 ? since(&Sample::newton_iterations) / tried : 0.0);
    status.add("contacts", sample_.contacts);
    status.add("deepest contact [fraction of radius]", sample_.max_penetration);
    diagnosed_ = sample_;
  }

  /// Puts in a new specimen; throws InvalidInput, and then the last one stays.
  void put_in(const Method& method) {
    machine_ = make_bench(method);
    method_ = method;
    diagnostics_.setHardwareID(method_.material.name);
    begin_specimen();
  }

  void begin_specimen() {
    run_ = 0;
    next_ = 0;
    sample_ = Sample();
    readings_ = {};
    motion_ = MotionPatternTracker(rollers_hold(method_.specimen, method_.machine),
                                   hung_weight(method_.specimen, method_.material),
                                   marks_of(method_.specimen, method_.program));
    show_.begin(method_, machine_);
    set_parameter(node_.resolveName(names::kRobotDescription),
                  XmlRpc::XmlRpcValue(machine_urdf(method_, machine_.lower_grip(), machine_.upper_grip())));

    info_.header.stamp = stamp_;
    put_specimen(method_, machine_.state().position, machine_.rod().cuts, info_);
    specimen_.publish(info_);
  }

  void answer(const Crosshead& message) {
    const Command command = from_message(message);
    last_ = message;
    stamp_ = message.header.stamp;
    sample_ = machine_.respond(command);
    motion_.add(sample_);
    ++next_;
    show_.state_changed();

    KnotRecord record = record_of(message, sample_);
    const double start = stamp_.toSec() - command.time;
    for (const Sample& step : machine_.substeps())
      record.steps.push_back(to_message(step, message.run, test_stamp(start, step.time)));
    if (shape_is_due(command, sample_) || sample_.status == BenchStatus::kFailed) put_shape(record);
    publish(record);
    read_ = [=, now = stamp_](const Sample& reading) {
      const bool at_command = reading.time == command.time;
      load_cell_.publish(to_wrench(reading, at_command ? now : test_stamp(start, reading.time)));
    };
    readings_.add({command, sample_, machine_.substeps(), {}, {}, {}}, read_);
  }

  void refuse(const Crosshead& message, const std::string& why) {
    Sample failed = sample_;
    failed.sequence = message.sequence;
    failed.status = BenchStatus::kFailed;
    failed.message = why;
    publish(record_of(message, failed));
  }

  KnotRecord record_of(const Crosshead& message, const Sample& answer) const {
    KnotRecord record;
    record.command = message;
    record.answer = to_message(answer, message.run, message.header.stamp);
    put_motion(motion_, record.answer);
    return record;
  }

  void publish(const KnotRecord& record) {
    state_.publish(record.answer);
    if (record_.getNumSubscribers() > 0) record_.publish(record);
    if (!record.shape.points.empty() && shape_.getNumSubscribers() > 0) shape_.publish(record.shape);
  }

  void put_shape(KnotRecord& record) const {
    record.shape = to_message(machine_.state().position, machine_.tension(), method_.material.radius, record.command);
  }

  SceneView view() const {
    return {machine_.state().position,
            machine_.tension(),
            machine_.contact_forces(),
            machine_.upper_grip(),
            sample_,
            stamp_};
  }

  ros::NodeHandle node_;
  Method method_;  ///< method of the present specimen
  TestingMachine machine_;
  SpecimenInfo info_;
  std::uint32_t run_ = 0;   ///< number of the present test; 0: there is none
  std::uint64_t next_ = 0;  ///< sequence number of the next command
  bool testing_ = false;    ///< a test is running
  Crosshead last_;          ///< the last command
  Sample sample_;           ///< the last answer
  CellReadings readings_;
  CellReadings::Take read_;      ///< publishes a reading of this test
  MotionPatternTracker motion_;  ///< motion pattern of this specimen
  ros::Time stamp_;              ///< stamp of the last answer
  Sample diagnosed_;             ///< the answer at the last diagnosis
  Show show_;

  ros::Publisher state_, record_, load_cell_, shape_, specimen_;
  ros::Subscriber commands_, status_;
  ros::ServiceServer reset_;
  ros::SteadyTimer diagnostics_timer_;
  diagnostic_updater::Updater diagnostics_;
};

}  // namespace

int run_knot_node(int argc, char** argv) {
  return run_node(argc, argv, names::kKnotNode, kKnotNodeHelp, [&] {
    const ros::NodeHandle node = join_ros(argc, argv, names::kKnotNode);
    const KnotNode knot(node, read_test_setup(node).method);
    ros::spin();
    return 0;
  });
}

}  // namespace knot_utm
