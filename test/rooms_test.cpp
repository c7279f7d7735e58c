// The rooms of the core use each other as cmake/rooms.txt says, and none of them knows of ROS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// cmake/rooms.txt: the rooms of the core, each with all rooms that it may use, by way of others too.
std::map<std::string, std::set<std::string>> table_of_rooms() {
  std::map<std::string, std::set<std::string>> table;
  std::ifstream file(fs::path(KNOT_UTM_SOURCE_DIR) / "cmake/rooms.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line[0] == '=') continue;
    std::istringstream words(std::regex_replace(line, std::regex(":"), " "));
    std::string room, used;
    words >> room;
    std::set<std::string>& uses = table[room];
    uses.insert(room);
    while (words >> used) {
      const std::set<std::string>& further = table.at(used);  // it must stand above
      uses.insert(further.begin(), further.end());
    }
  }
  return table;
}

std::vector<std::string> core_rooms() {
  std::vector<std::string> rooms;
  for (const auto& [room, uses] : table_of_rooms()) rooms.push_back(room);
  return rooms;
}

/// Lines of the files of some rooms that match `forbidden`.
std::vector<std::string> offenders(const std::regex& forbidden, const std::vector<std::string>& rooms = core_rooms()) {
  std::vector<std::string> found;
  for (const char* tree : {"src", "include/knot_utm"}) {
    for (const std::string& room : rooms) {
      const fs::path folder = fs::path(KNOT_UTM_SOURCE_DIR) / tree / room;
      if (!fs::is_directory(folder)) continue;
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
          if (std::regex_search(line, forbidden)) found.push_back(entry.path().string() + ": " + line);
        }
      }
    }
  }
  return found;
}

TEST(Rooms, AreAllInTheTable) {
  const std::map<std::string, std::set<std::string>> table = table_of_rooms();
  const std::set<std::string> around = {"ros", "nodes", "tools"};  // what is built on the core
  for (const char* tree : {"src", "include/knot_utm"})
    for (const fs::directory_entry& room : fs::directory_iterator(fs::path(KNOT_UTM_SOURCE_DIR) / tree)) {
      const std::string name = room.path().filename().string();
      EXPECT_TRUE(table.count(name) + around.count(name) == 1) << name;
    }
}

TEST(Rooms, UseOnlyThoseThatTheTableSays) {
  const std::regex include(R"re(^\s*#\s*include\s*"knot_utm/(\w+)/)re");
  for (const auto& [room, uses] : table_of_rooms())
    for (const std::string& line : offenders(include, {room})) {
      std::smatch used;
      const std::string text = line.substr(line.find('#'));
      ASSERT_TRUE(std::regex_search(text, used, include)) << line;
      EXPECT_TRUE(uses.count(used[1]) > 0) << line;
    }
}

TEST(Rooms, NoFileOfTheProgramBeginsAsATestDoes) {
  for (const char* tree : {"src", "include"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(KNOT_UTM_SOURCE_DIR) / tree))
      EXPECT_NE(entry.path().filename().string().rfind("test_", 0), 0u) << entry.path();
}

TEST(Rooms, NoFileReachesIntoAnotherRoom) {
  std::vector<std::string> all = core_rooms();
  all.insert(all.end(), {"ros", "nodes", "tools"});
  EXPECT_THAT(offenders(std::regex(R"(^\s*#\s*include\s*"\.\.)"), all), testing::IsEmpty());
}

TEST(Rooms, NoCoreFileIncludesRosOrAMessage) {
  // Message headers end in .h and begin with a capital letter; those of the core end in .hpp.
  EXPECT_THAT(offenders(std::regex(R"(^\s*#\s*include\s*[<"]((knot_utm/)?(ros|rosbag|tf2[a-z_]*|actionlib)/)"
                                   R"(|[a-z0-9_]+/[A-Z][A-Za-z0-9]*\.h[>"]))")),
              testing::IsEmpty());
}

TEST(Rooms, NodesReadNoClockThatSomebodySets) {
  // Anybody may publish /clock, and the clock of the machine is set by others too.
  EXPECT_THAT(offenders(std::regex(R"(Time::now|system_clock|WallTime\b|WallTimer\b|createTimer|ros::Rate|WallRate|)"
                                   R"(gettimeofday|\btime\(nullptr|THROTTLE|DELAYED)"),
                        {"ros", "nodes"}),
              testing::IsEmpty());
}

}  // namespace
