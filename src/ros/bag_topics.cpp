#include "bag_topics.hpp"

namespace knot_utm {
namespace {

bool ends_with(const std::string& topic, const std::string& name) {
  return topic.size() > name.size() &&
         topic.compare(topic.size() - name.size() - 1, std::string::npos, "/" + name) == 0;
}

}  // namespace

std::string topic_named(const rosbag::Bag& bag, const std::string& file, const std::string& name) {
  std::string found;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    if (!ends_with(connection->topic, name) || connection->topic == found) continue;
    if (!found.empty()) throw InvalidInput(file, "topic " + name, found + " and " + connection->topic, "one of them");
    found = connection->topic;
  }
  return found;
}

std::string required_topic(const rosbag::Bag& bag, const std::string& file, const std::string& name) {
  std::string topic = topic_named(bag, file, name);
  if (topic.empty()) throw InvalidInput(file, "topic " + name, "none", "a bag that has it");
  return topic;
}

}  // namespace knot_utm
