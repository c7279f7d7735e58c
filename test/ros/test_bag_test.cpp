#include "knot_utm/ros/test_bag.hpp"

#include <gtest/gtest.h>
#include <knot_utm/KnotState.h>
#include <rosbag/view.h>
#include <unistd.h>

#include <filesystem>

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

class TestBagTest : public testing::Test {
 protected:
  TestBagTest() : folder_(fs::path(testing::TempDir()) / ("test_bag_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~TestBagTest() override { fs::remove_all(folder_); }

  std::string file(const char* name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

void add(TestBag& bag, std::uint64_t sequence) {
  Record record;
  record.command.sequence = record.answer.sequence = sequence;
  record.command.time = record.answer.time = 0.1 * static_cast<double>(sequence);
  record.command.read_cell = sequence % 2 == 0;
  record.shape = Points::Zero(3, 4);
  record.tension = Eigen::VectorXd::Zero(3);
  bag.add(record);
}

std::size_t count(const std::string& file, const std::string& topic) {
  const rosbag::Bag bag(file, rosbag::bagmode::Read);
  return rosbag::View(bag, rosbag::TopicQuery(topic)).size();
}

TEST_F(TestBagTest, HoldsEveryCommandAndEveryReading) {
  TestBag bag(file("a.bag"), Method());
  for (std::uint64_t i = 0; i < 5; ++i) add(bag, i);
  bag.close();
  EXPECT_EQ(count(file("a.bag"), "/knot/state"), 5u);
  EXPECT_EQ(count(file("a.bag"), "/utm/crosshead"), 5u);
  EXPECT_EQ(count(file("a.bag"), "/utm/load_cell"), 3u);
  EXPECT_EQ(count(file("a.bag"), "/knot/shape"), 3u);
  EXPECT_EQ(bag.messages(), 5u + 5u + 5u + 3u + 3u);
}

TEST_F(TestBagTest, StampsAreThoseOfTheHeaders) {
  TestBag bag(file("a.bag"), Method());
  for (std::uint64_t i = 0; i < 5; ++i) add(bag, i);
  bag.close();
  const rosbag::Bag read(file("a.bag"), rosbag::bagmode::Read);
  for (const rosbag::MessageInstance& m : rosbag::View(read, rosbag::TopicQuery("/knot/state"))) {
    EXPECT_EQ(m.getTime(), m.instantiate<KnotState>()->header.stamp);
  }
}

TEST_F(TestBagTest, SavedCopyCanBeReadWhileTheBagGoesOn) {
  TestBag bag(file("a.bag"), Method());
  add(bag, 0);
  bag.save(file("saved.bag"));
  add(bag, 1);
  EXPECT_EQ(count(file("saved.bag"), "/knot/state"), 1u);
  bag.close();
  EXPECT_EQ(count(file("a.bag"), "/knot/state"), 2u);
}

}  // namespace
}  // namespace knot_utm
