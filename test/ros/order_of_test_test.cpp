// What a test is, from the words of a launch and of a request to the order that all nodes read.
#include "knot_utm/ros/order_of_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/urdf.hpp"
#include "knot_utm/study/specimens.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> shipped_methods() {
  const fs::path config = fs::path(KNOT_UTM_SOURCE_DIR) / "config";
  std::vector<std::string> found;
  for (const fs::path& folder : {config, config / "standards", config / "validation"})
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".yaml") found.push_back(entry.path().string());
  return found;
}

TestWords launched() {
  TestWords words;
  words.method = "straight";
  words.shipped_methods = KNOT_UTM_SOURCE_DIR "/config";
  words.material = "polypropylene";
  words.preload = "30";
  words.working_directory = "/tmp";
  words.overrides = {"material=pink_vps", "material.radius=0.002", "specimen.preload=1"};
  return words;
}

TEST(ARequest, LeavesWhatItDoesNotNameToTheLaunch) {
  const TestWords words = asked_for(launched(), StartTest::Request());
  EXPECT_EQ(words.method, "straight");
  EXPECT_EQ(words.material, "polypropylene");
  EXPECT_EQ(words.preload, "30");
  EXPECT_EQ(words.overrides, launched().overrides);
}

TEST(ARequest, StandsBeforeAnOverrideOfTheLaunch) {
  StartTest::Request request;
  request.material = "nylon";
  TestWords words = asked_for(launched(), request);
  EXPECT_EQ(words.material, "nylon");
  EXPECT_THAT(words.overrides, ElementsAre("material.radius=0.002", "specimen.preload=1"));
  request.preload = 0.1;
  words = asked_for(launched(), request);
  EXPECT_EQ(words.preload, "0.1");
  EXPECT_THAT(words.overrides, ElementsAre("material.radius=0.002"));
}

TEST(ARequest, TakesThePlaceOfAllOverridesOfTheLaunch) {
  StartTest::Request request;
  request.overrides = {"specimen.length=0.3"};
  EXPECT_EQ(asked_for(launched(), request).overrides, request.overrides);
  request.overrides = {""};
  EXPECT_THAT(asked_for(launched(), request).overrides, IsEmpty());
}

TEST(Setup, WritesBelowOutUnlessAFolderIsAskedFor) {
  TestWords words = launched();
  words.preload.clear();
  words.overrides.clear();
  EXPECT_EQ(set_up(words).out, "/tmp/out/straight");
  EXPECT_EQ(set_up(words).method.material.name, "polypropylene");
  words.out = "here";
  EXPECT_EQ(set_up(words).out, "/tmp/here");
}

TEST(Setup, SaysOfAnOverrideWhatALaunchCallsIt) {
  for (const char* wrong : {"x", "specimen.length=[1"}) {
    TestWords words = launched();
    words.overrides = {wrong};
    try {
      set_up(words);
      ADD_FAILURE() << wrong;
    } catch (const InvalidInput& invalid) {
      EXPECT_EQ(std::string(invalid.what()).rfind("overrides: ", 0), 0u) << invalid.what();
    }
  }
}

Method with_count(Method method, int count) {
  method.specimens.count = count;
  return method;
}

/// The recorder writes the method that it reads in the order, and the physics steps it: to the last bit that of the
/// machine.
TEST(Order, HasTheWholeMethod) {
  for (const std::string& file : shipped_methods()) {
    const Method method = load_method(file);
    for (const int count : {1, 3}) {
      const Method read = method_of(order_of(method, "/out", {count, count}));
      EXPECT_EQ(read.name, method.name);
      EXPECT_EQ(read.specimens.count, count);
      EXPECT_EQ(method_yaml(read), method_yaml(with_count(method, count))) << file;
    }
  }
  const Method method = load_method(KNOT_UTM_SOURCE_DIR "/config/overhand.yaml");
  const Method read = method_of(order_of(method, "/out", {2, 3}));
  EXPECT_EQ(method_yaml(method_of_specimen(read, 2)), method_yaml(method_of_specimen(with_count(method, 3), 2)));
}

TEST(Order, OfAnotherMaterialIsForAnotherSpecimen) {
  const std::string file = KNOT_UTM_SOURCE_DIR "/config/straight.yaml";
  const TestOrder order = order_of(load_method(file), "/out", {});
  EXPECT_TRUE(order.same_specimen(order_of(load_method(file), "/elsewhere", {})));
  EXPECT_FALSE(order.same_specimen(order_of(load_method(file, {"material=polypropylene"}), "/out", {})));
  EXPECT_FALSE(order.same_specimen(order_of(load_method(file), "/out", {1, 2})));
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(MachineDescription, HasEveryFrameAndNoNumberThatIsNone) {
  for (const std::string& file : shipped_methods()) {
    const std::string urdf = machine_urdf(load_method(file), Vec3::Zero(), Vec3(0.0, 0.0, 0.25));
    EXPECT_EQ(count_of(urdf, "<link name="), 6u) << file;
    EXPECT_EQ(count_of(urdf, "<joint name="), 5u) << file;
    EXPECT_FALSE(std::regex_search(urdf, std::regex("nan|inf|(size|radius|length)=\"([^\"]* )?-"))) << urdf;
  }
}

}  // namespace
}  // namespace knot_utm
