#pragma once

#include <ros/message_traits.h>
#include <rosbag/bag.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "knot_utm/analysis/motion_pattern.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/settings/step_settings.hpp"

namespace knot_utm {

/// Writes a bag. All functions throw CannotWrite. None ends the process when the disk is full, as the destructor of
/// rosbag::Bag does.
class BagWriter {
 public:
  explicit BagWriter(const std::string& file) : file_(file) {
    constexpr std::uint32_t kChunk =
        64 * 1024;  // small enough to be read in pieces, large enough for few chunks [bytes]
    try {
      bag_ = std::make_unique<rosbag::Bag>(file_, rosbag::bagmode::Write);
    } catch (const rosbag::BagException&) {
      throw CannotWrite(file_);
    }
    bag_->setChunkThreshold(kChunk);
  }
  ~BagWriter() {
    try {
      close();
    } catch (const std::runtime_error&) {
      // Who wants to know closes it.
    }
  }
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  /// Writes a message. `topic`: name without a leading slash.
  template <class Message>
  void write(const std::string& topic, const ros::Time& stamp, const Message& message,
             const boost::shared_ptr<ros::M_string>& header = nullptr) {
    try {
      bag_->write("/" + topic, stamp, message, header);
    } catch (const rosbag::BagException&) {
      throw CannotWrite(file_);
    }
    ++messages_;
  }

  /// The same for a latched topic, whose last message `rosbag play` keeps for later subscribers.
  template <class Message>
  void write_latched(const std::string& topic, const ros::Time& stamp, const Message& message) {
    const auto header = boost::make_shared<ros::M_string>();
    (*header)["latching"] = "1";
    (*header)["type"] = ros::message_traits::datatype<Message>();
    (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
    (*header)["message_definition"] = ros::message_traits::definition<Message>();
    write(topic, stamp, message, header);
  }

  /// Writes the index, without which the file cannot be read.
  void close() {
    if (!bag_) return;
    try {
      bag_->close();
      bag_.reset();
    } catch (const rosbag::BagException&) {
      // Its destructor would try once more, and end the process.
      static_cast<void>(bag_.release());
      throw CannotWrite(file_);
    }
  }

  std::uint64_t messages() const { return messages_; }  ///< number of messages written so far

 private:
  std::string file_;
  std::unique_ptr<rosbag::Bag> bag_;  ///< null once closed
  std::uint64_t messages_ = 0;
};

/// Writes test.bag: the topics of one test, at the stamps of their headers. Tests with and without ROS give the same
/// bag. It has utm/crosshead, utm/joint_states and knot/state for every command, utm/load_cell for every reading
/// (CellReadings), and knot/shape at sampling instants. The load cell is also read in the time step in which a rod
/// parts, and the bag has a knot/state for that step, too.
///
/// `rosbag play`, rviz and panel_node can show the bag while nothing else runs. For this it contains utm/method,
/// knot/colors, knot/bodies and all frames on /tf, and at every reading knot/markers with the rod as spheres.
/// utm/status is included without the fields that depend on wall time.
class RunBag {
 public:
  /// Throws InvalidInput where the specimen does not fit the machine. All functions throw std::runtime_error where the
  /// file cannot be written.
  RunBag(const std::string& file, const Method& method)
      : RunBag(file, method, specimen_centreline(method.specimen, method.material, method.machine, method.physics)) {}
  void add(const Record& record);
  void close();

  std::uint64_t messages() const { return bag_.messages(); }  ///< number of messages written so far

 private:
  static constexpr std::uint32_t kRun = 1;  ///< number of its one test, whichever it was of the node that ran it

  RunBag(const std::string& file, const Method& method, const Centreline& centreline);
  void add_reading(const Sample& reading);
  void add_status(const Record& record, const ros::Time& stamp);
  void add_picture(const Record& record, const ros::Time& stamp);

  BagWriter bag_;
  std::string method_;     ///< text of the method
  double radius_;          ///< [m]
  std::vector<int> cuts_;  ///< edges between one rope and the next
  Grips grips_;
  Vec3 crosshead_;  ///< at the beginning of the test [m]
  ScenePicture picture_;
  CellReadings cell_readings_;
  bool begun_ = false;
  bool broken_ = false;
  MotionPatternTracker motion_;
};

}  // namespace knot_utm
