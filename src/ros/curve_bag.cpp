#include "knot_utm/ros/curve_bag.hpp"

#include <ros/exception.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/run_bag.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

/// The name in the bag of one of the package's topics, in whatever namespace. Empty where the bag does not have it, and
/// need not.
std::string topic_named(const rosbag::Bag& bag, const std::string& name, bool required) {
  const std::string end = "/" + name;
  std::string found;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    const std::string& topic = connection->topic;
    const bool ends = topic.size() >= end.size() && topic.compare(topic.size() - end.size(), end.size(), end) == 0;
    if (!ends || topic == found) continue;
    if (!found.empty())
      throw InvalidInput::sentence("topic " + name, "the bag has two topics " + name + ", " + shown(found) + " and " +
                                                        shown(topic) + ", but must have one");
    found = topic;
  }
  if (required && found.empty())
    throw InvalidInput::sentence("topic " + name, "the bag has no topic " + name + ", so it is not that of a test");
  return found;
}

/// Calls `take` with every message of a topic. Throws InvalidInput where one is of another type, or of another version
/// of this type.
template <typename Message, typename Take>
void for_each(const rosbag::Bag& bag, const std::string& topic, Take take) {
  if (topic.empty()) return;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    const boost::shared_ptr<Message> message = instance.instantiate<Message>();
    if (!message)
      throw InvalidInput(
          "the type of topic " + topic, instance.getDataType() + " " + instance.getMD5Sum(),
          std::string(ros::message_traits::datatype<Message>()) + " " + ros::message_traits::md5sum<Message>());
    take(*message);
  }
}

CurveRow measured(double time, double extension, Phase phase) {
  CurveRow row;
  row.time = time;
  row.extension = extension;
  row.phase = phase;
  row.end_to_end = Sample::kNone;
  return row;
}

/// The readings of each test, one after the other. Tests of one number differ in that their time begins anew.
std::vector<std::vector<CurveRow>> tests_in(const rosbag::Bag& bag) {
  const std::string load_cell = topic_named(bag, names::kLoadCell, true);
  const std::string crosshead = topic_named(bag, names::kCrosshead, false);
  struct Place {
    CurveRow row;
    std::uint32_t run = 0;
  };
  std::map<ros::Time, Place> at;
  for_each<Crosshead>(bag, crosshead, [&](const Crosshead& message) {
    const Command command = from_message(message);
    at[message.header.stamp] = {measured(command.time, command.displacement, command.phase), message.run};
  });
  for_each<KnotState>(bag, topic_named(bag, names::kKnotState, false), [&](const KnotState& message) {
    at[message.header.stamp] = {curve_row(from_message(message)), message.run};
  });
  std::vector<std::vector<CurveRow>> tests;
  std::uint32_t run = 0;
  for_each<geometry_msgs::WrenchStamped>(bag, load_cell, [&](const geometry_msgs::WrenchStamped& message) {
    const ros::Time& stamp = message.header.stamp;
    if (crosshead.empty()) at.try_emplace(stamp, Place{measured(stamp.toSec(), Sample::kNone, Phase::kPull), 0});
    const auto found = at.find(stamp);
    if (found == at.end())
      throw InvalidInput::sentence(
          "topic " + load_cell, "a reading on topic " + shown(load_cell) + " has no command with the same time stamp");
    Place reading = found->second;
    reading.row.load = message.wrench.force.z;
    const bool goes_on = !tests.empty() && reading.run == run &&
                         (tests.back().size() < 2 || reading.row.time > tests.back().front().time);
    if (!goes_on) tests.emplace_back();
    tests.back().push_back(reading.row);
    run = reading.run;
  });
  return tests;
}

std::vector<CurveRow> rows_of(const rosbag::Bag& bag, int wanted) {
  std::vector<std::vector<CurveRow>> tests = tests_in(bag);
  if (tests.empty() && wanted <= 1) return {};
  const std::string all = std::to_string(tests.size());
  if (wanted == 0 && tests.size() > 1)
    throw InvalidInput::sentence("tests", "the bag holds " + all + " tests: choose one by --specimen 1 to " + all);
  const std::size_t index = wanted == 0 ? 0 : static_cast<std::size_t>(wanted - 1);
  if (index >= tests.size())
    throw InvalidInput::sentence("tests", "--specimen is " + std::to_string(wanted) + ", but the bag holds " + all +
                                              (tests.size() == 1 ? " test" : " tests"));
  return std::move(tests[index]);
}

}  // namespace

std::vector<CurveRow> read_curve_bag(const std::string& file, int test) {
  try {
    return rows_of(rosbag::Bag(file, rosbag::bagmode::Read), test);
  } catch (const InvalidInput& invalid) {
    throw invalid.in_file(file);
  } catch (const ros::Exception& error) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) throw InvalidInput::cannot_read(file);
    throw InvalidInput::sentence("bag", "the file is no bag that can be read: " + shown(error.what())).in_file(file);
  } catch (const std::invalid_argument& error) {
    throw InvalidInput::sentence("message", "a message is not that of a test: " + shown(error.what())).in_file(file);
  }
}

std::vector<CurveRow> read_record(const std::string& file) {
  const std::vector<CurveRow> rows = is_curve_file(file) ? read_curve(file) : read_curve_bag(file, 1);
  return {std::find_if(rows.begin(), rows.end(), [](const CurveRow& row) { return pulls(row.phase); }), rows.end()};
}

void write_curve_bag(const std::string& file, const std::vector<CurveRow>& rows) {
  BagWriter bag(file);
  write_readings(bag, rows, 0.0, names::kCrosshead, names::kLoadCell);
  bag.close();
}

}  // namespace knot_utm
