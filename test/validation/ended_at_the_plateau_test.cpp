#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/study/batch.hpp"
#include "knot_utm/study/headless_run.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

Method shipped(const std::string& name, std::vector<std::string> overrides = {}) {
  overrides.emplace_back("physics.accuracy=draft");
  return load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/" + name + ".yaml", overrides);
}

class OfThePlateau : public OwnFolder {
 protected:
  OfThePlateau() {
    options.interrupted = [] { return false; };
  }

  /// Runs a test in a folder of this name.
  HeadlessOutcome run(const Method& method, const std::string& name, Readings readings) {
    options.folder = in(name);
    options.readings = readings;
    return run_headless(method, options);
  }
  std::string file(const std::string& name) const { return read_whole(in(name)); }

  HeadlessOptions options;
};

TEST_F(OfThePlateau, ATestEndsWithItAndHasTheBytesOfTheWholeTestUpToThere) {
  const Method method = shipped("tighten", {"material=polypropylene"});
  const HeadlessOutcome whole = run(method, "whole", Readings::kAll);
  options.shapes = true;
  const HeadlessOutcome early = run(method, "early", Readings::kPlateau);
  EXPECT_EQ(early.ended, EndedBy::kPlateau);
  EXPECT_FALSE(early.failed);
  EXPECT_EQ(file("whole/curve.csv").find(file("early/curve.csv")), 0u);
  EXPECT_LT(file("early/curve.csv").size(), file("whole/curve.csv").size());

  const YAML::Node found = YAML::Load(file("early/result.yaml")), all = YAML::Load(file("whole/result.yaml"));
  EXPECT_NEAR(found["plateau_force"].as<double>(), all["plateau_force"].as<double>(),
              0.5 * all["plateau_force_error"].as<double>());
  EXPECT_EQ(found["motion_pattern"].as<std::string>(), "sliding");
  for (const char* key : {"lock_extension", "locked_stiffness", "peak_force", "true_peak_force", "peak_force_error",
                          "largest_drop", "energy_to_peak", "chord_stiffness", "load_cell_error"})
    EXPECT_THAT(file("early/result.yaml"),
                HasSubstr(std::string("\n") + key + ": null  # the pull ended as soon as its plateau was settled\n"));
  EXPECT_THAT(file("early/result.yaml"), Not(HasSubstr("the knots still slid")));
  EXPECT_FALSE(fs::exists(in("early/shapes.csv")));
  EXPECT_TRUE(fs::exists(in("early/final_shape.csv")));
  EXPECT_EQ(options_of_run(in("early")), "--readings plateau");
  EXPECT_EQ(options_of_run(in("whole")), "");
}

TEST_F(OfThePlateau, ItsSamplesMakeTheSameResultAgain) {
  options.keep_shapes = true;
  run(shipped("tighten", {"material=polypropylene"}), "early", Readings::kPlateau);
  YAML::Node before = YAML::Load(file("early/result.yaml"));
  options.readings = Readings::kAll;
  results_from_samples(options);
  YAML::Node after = YAML::Load(file("early/result.yaml"));
  for (YAML::Node* result : {&before, &after}) result->remove("peak_memory");
  EXPECT_EQ(YAML::Dump(after), YAML::Dump(before));
}

TEST_F(OfThePlateau, ASpecimenOfABatchEndsWithIt) {
  BatchOptions batch;
  batch.folder = in("batch");
  batch.interrupted = options.interrupted;
  batch.readings = Readings::kPlateau;
  batch.jobs = 2;
  run_batch(shipped("tighten", {"material=polypropylene", "specimens={count: 2}"}), batch);
  for (const int number : {1, 2})
    EXPECT_THAT(read_whole(specimen_folder(batch.folder, number) + "/result.yaml"), HasSubstr("\nended_by: plateau\n"));
  EXPECT_EQ(YAML::Load(file("batch/statistics.yaml"))["plateau_force"]["n"].as<int>(), 2);
  EXPECT_EQ(options_of_run(batch.folder), "--readings plateau");
}

}  // namespace
}  // namespace knot_utm
