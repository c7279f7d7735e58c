// One number has one value: what result.yaml says is what compare says of the curve and of the bag beside it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

#include "knot_utm/specimen/material.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

/// A loop that is tied, slides and locks in a second or two, with more to set.
class OneNumber : public OwnFolder {
 protected:
  static YAML::Node run(const std::vector<std::string>& more) {
    std::string arguments = "'" KNOT_UTM_SOURCE_DIR "/config/tighten.yaml' --quiet --out '" + folder() +
                            "' --set material=polypropylene --set physics.accuracy=draft";
    for (const std::string& key : more) arguments += " --set '" + key + "'";
    const Answer answer = answer_of(tool("tensile_test", arguments));
    EXPECT_EQ(answer.code, 0) << answer.text;
    return YAML::LoadFile(folder() + "/result.yaml");
  }

  static void expect_that_compare_says(const YAML::Node& result) {
    for (const char* file : {"/curve.csv", "/test.bag"}) {
      if (!std::filesystem::exists(folder() + file)) continue;  // without ROS there is no bag
      const std::string curve = "'" + folder() + file + "'";
      const Answer answer = answer_of(tool("compare", curve + " " + curve + " --yaml --tolerance 0"));
      ASSERT_EQ(answer.code, 0) << answer.text;
      const YAML::Node said = YAML::Load(answer.text);
      for (const char* key : {"peak_force", "plateau_force", "plateau_force_low", "plateau_force_high",
                              "plateau_force_slope", "breakaway_force", "largest_drop", "jump_force",
                              "force_after_jump", "lock_extension_by_load", "locked_stiffness"})
        EXPECT_EQ(said[key]["a"].as<std::string>(), result[key].as<std::string>()) << file << ": " << key;
    }
  }
};

constexpr const char* kWhole = "material.breaking_force=none";

TEST_F(OneNumber, OfABalancedCellWithoutErrors) {
  const YAML::Node result = run({kWhole});
  expect_that_compare_says(result);
  const double offset = result["balance_offset"].as<double>();
  EXPECT_GT(offset, 0.05);
  for (const std::string key : {"plateau_force", "breakaway_force", "peak_force"}) {
    const double load = result[key].as<double>();
    EXPECT_NEAR(result["true_" + key].as<double>(), load + offset, 1e-12 * load + 1e-12) << key;
  }
}

TEST_F(OneNumber, OfARodThatPartsBetweenTwoReadings) {
  const YAML::Node result = run({"material.breaking_force=1000"});
  EXPECT_EQ(result["ended_by"].as<std::string>(), "break");
  expect_that_compare_says(result);
  const double load = result["peak_force"].as<double>();
  EXPECT_NEAR(result["true_peak_force"].as<double>(), load + result["balance_offset"].as<double>(), 1e-12 * load);
}

}  // namespace
}  // namespace knot_utm
