#include "knot_utm/ros/run_bag.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <knot_utm/KnotState.h>
#include <knot_utm/TestStatus.h>
#include <rosbag/view.h>
#include <sys/resource.h>
#include <visualization_msgs/MarkerArray.h>

#include <csignal>
#include <filesystem>
#include <set>
#include <tuple>

#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

struct TestBagTest : MadeFolder {
  /// Those in a.bag.
  template <class Message>
  std::vector<Message> messages(const std::string& topic) const {
    const rosbag::Bag bag(in("a.bag"), rosbag::bagmode::Read);
    std::vector<Message> found;
    for (const rosbag::MessageInstance& m : rosbag::View(bag, rosbag::TopicQuery(topic)))
      found.push_back(*m.instantiate<Message>());
    return found;
  }
};

Method straight() { return load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml"); }

Record record(std::uint64_t sequence) {
  Record r;
  r.command.sequence = r.answer.sequence = sequence;
  r.command.time = r.answer.time = 0.1 * static_cast<double>(sequence);
  r.command.read_cell = sequence % 2 == 0;
  r.steps = {r.answer};
  r.shape = Points::Zero(3, 4);
  r.tension = Eigen::VectorXd::Zero(3);
  return r;
}

std::size_t count(const std::string& file, const std::string& topic) {
  const rosbag::Bag bag(file, rosbag::bagmode::Read);
  return rosbag::View(bag, rosbag::TopicQuery(topic)).size();
}

TEST_F(TestBagTest, HoldsEveryCommandAndEveryReading) {
  RunBag bag(in("a.bag"), straight());
  for (std::uint64_t i = 0; i < 5; ++i) bag.add(record(i));
  bag.close();
  EXPECT_EQ(count(in("a.bag"), "/knot/state"), 5u);
  EXPECT_EQ(count(in("a.bag"), "/utm/crosshead"), 5u);
  EXPECT_EQ(count(in("a.bag"), "/utm/load_cell"), 3u);
  EXPECT_EQ(count(in("a.bag"), "/knot/shape"), 3u);
  for (const char* topic : {"/knot/markers", "/tf", "/utm/status", "/diagnostics"})
    EXPECT_EQ(count(in("a.bag"), topic), 3u) << topic;
  for (const char* topic :
       {"/utm/method", "/knot/colors", "/knot/bodies", "/knot/specimen", "/robot_description", "/tf_static"})
    EXPECT_EQ(count(in("a.bag"), topic), 1u) << topic;
  EXPECT_EQ(bag.messages(), 5u + 5u + 5u + 3u + 3u + 4u * 3u + 6u);
  const rosbag::Bag read(in("a.bag"), rosbag::bagmode::Read);
  for (const rosbag::MessageInstance& m : rosbag::View(read, rosbag::TopicQuery("/knot/state")))
    EXPECT_EQ(m.getTime(), m.instantiate<KnotState>()->header.stamp);
  // Topics that wait for whoever comes late.
  const std::set<std::string> kept = {"/utm/method",    "/utm/status",        "/knot/colors", "/knot/bodies",
                                      "/knot/specimen", "/robot_description", "/tf_static"};
  rosbag::View all(read);
  for (const rosbag::ConnectionInfo* connection : all.getConnections())
    EXPECT_EQ(connection->header->count("latching"), kept.count(connection->topic)) << connection->topic;
}

TEST_F(TestBagTest, SaysLastHowTheTestEnded) {
  const auto last = [&](const TestEnd& end) {
    RunBag bag(in("a.bag"), straight());
    for (std::uint64_t i = 0; i < 2; ++i) bag.add(record(i));
    bag.close(end);
    return std::make_pair(messages<TestStatus>("/utm/status").back(),
                          messages<diagnostic_msgs::DiagnosticArray>("/diagnostics").back().status.at(0));
  };
  EXPECT_EQ(last({}).first.state, TestStatus::RUNNING);
  const auto [status, machine] = last({EndedBy::kSolver, "why"});
  EXPECT_EQ(status.state, TestStatus::ENDED);
  EXPECT_EQ(status.sequence, 1u);
  EXPECT_EQ(status.ended_by, "solver");
  EXPECT_EQ(machine.message, "the test ended by solver: why");
  EXPECT_EQ(machine.level, diagnostic_msgs::DiagnosticStatus::ERROR);
  EXPECT_EQ(last({EndedBy::kExtension, ""}).second.level, diagnostic_msgs::DiagnosticStatus::OK);
}

/// The rod parts in a command at whose end the cell is not read: its shape and its picture are there all the same, and
/// nothing but the rod and its marks is in it.
TEST_F(TestBagTest, ARodThatPartsIsSeenToPart) {
  RunBag bag(in("a.bag"), straight());
  for (std::uint64_t i = 0; i < 2; ++i) bag.add(record(i));
  Record broken = record(3);
  broken.answer.status = BenchStatus::kBroken;
  broken.answer.break_arclength = 0.02;
  broken.answer.highest_load = 321.0;
  broken.steps = {broken.answer};
  broken.tension.setConstant(Sample::kNone);
  ASSERT_FALSE(broken.command.read_cell);
  bag.add(broken);
  bag.close();
  EXPECT_EQ(count(in("a.bag"), "/knot/shape"), 2u);
  std::set<std::string> drawn;
  for (const auto& picture : messages<visualization_msgs::MarkerArray>("/knot/markers"))
    for (const auto& marker : picture.markers)
      if (marker.action == visualization_msgs::Marker::ADD) drawn.insert(marker.ns);
  EXPECT_EQ(count(in("a.bag"), "/knot/markers"), 2u);
  EXPECT_EQ(drawn, (std::set<std::string>{"gauge_marks", "rod"}));
}

/// A file that may not grow stands for a disk that is full.
TEST_F(TestBagTest, WithoutRoomItNamesTheFileAndTheReason) {
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit tight = before;
  tight.rlim_cur = 20000;
  std::string why;
  {
    RunBag bag(in("a.bag"), straight());
    setrlimit(RLIMIT_FSIZE, &tight);
    try {
      for (std::uint64_t i = 0; i < 1000; ++i) bag.add(record(i));
      bag.close();
    } catch (const std::runtime_error& error) {
      why = error.what();
    }
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(why, "cannot write " + in("a.bag") + ": file too large");
}

TEST_F(TestBagTest, IsWrittenOfASingleTestWhereItIsAskedFor) {
  const std::string test = "straight --quiet --overwrite --out '" + in("run") + "' ";
  for (const auto& [options, code, written] :
       {std::tuple("", 0, false), std::tuple("--bag --specimens 2", 2, false), std::tuple("--bag", 0, true)}) {
    EXPECT_EQ(answer_of(tool("tensile_test", test + options)).code, code) << options;
    EXPECT_EQ(std::filesystem::exists(in("run/test.bag")), written) << options;
  }
  EXPECT_EQ(count(in("run/test.bag"), "/utm/method"), 1u);
}

}  // namespace
}  // namespace knot_utm
