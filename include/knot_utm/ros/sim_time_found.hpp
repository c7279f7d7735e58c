#pragma once

#include <string>

namespace knot_utm {

/// Puts the parameter /use_sim_time, which launch files set, back to what launch/check_master found there before the
/// launch. Does so when it is destroyed, and does not need ROS to be running by then.
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
