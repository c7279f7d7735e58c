#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <knot_utm/Crosshead.h>
#include <knot_utm/KnotRecord.h>
#include <knot_utm/SpecimenInfo.h>
#include <knot_utm/TestStatus.h>
#include <ros/ros.h>

#include <string>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/ros/show.hpp"

namespace knot_utm {

/// The simulation as a node. It answers each command with the state of the same sequence number and stamp. Command 0 of
/// a new test begins with a new specimen, which is that of the test's order (method_setup.hpp). A command out of order,
/// as when the specimen was reset during a test, is answered with a failure. Only commands of the machine's node are
/// accepted.
class KnotNode {
 public:
  KnotNode(const ros::NodeHandle& node, const Method& method);

 private:
  void on_command(const Crosshead::ConstPtr& command);
  void on_status(const TestStatus::ConstPtr& ended);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  void put_in(const Method& method);  ///< puts in a new specimen; throws InvalidInput, and then the last one stays
  void begin_specimen();
  void answer(const Crosshead& message);
  void refuse(const Crosshead& message, const std::string& why);
  void publish(const KnotRecord& record);
  void put_shape(KnotRecord& record) const;
  SceneView view() const;

  ros::NodeHandle node_;
  Method method_;  ///< method of the present specimen
  TestingMachine machine_;
  SpecimenInfo info_;
  std::uint32_t run_ = 0;        ///< number of the present test; 0: there is none
  std::uint64_t next_ = 0;       ///< sequence number of the next command
  Crosshead last_;               ///< the last command
  Sample sample_;                ///< the last answer
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

}  // namespace knot_utm
