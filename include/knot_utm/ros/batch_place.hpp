#pragma once

#include <string>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// Largest number of specimens in a batch under ROS. All of them are drawn before the first is tested, which takes
/// about 15 ms for each, and the machine answers nobody meanwhile.
inline constexpr int kMostInBatch = 1000;

/// The reason that utm_node gives for the end of a test in which knot_node died. The specimen is not to blame for it.
inline constexpr char kPhysicsDied[] = "knot_node died during the test";

/// Which specimen of a batch a test takes.
struct BatchPlace {
  int number = 1;  ///< of the specimen, from 1
  int count = 1;   ///< specimens of the batch; 1: the test stands alone

  bool alone() const { return count == 1; }
  /// "specimen 2 of 8"
  std::string text() const;
  friend bool operator==(const BatchPlace& a, const BatchPlace& b) {
    return a.number == b.number && a.count == b.count;
  }
};

/// The method of a batch of this many specimens.
Method method_of_batch(const Method& method, int count);

/// The command that tests the specimens of a batch which have not been tested, with the tool that stands beside this
/// program.
std::string command_to_resume(const std::string& batch);

}  // namespace knot_utm
