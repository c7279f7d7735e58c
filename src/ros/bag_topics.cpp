#include "bag_topics.hpp"

#include <filesystem>
#include <system_error>

namespace knot_utm {
namespace {

bool ends_with(const std::string& topic, const std::string& name) {
  return topic.size() > name.size() &&
         topic.compare(topic.size() - name.size() - 1, std::string::npos, "/" + name) == 0;
}

}  // namespace

InvalidInput no_bag(const std::string& file, const std::string& why) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return InvalidInput::cannot_read(file);
  return InvalidInput::sentence("bag", file, "the file is no bag that can be read: " + shown(why)).in_file(file);
}

std::string topic_named(const rosbag::Bag& bag, const std::string& file, const std::string& name) {
  std::string found;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    if (!ends_with(connection->topic, name) || connection->topic == found) continue;
    if (!found.empty())
      throw InvalidInput::sentence("topic " + name, connection->topic,
                                   "the bag has two topics " + name + ", " + shown(found) + " and " +
                                       shown(connection->topic) + ", but must have one")
          .in_file(file);
    found = connection->topic;
  }
  return found;
}

std::string required_topic(const rosbag::Bag& bag, const std::string& file, const std::string& name) {
  std::string topic = topic_named(bag, file, name);
  if (topic.empty())
    throw InvalidInput::sentence("topic " + name, "none",
                                 "the bag has no topic " + name + ", so it is not that of a test")
        .in_file(file);
  return topic;
}

}  // namespace knot_utm
