#include "knot_utm/ros/curve_bag.hpp"

#include <ros/exception.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "bag_topics.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/ros/bag_writer.hpp"
#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

/// Calls `take` with every message of a topic.
template <typename Message, typename Take>
void for_each(const rosbag::Bag& bag, const std::string& file, const std::string& topic, Take take) {
  if (topic.empty()) return;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    take(*message_of<Message>(instance, file));
  }
}

std::vector<CurveRow> rows_of(const rosbag::Bag& bag, const std::string& file) {
  const std::string load_cell = required_topic(bag, file, names::kLoadCell);
  const std::string crosshead = required_topic(bag, file, names::kCrosshead);
  const std::string state = topic_named(bag, file, names::kKnotState);
  std::map<ros::Time, CurveRow> at;
  for_each<Crosshead>(bag, file, crosshead, [&](const Crosshead& message) {
    const Command command = from_message(message);
    CurveRow& row = at[message.header.stamp];
    row.time = command.time;
    row.extension = command.displacement;
    row.phase = command.phase;
    row.end_to_end = row.load_lower = Sample::kNone;
  });
  for_each<KnotState>(bag, file, state,
                      [&](const KnotState& message) { at[message.header.stamp] = curve_row(from_message(message)); });
  std::vector<CurveRow> out;
  for_each<geometry_msgs::WrenchStamped>(bag, file, load_cell, [&](const geometry_msgs::WrenchStamped& message) {
    const auto found = at.find(message.header.stamp);
    if (found == at.end())
      throw InvalidInput::sentence(
          "topic " + load_cell, "no command",
          "a reading on topic " + shown(load_cell) + " has no command with the same time stamp")
          .in_file(file);
    out.push_back(found->second);
    out.back().load = message.wrench.force.z;
  });
  return out;
}

}  // namespace

std::vector<CurveRow> read_curve_bag(const std::string& file) {
  try {
    const rosbag::Bag bag(file, rosbag::bagmode::Read);
    return rows_of(bag, file);
  } catch (const ros::Exception& error) {
    throw no_bag(file, error.what());
  } catch (const std::invalid_argument& error) {
    throw InvalidInput::sentence("message", error.what(), "a message is not that of a test: " + shown(error.what()))
        .in_file(file);
  }
}

void write_curve_bag(const std::string& file, const std::vector<CurveRow>& rows) {
  BagWriter bag(file);
  Command command;
  Sample sample;
  ros::Time stamp;
  const double start = rows.empty() ? 0.0 : rows.front().time;
  for (const CurveRow& row : rows) {
    // Readings may be closer to each other than their times tell; their stamps pair them with their commands.
    stamp = std::max(test_stamp(-start, row.time), stamp + ros::Duration(0, 1));
    const double passed = row.time - command.time;
    command.velocity = passed > 0.0 ? (row.extension - command.displacement) / passed : 0.0;
    command.time = row.time;
    command.displacement = row.extension;
    command.phase = row.phase;
    command.read_cell = true;
    sample.load = row.load;
    bag.write(names::kCrosshead, stamp, to_message(command, 1, stamp));
    bag.write(names::kLoadCell, stamp, to_wrench(sample, stamp));
    ++command.sequence;
  }
  bag.close();
}

}  // namespace knot_utm
