#pragma once

#include <optional>
#include <string>

namespace knot_utm {

/// If the roslaunch that started this process is killed, this process is interrupted as by Ctrl-C: nobody else would
/// end it.
void end_with_launch();

/// To be called when the test is over. Ends the launch as Ctrl-C does, and returns when that has reached this node.
/// roslaunch itself ends only where a required node ends, and calls that a death, even after a success.
void end_launch();

/// As `end_launch`, once the window of the node rviz is closed, where there is one.
void end_launch_when_rviz_is_closed();

/// Writes how the test ended to the file that the launch argument `verdict` names, for scripts/tighten: in the first
/// line the exit code, which is empty until the test is over, and in the second the folder. `file`: empty: none.
void write_verdict(const std::string& file, std::optional<int> code, const std::string& folder);

/// Puts the parameter /use_sim_time, which launch files set, back to what launch/check found there before the launch.
/// Does so when it is destroyed, and does not need ROS to be running by then.
class SimTimeFound {
 public:
  SimTimeFound();
  ~SimTimeFound();
  SimTimeFound(const SimTimeFound&) = delete;
  SimTimeFound& operator=(const SimTimeFound&) = delete;

 private:
  std::string parameter_;  ///< /use_sim_time, or what it is remapped to
  std::string note_;       ///< the parameter with what was found
  std::string found_;      ///< "unset", "true" or "false"; empty: not known
};

}  // namespace knot_utm
