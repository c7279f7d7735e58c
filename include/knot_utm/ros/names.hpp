#pragma once

/// All names that the nodes share. All of them except /clock are relative; the launch file chooses the namespace, and
/// remaps /clock into it.
namespace knot_utm::names {

// Nodes. Each accepts messages of the rightful publisher only, by these names.
inline constexpr char kUtmNode[] = "utm_node";
inline constexpr char kKnotNode[] = "knot_node";
inline constexpr char kRecorderNode[] = "recorder_node";

// Topics
inline constexpr char kCrosshead[] = "utm/crosshead";       ///< Crosshead, a command for the physics
inline constexpr char kJointStates[] = "utm/joint_states";  ///< sensor_msgs/JointState of the crosshead
inline constexpr char kLoadCell[] = "utm/load_cell";        ///< geometry_msgs/WrenchStamped, as the cell reads it
inline constexpr char kTestStatus[] = "utm/status";         ///< TestStatus, latched
inline constexpr char kMethod[] = "utm/method";             ///< std_msgs/String, latched: the method.yaml of the test
inline constexpr char kClock[] = "/clock";                  ///< rosgraph_msgs/Clock, the time of the test
inline constexpr char kKnotState[] = "knot/state";          ///< KnotState, the answer to each command
/// KnotRecord, the complete record of a command, for the recorder
inline constexpr char kKnotRecord[] = "knot/record";
inline constexpr char kKnotShape[] = "knot/shape";            ///< KnotShape, at each reading of the load cell
inline constexpr char kSpecimen[] = "knot/specimen";          ///< SpecimenInfo, latched
inline constexpr char kMarkers[] = "knot/markers";            ///< visualization_msgs/MarkerArray
inline constexpr char kBodies[] = "knot/bodies";              ///< visualization_msgs/MarkerArray, latched
inline constexpr char kColors[] = "knot/colors";              ///< ColorBar, latched: meaning of the rod's colours
inline constexpr char kRecorderStatus[] = "recorder/status";  ///< RecorderStatus, latched

// Services, all others of them std_srvs/Trigger
inline constexpr char kStartTest[] = "utm/start_test";  ///< StartTest
inline constexpr char kStopTest[] = "utm/stop_test";
inline constexpr char kBalance[] = "utm/balance";
inline constexpr char kPause[] = "utm/pause";
inline constexpr char kResume[] = "utm/resume";
inline constexpr char kStep[] = "utm/step";
inline constexpr char kReset[] = "knot/reset";  ///< Reset
inline constexpr char kSave[] = "recorder/save";

// Actions
inline constexpr char kRunTest[] = "utm/run_test";  ///< RunTest: a test, until all of it is recorded
inline constexpr char kMove[] = "utm/move";         ///< Move: leads the crosshead in a running test

// Parameters that the nodes set
/// set by utm_node: what a test is, {name: ..., method: ..., out: ...} (method_setup.hpp)
inline constexpr char kTestOrder[] = "test/order";
inline constexpr char kRobotDescription[] = "robot_description";  ///< set by knot_node: the machine as URDF

// Parameters that the launch file sets
inline constexpr char kSimTimeFound[] = "test/use_sim_time_found";  ///< what /use_sim_time was before the launch

// Frames
inline constexpr char kWorldFrame[] = "world";
inline constexpr char kBaseFrame[] = "utm_base";
inline constexpr char kLowerGripFrame[] = "lower_grip";
inline constexpr char kCrossheadFrame[] = "crosshead";
inline constexpr char kUpperGripFrame[] = "upper_grip";
inline constexpr char kLoadCellFrame[] = "load_cell";
inline constexpr char kKnotFrame[] = "knot";

inline constexpr char kCrossheadJoint[] = "crosshead";  ///< in utm/joint_states

}  // namespace knot_utm::names
