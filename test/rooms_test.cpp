// The core knows nothing of ROS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kCoreRooms = {"rod",      "solver",  "contact",  "sim",
                                             "specimen", "machine", "analysis", "io"};

/// Lines of the files of some rooms that match `forbidden`.
std::vector<std::string> offenders(const std::regex& forbidden, const std::vector<std::string>& rooms = kCoreRooms) {
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

TEST(Rooms, NoCoreFileIncludesRos) {
  EXPECT_THAT(offenders(std::regex(R"(^\s*#\s*include\s*[<"](knot_utm/)?(ros|rosbag|tf2[a-z_]*|actionlib)/)")),
              testing::IsEmpty());
}

TEST(Rooms, NoCoreFileIncludesAMessageHeader) {
  // Message headers end in .h and begin with a capital letter; those of the core end in .hpp.
  EXPECT_THAT(offenders(std::regex(R"(^\s*#\s*include\s*[<"][a-z0-9_]+/[A-Z][A-Za-z0-9]*\.h[>"])")),
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
