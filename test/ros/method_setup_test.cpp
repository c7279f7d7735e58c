// What a test is, from the words of a launch and of a request to the order that all nodes read.
#include "knot_utm/ros/method_setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace knot_utm {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TestWords launched(std::map<std::string, std::string> more = {}) {
  more.insert({{"method", "straight"},
               {"shipped_methods", KNOT_UTM_SOURCE_DIR "/config"},
               {"material", "polypropylene"},
               {"working_directory", "/tmp"}});
  return read_words([&](const std::string& name) { return more[name]; });
}

TEST(ARequest, LeavesWhatItDoesNotNameToTheLaunch) {
  const TestWords words = asked_for(launched({{"preload", "30"}}), StartTest::Request());
  EXPECT_EQ(words.method, "straight");
  EXPECT_EQ(words.material, "polypropylene");
  EXPECT_EQ(words.preload, "30");
}

TEST(ARequest, StandsBeforeOverridesOfTheLaunch) {
  TestWords before = launched({{"overrides", "'material=pink_vps', 'material.radius=0.002'"}});
  StartTest::Request request;
  request.material = "nylon";
  const Method method = set_up(asked_for(before, request)).method;
  EXPECT_EQ(method.material.name, "nylon");
  EXPECT_EQ(method.material.radius, 0.002);
  before.overrides = {"specimen.preload=1"};
  request.preload = 0.1;
  EXPECT_THAT(asked_for(before, request).overrides,
              ElementsAre("specimen.preload=1", "material=nylon", "specimen.preload=0.1"));
  request.overrides = {"specimen.length=0.3"};
  EXPECT_EQ(asked_for(before, request).overrides, request.overrides);
  request.overrides = {""};
  EXPECT_THAT(asked_for(before, request).overrides, IsEmpty());
}

TEST(Setup, WritesBelowOutUnlessAFolderIsAskedFor) {
  EXPECT_EQ(set_up(launched()).out, "/tmp/out/straight");
  EXPECT_EQ(set_up(launched()).method.material.name, "polypropylene");
  EXPECT_EQ(set_up(launched({{"out", "here"}})).out, "/tmp/here");
}

}  // namespace
}  // namespace knot_utm
