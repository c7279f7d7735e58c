#include "knot_utm/study/batch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "knot_utm/analysis/statistics.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

class Batch : public OwnFolder {
 protected:
  Batch() {
    options.folder = folder() + "/batch";
    options.interrupted = [] { return false; };
    options.notice = [&](const std::string& line) { said += line + "\n"; };
  }

  std::string written(const char* file) const { return read_whole(options.folder + "/" + file); }
  YAML::Node statistics() const { return YAML::Load(written("statistics.yaml")); }

  /// Rods that are pulled within milliseconds, of different stiffness.
  const Method method = load_method(kConfig + "straight.yaml",
                                    {"specimens={count: 5, scatter: {material.stretching_stiffness: {normal: 0.1}}}"});
  BatchOptions options;
  std::string said;
};

TEST_F(Batch, LeavesTheSameBytesHoweverManyAreTestedSideBySide) {
  std::vector<std::string> all;
  for (const int jobs : {1, 3, 8}) {
    options.folder = folder() + "/jobs_" + std::to_string(jobs);
    options.jobs = jobs;
    const BatchOutcome outcome = run_batch(method, options);
    EXPECT_FALSE(outcome.interrupted);
    EXPECT_TRUE(outcome.rejected.empty());
    std::string bytes = written("statistics.yaml") + written("specimens.csv");
    for (int k = 1; k <= 5; ++k) bytes += read_whole(specimen_folder(options.folder, k) + "/curve_full.csv");
    all.push_back(bytes);
  }
  EXPECT_EQ(all[0], all[1]);
  EXPECT_EQ(all[0], all[2]);
}

/// A rod's stiffness is proportional to k_s: the statistics are those of what was drawn, but for the solver's residual.
TEST_F(Batch, StatisticsAreThoseOfTheSpecimens) {
  run_batch(method, options);
  std::vector<double> stiffness;
  for (const DrawnSpecimen& specimen : draw_specimens(method)) stiffness.push_back(specimen.drawn[0].second);
  const Statistics drawn = statistics_of(stiffness);
  const YAML::Node chord = statistics()["chord_stiffness"];
  EXPECT_EQ(chord["n"].as<int>(), 5);
  EXPECT_NEAR(chord["cv"].as<double>(), *drawn.cv, 1e-3 * *drawn.cv);
  EXPECT_NEAR(chord["maximum"].as<double>() / chord["minimum"].as<double>(), *drawn.maximum / *drawn.minimum, 1e-3);
  EXPECT_LT(chord["low"].as<double>(), chord["mean"].as<double>());
  EXPECT_FALSE(statistics()["wall_time"].IsDefined()) << "of the computer, not of a specimen";
}

TEST_F(Batch, InterruptedAndResumedItLeavesTheSameStatistics) {
  run_batch(method, options);
  const std::string whole = written("statistics.yaml") + written("specimens.csv");
  options.folder += "_interrupted";
  std::atomic<int> ended{0};
  std::atomic<int> asked{0};
  options.progress = [&](int count, int) { ended = count; };
  options.interrupted = [&] { return ended >= 2 && ++asked > 3; };  // amid the third
  const BatchOutcome cut_off = run_batch(method, options);
  EXPECT_TRUE(cut_off.interrupted);
  EXPECT_FALSE(fs::exists(options.folder + "/statistics.yaml"));
  EXPECT_TRUE(has_complete_result(specimen_folder(options.folder, 2)));
  EXPECT_FALSE(has_complete_result(specimen_folder(options.folder, 5)));
  const fs::file_time_type first = fs::last_write_time(specimen_folder(options.folder, 1) + "/curve.csv");

  options.interrupted = [] { return false; };
  options.resume = true;
  const Method again = load_method(options.folder + "/method.yaml");
  EXPECT_FALSE(run_batch(again, options).interrupted);
  EXPECT_EQ(written("statistics.yaml") + written("specimens.csv"), whole);
  EXPECT_EQ(fs::last_write_time(specimen_folder(options.folder, 1) + "/curve.csv"), first) << "was tested twice";
  EXPECT_THROW(run_batch(again, options), InvalidInput) << "there is nothing to resume";
}

TEST_F(Batch, AnotherOneGoesToAFolderOfItsOwn) {
  run_batch(method, options);
  const std::string first = written("statistics.yaml");
  EXPECT_EQ(run_batch(method, options).folder, options.folder + "-2");
  EXPECT_EQ(written("statistics.yaml"), first);
  EXPECT_THAT(said, HasSubstr("holds a run already"));
  // Also where there is but a specimen of one.
  options.folder = folder() + "/other";
  fs::create_directories(specimen_folder(options.folder, 1));
  std::ofstream(specimen_folder(options.folder, 1) + "/result.yaml") << "ended_by: break\n";
  EXPECT_EQ(run_batch(method, options).folder, options.folder + "-2");
}

TEST_F(Batch, SpecimensThatFailAreRejectedAndTheirReadingsLeftOut) {
  // Hardly tied and slippery, the knots open as they are released.
  const Method slippery =
      load_method(kConfig + "tighten.yaml", {"physics.accuracy=draft", "specimen.preload=1",
                                             "material.friction_coefficient=0", "specimens={count: 2, scatter: none}"});
  const BatchOutcome outcome = run_batch(slippery, options);
  ASSERT_EQ(outcome.rejected.size(), 2u);
  EXPECT_EQ(outcome.rejected[0].specimen, 1);
  EXPECT_THAT(outcome.rejected[0].reason, HasSubstr("came undone before it was pulled"));
  EXPECT_EQ(statistics()["rejected"].size(), 2u);
  EXPECT_EQ(statistics()["peak_force"]["n"].as<int>(), 0);
}

/// Under its weight, in a hold.
TEST_F(Batch, ARodThatPartsBeforeItIsLoadedIsRejectedAndOneThatIsOnlyHeldCounts) {
  const auto rejected = [&](const std::string& program) {
    return run_batch(load_method(kConfig + "straight.yaml",
                                 {"material.breaking_force=0.02", "physics.gravity=[0, 0, -9.81]",
                                  "program=[" + program + "]", "specimens={count: 2, scatter: none}"}),
                     options)
        .rejected;
  };
  EXPECT_EQ(rejected("{hold: {duration: 1}}").size(), 0u);
  const auto early = rejected("{hold: {duration: 1}}, {pull: {until: {extension: 0.01}}}");
  ASSERT_EQ(early.size(), 2u);
  EXPECT_THAT(early[0].reason, testing::EndsWith("before it was pulled"));
}

/// Tests that end before they come to their extension: what is known of all is said once and before them.
TEST_F(Batch, WhatIsKnownBeforehandIsToldOnceForAll) {
  run_batch(load_method(kConfig + "straight.yaml",
                        {"specimens={count: 3, scatter: {material.stretching_stiffness: {normal: 0.1}}}",
                         "program=[{pull: {until: {extension: 0.001}}}]", "material.density=100"}),
            options);
  EXPECT_EQ(said.find("material.density is 100 kg/m3"), 0u) << said;
  EXPECT_EQ(said.find("is it in kg/m3"), said.rfind("is it in kg/m3")) << said;
}

TEST_F(Batch, WarningsThatDifferByTheirNumbersAloneAreToldOnce) {
  run_batch(load_method(kConfig + "straight.yaml",
                        {"specimens={count: 3, scatter: {material.stretching_stiffness: {normal: 0.1}}}",
                         "program=[{pull: {until: {extension: 0.001}}}, {return: {extension: -0.001}}]"}),
            options);
  EXPECT_THAT(said, HasSubstr("specimens 1, 2 and 3, with the numbers of specimen 1: the strand bore a thrust of "));
  EXPECT_EQ(said.find("bore a thrust"), said.rfind("bore a thrust")) << said;
}

}  // namespace
}  // namespace knot_utm
