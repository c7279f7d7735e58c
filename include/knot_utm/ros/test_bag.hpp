#pragma once

#include <rosbag/bag.h>

#include <cstdint>
#include <memory>
#include <string>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/record.hpp"

namespace knot_utm {

/// test.bag: the topics of one test with the stamps of their headers, the same from a live and from a headless run.
/// utm/crosshead, utm/joint_states and knot/state for every command; utm/load_cell and knot/shape for every reading.
class TestBag {
 public:
  /// Throws std::runtime_error where the file cannot be written, as all of it does.
  TestBag(const std::string& file, const Method& method);
  ~TestBag();
  TestBag(const TestBag&) = delete;
  TestBag& operator=(const TestBag&) = delete;
  TestBag(TestBag&&) = delete;
  TestBag& operator=(TestBag&&) = delete;

  void add(const Record& record);
  void close();  ///< only then has the file an index, without which it cannot be read

  std::uint64_t messages() const { return messages_; }  ///< written so far

 private:
  template <class Message>
  void write(const std::string& topic, const ros::Time& stamp, const Message& message);

  std::string file_;
  std::unique_ptr<rosbag::Bag> bag_;  ///< none once closed
  double radius_;                     ///< [m]
  MotionPatternTracker motion_;
  std::uint64_t messages_ = 0;
};

}  // namespace knot_utm
