// A loop that was much stretched while it was tied is put on its rollers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/specimen/material.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

class Mounting : public OwnFolder {};

/// A run of config/studies/pattern_map.yaml, of a rod nearly as soft as a solid one that was stretched by 70 %: once
/// released its loop lies across the places of the rollers. They cut into it, the load rose to 1e10 N, and the solver
/// gave up or the rod parted before it was pulled.
TEST_F(Mounting, OfALoopThatLiesAcrossARollersPlaceHasNoLoad) {
  const Answer answer = answer_of(tool(
      "tensile_test",
      "tighten --quiet --out '" + folder() +
          "' --set physics.accuracy=draft --set specimen.knot_distance=0.0526 --set specimen.preload=7.02 "
          "--set 'material={radius: 0.001, density: 1000, bending_stiffness: 1e-6, twisting_stiffness: 1e-6, "
          "stretching_stiffness: 9.794, breaking_force: 600, friction_coefficient: 0.3363, friction_couple: 0}' "
          "--set 'program=[{tie: {}}, {release: {duration: 3}}, {mount: {}}, {pull: {until: {extension: 0.001}}}]'"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  const YAML::Node result = YAML::LoadFile(in("result.yaml"));
  EXPECT_EQ(result["ended_by"].as<std::string>(), "extension");
  EXPECT_TRUE(result["knot_type_preserved"].as<bool>());
  EXPECT_TRUE(result["break_extension"].IsNull());
  EXPECT_GT(result["true_peak_force"].as<double>(), 0.0);
  EXPECT_LT(result["true_peak_force"].as<double>(), 2.0) << "k_b/h^2 is 1 N";
}

/// As they are let go nylon's knots lie a tenth of e too far apart.
TEST_F(Mounting, SetsTheKnotsToTheirMarks) {
  const Answer answer = answer_of(
      tool("tensile_test", "tighten --quiet --out '" + folder() +
                               "' --set physics.accuracy=draft "
                               "--set 'program=[{tie: {}}, {release: {duration: 3}}, {mount: {}}, {balance: {}}, "
                               "{pull: {until: {extension: 0.001}}}]'"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  const YAML::Node result = YAML::LoadFile(in("result.yaml"));
  EXPECT_NEAR(result["knot_distance"].as<double>(), 0.15, 0.0015);
  EXPECT_NEAR(result["gauge_length"].as<double>(), 0.25, 0.0025);
  EXPECT_GT(result["tied_knot_distance"].as<double>(), 0.155) << "before";
  EXPECT_TRUE(result["opened_when_mounted"].IsNull());
}

/// Edges are laid longer, and the step that follows brings them to rest. Between these two this rod parted, and its
/// tension was read as 1,463 N where it bears 0.2 N.
TEST_F(Mounting, ReadsAndPartsNoEdgesThatAreLaidButNotSolved) {
  const Answer answer = answer_of(
      tool("tensile_test", "tighten --quiet --shapes --out '" + folder() +
                               "' --set physics.accuracy=draft --set specimen.preload=20 --set specimen.tail=0.038 "
                               "--set material.friction_coefficient=0.15 "
                               "--set 'program=[{tie: {}}, {release: {duration: 3}}, {mount: {}}]'"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  std::istringstream curve(read_whole(in("curve.csv"))), shapes(read_whole(in("shapes.csv")));
  std::string line;
  double mounted = 0.0;
  while (mounted == 0.0 && std::getline(curve, line))
    if (line.find(",mount") != std::string::npos) mounted = std::stod(line);
  int seen = 0;
  while (std::getline(shapes, line)) {
    double time = 0.0, tension = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%*d,%*f,%*f,%*f,%lf", &time, &tension) < 2 || time <= mounted) continue;
    if (std::isnan(tension)) continue;  // no edge begins at the last node
    EXPECT_LT(std::abs(tension), 0.5) << "at " << time << " s";
    ++seen;
  }
  EXPECT_GT(seen, 1000);
}

/// Coils of 3.5 radii reach into the strands that would become longer. The rod parted as it was mounted, at 6.7 kN.
TEST_F(Mounting, LeavesOpenCoilsWhereTheyAre) {
  const Answer answer = answer_of(
      tool("tensile_test", "tighten --quiet --out '" + folder() +
                               "' --set physics.accuracy=draft --set material=polypropylene --set specimen.preload=3.5 "
                               "--set 'program=[{tie: {}}, {release: {duration: 3}}, {mount: {}}, {balance: {}}, "
                               "{pull: {until: {extension: 0.001}}}]'"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, testing::HasSubstr("as the pull begins, instead of 0.15 m (specimen.knot_distance)"));
  EXPECT_LT(YAML::LoadFile(in("result.yaml"))["true_peak_force"].as<double>(), 12.0) << "k_b/h^2 is 11.7 N";
}

/// A loop that is tied, slides and locks in a second or two, with more to set.
class OneNumber : public OwnFolder {
 protected:
  static YAML::Node run(const std::vector<std::string>& more) {
    std::string arguments = "'" KNOT_UTM_SOURCE_DIR "/config/tighten.yaml' --quiet --out '" + folder() +
                            "' --set material=polypropylene --set physics.accuracy=draft";
    if (std::filesystem::exists(KNOT_UTM_TOOLS_DIR "/write_curve_bag")) arguments += " --bag";  // built with ROS
    for (const std::string& key : more) arguments += " --set '" + key + "'";
    const Answer answer = answer_of(tool("tensile_test", arguments));
    EXPECT_EQ(answer.code, 0) << answer.text;
    return YAML::LoadFile(in("result.yaml"));
  }

  static void expect_that_compare_says(const YAML::Node& result) {
    for (const char* file : {"/curve.csv", "/test.bag"}) {
      if (!std::filesystem::exists(folder() + file)) continue;
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
