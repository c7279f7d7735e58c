// out/latest leads to the run that was written last, whatever the folder is called that it was written to.

#include "knot_utm/run/latest_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "knot_utm/run/run_folder.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class LatestLink : public OwnFolder {
 protected:
  static std::string made(const std::string& name) {
    fs::create_directories(folder() + "/" + name);
    return folder() + "/" + name;
  }
  static std::string latest() { return fs::read_symlink(folder() + "/out/latest").string(); }
};

TEST_F(LatestLink, LeadsToTheLastOne) {
  EXPECT_EQ(point_latest_to(made("out/tighten")), folder() + "/out/latest");
  EXPECT_EQ(latest(), "tighten");
  point_latest_to(made("out/a b") + "/");
  EXPECT_EQ(latest(), "a b");
  point_latest_to(folder() + "/out/latest");  // a run that went on by that name
  EXPECT_EQ(latest(), "a b");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder() + "/out"), fs::directory_iterator()), 3);
}

TEST_F(LatestLink, IsMadeInNoOtherFolderAndReplacesNothing) {
  EXPECT_EQ(point_latest_to(made("elsewhere/run")), "");
  EXPECT_FALSE(fs::exists(folder() + "/elsewhere/latest"));
  made("out/latest");
  EXPECT_EQ(point_latest_to(made("out/run")), "");
  EXPECT_TRUE(fs::is_directory(fs::symlink_status(folder() + "/out/latest")));
}

/// A command that follows reads the run that was just made, also where that one goes elsewhere than asked.
TEST_F(LatestLink, FollowingCommandsReadTheRunThatWasJustMade) {
  fs::create_directories(folder());
  const std::string begin = "cd '" + folder() + "' && ";
  const auto run = [&](const std::string& more) {
    const Answer answer = answer_of(begin + tool("tensile_test", "straight --set physics.accuracy=draft " + more));
    EXPECT_EQ(answer.code, 0) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr(", and the folder is also out/latest\n"));
  };
  run("--out out/mine");
  run("--out out/mine --set specimen.length=0.1");
  EXPECT_EQ(latest(), "mine-2");
  const Answer same = answer_of(begin + tool("compare", "out/latest/curve.csv out/mine-2/curve.csv --tolerance 0"));
  EXPECT_EQ(same.code, 0) << same.text;
  EXPECT_EQ(answer_of(begin + tool("compare", "out/latest/curve.csv out/mine/curve.csv --tolerance 0.1")).code, 1);
  // A batch as a whole, not one of its specimens.
  run("--out out/batch --specimens 2");
  EXPECT_EQ(latest(), "batch");
  EXPECT_FALSE(fs::exists(folder() + "/out/batch/latest"));
  // What is refused leaves it where it was.
  EXPECT_EQ(answer_of(begin + tool("tensile_test", "straight --out out/no --set specimen.length=-1")).code, 2);
  EXPECT_EQ(latest(), "batch");
}

}  // namespace
}  // namespace knot_utm
