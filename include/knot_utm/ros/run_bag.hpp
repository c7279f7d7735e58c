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
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/run/csv.hpp"
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

/// Writes the readings of a curve as write_curve_bag does. `begin`: test time of the first [s].
void write_readings(BagWriter& bag, const std::vector<CurveRow>& rows, double begin, const char* crosshead,
                    const char* load_cell);

/// Writes test.bag: the topics of one test, at the stamps of their headers. Tests with and without ROS give the same
/// bag. It has utm/crosshead, utm/joint_states and knot/state for every command, utm/load_cell for every reading
/// (CellReadings), and knot/shape at sampling instants. The load cell is also read in the time step in which a rod
/// parts, and the bag has a knot/state for that step, too.
///
/// `rosbag play`, rviz and panel_node can show the bag while nothing else runs. For this it contains utm/method,
/// knot/specimen, knot/colors, knot/bodies, robot_description and all frames, and at every reading knot/markers.
/// utm/status and /diagnostics are included without what depends on wall time; the last ones say how the test ended. A
/// record that is followed is on experiment/..., and begins where the crosshead follows it; one that is beside the
/// test, where its last pull begins.
class RunBag {
 public:
  /// `beside`: a record (read_record) beside the test; empty: none. Throws InvalidInput where the specimen does not fit
  /// the machine. All functions throw std::runtime_error where the file cannot be written.
  RunBag(const std::string& file, const Method& method, std::string beside = "");
  void add(const Record& record);
  void close(const TestEnd& end = {});

  std::uint64_t messages() const { return bag_.messages(); }  ///< number of messages written so far

 private:
  static constexpr std::uint32_t kRun = 1;  ///< number of its one test, whichever it was of the node that ran it

  void add_reading(const Sample& reading);
  void add_status(const TestEnd& end);
  void add_picture(const Record& record, const ros::Time& stamp);

  BagWriter bag_;
  Method method_;
  std::string beside_;
  Centreline centreline_;
  Grips grips_;
  Vec3 crosshead_;  ///< at the beginning of the test [m]
  ScenePicture picture_;
  CellReadings cell_readings_;
  Command command_;  ///< the last one
  Sample answer_;    ///< to it
  MotionPatternTracker motion_;
  bool begun_ = false;
};

/// Writes the bag of the test whose samples a folder has, and returns the number of its messages.
std::uint64_t write_run_bag(const std::string& file, const std::string& folder, const Method& method,
                            const std::string& beside = "");

}  // namespace knot_utm
