#include "knot_utm/run/run_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "knot_utm/contact/sampled_centreline.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/topology/knot_hole.hpp"
#include "knot_utm/verdict/result_yaml.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "machine/fake_bench.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

std::string text_of(const fs::path& file) {
  std::ostringstream all;
  all << std::ifstream(file).rdbuf();
  return all.str();
}

class RunFolder : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  void begin(const Method& method) {
    make_run_folder(folder_.string());
    begin_run_folder(folder_.string(), method);
  }

  /// A whole run of the method with a spring for a knot.
  RunFacts run(const Method& method, FakeBench bench = {}) {
    ProgramRunner program(method.program, method.machine.load_cell.sampling_rate, 0.1, {});
    begin(method);
    RunWriter writer(folder_.string(), method);
    run_test(bench, program, [&](const Command& command, const Sample& sample) {
      Record record;
      record.command = command;
      record.answer = sample;
      record.steps = bench.substeps;
      writer.add(record);
    });
    RunFacts facts = writer.facts();
    facts.reason = program.reason();
    facts.wall_time = 0.5;
    writer.finish(writer.results(program.ended_by()), facts, Points::Zero(3, 4));
    return facts;
  }

  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("knot_utm_run_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// Of the last shape, with the centreline by which its strands touch.
TEST_F(RunFolder, HoldsTheInnerDiameterOfAKnotThatIsWhole) {
  const Method method = load_method(kConfig + "overhand.yaml");
  const Points shape = knot_of(method.specimen).centreline(method.specimen, method.material, {}).points;
  begin(method);
  RunWriter writer(folder_.string(), method);
  Results results;
  const auto written = [&](const char* key) {
    writer.finish(results, writer.facts(), shape);
    return YAML::LoadFile((folder_ / "result.yaml").string())[key];
  };
  const auto comes_to = [&](Phase phase, double time) {
    Record record;
    record.answer.time = time;
    record.answer.phase = phase;
    record.steps = {record.answer};
    writer.add(record);
  };
  comes_to(Phase::kPull, 1.0);
  EXPECT_TRUE(written("knotability").IsNull()) << "nothing rests";
  comes_to(Phase::kHold, 2.0);
  const double hole = hole_diameter(sampled_centreline(shape), method.material.radius);
  EXPECT_GT(hole, 4.0 * method.material.radius);  // it is drawn loose
  EXPECT_EQ(written("knot_inner_diameter").as<double>(), hole);
  EXPECT_DOUBLE_EQ(written("knotability").as<double>(), hole / (2.0 * method.material.radius));
  results.break_place = BreakPlace::kStrand;
  EXPECT_TRUE(written("knotability").IsNull());
}

/// That result.yaml has every key of the table, ResultKeys says.
TEST_F(RunFolder, HoldsEveryPromisedFile) {
  run(load_method(kConfig + "tighten.yaml"));
  for (const char* file : {"curve.csv", "curve_full.csv", "result.yaml", "method.yaml", "final_shape.csv"}) {
    EXPECT_TRUE(fs::is_regular_file(folder_ / file)) << file;
  }
  const YAML::Node result = YAML::LoadFile((folder_ / "result.yaml").string());
  EXPECT_EQ(result["ended_by"].as<std::string>(), "extension");
  EXPECT_EQ(result["preload"].as<double>(), 150.0);
  EXPECT_TRUE(result["lock_extension"].IsNull());
  EXPECT_GT(result["peak_memory"].as<double>(), 1e5);
  EXPECT_DOUBLE_EQ(result["real_time_factor"].as<double>(), result["simulated_time"].as<double>() / 0.5);
}

TEST_F(RunFolder, CurveHasTheSamplingInstantsAndTheFullCurveEveryStep) {
  run(load_method(kConfig + "tighten.yaml"));
  const std::vector<CurveRow> curve = read_curve((folder_ / "curve.csv").string());
  std::size_t sampled = 0, balanced = 0;
  for (const CurveRow& row : curve) {
    if (row.phase == Phase::kBalance && row.time != static_cast<double>(sampled * 4) / 12.0)
      ++balanced;
    else
      EXPECT_EQ(row.time, static_cast<double>(sampled++ * 4) / 12.0);
  }
  EXPECT_EQ(balanced, 1u);
  const std::vector<CurveRow> full = read_curve((folder_ / "curve_full.csv").string());
  EXPECT_GE(full.size(), 8 * (sampled - 1) + 1);
  for (std::size_t i = 1; i < full.size(); ++i) EXPECT_GT(full[i].time, full[i - 1].time);
}

TEST_F(RunFolder, ItsMethodRunsAgainToTheSameBytes) {
  run(load_method(kConfig + "from_file.yaml"));
  const std::string curve = text_of(folder_ / "curve.csv");
  const std::string method = text_of(folder_ / "method.yaml");
  EXPECT_THAT(method, HasSubstr("file: specimen.csv"));
  run(load_method((folder_ / "method.yaml").string()));
  EXPECT_EQ(text_of(folder_ / "curve.csv"), curve);
  EXPECT_EQ(text_of(folder_ / "method.yaml"), method);
}

TEST_F(RunFolder, KeepsTheLogoOfItsReport) {
  fs::create_directories(folder_);
  const std::string logo = (folder_ / "ours.svg").string();
  std::ofstream(logo) << "<svg/>";
  run(load_method(kConfig + "straight.yaml", {"report.logo=" + logo}));
  const std::string method = text_of(folder_ / "method.yaml");
  EXPECT_THAT(method, HasSubstr("logo: logo.svg"));
  EXPECT_EQ(text_of(folder_ / "logo.svg"), "<svg/>");
  run(load_method((folder_ / "method.yaml").string()));
  EXPECT_EQ(text_of(folder_ / "method.yaml"), method);
}

TEST_F(RunFolder, HoldsTheVerdictOnItsSpecification) {
  const auto result = [this](const std::vector<std::string>& overrides) {
    run(load_method(kConfig + "straight.yaml", overrides));
    return YAML::LoadFile((folder_ / "result.yaml").string());
  };
  EXPECT_TRUE(result({})["specification_passed"].IsNull());
  EXPECT_TRUE(result({"specification.peak_force.min=0"})["specification_passed"].as<bool>());
  const YAML::Node failed = result({"specification={steps: {min: 1}, untangled_at: {max: 1}}"});
  EXPECT_FALSE(failed["specification_passed"].as<bool>());
  ASSERT_EQ(failed["specification_failed"].size(), 1u);
  EXPECT_EQ(failed["specification_failed"][0].as<std::string>(), "untangled_at has no value in this test");
}

TEST_F(RunFolder, ARunThatGaveUpKeepsWhatItHadAndTheReason) {
  FakeBench bench;
  bench.fail_time = 8.0;
  run(load_method(kConfig + "tighten.yaml"), bench);
  const YAML::Node result = YAML::LoadFile((folder_ / "result.yaml").string());
  EXPECT_EQ(result["ended_by"].as<std::string>(), "solver");
  EXPECT_THAT(result["reason"].as<std::string>(), HasSubstr("converged"));
  EXPECT_GT(read_curve((folder_ / "curve.csv").string()).size(), 20u);
}

TEST_F(RunFolder, AnUnfinishedRunHasNoResultOfAnEarlierOne) {
  const Method method = load_method(kConfig + "straight.yaml");
  run(method);
  EXPECT_TRUE(fs::exists(folder_ / "result.yaml"));
  begin(method);
  EXPECT_FALSE(fs::exists(folder_ / "result.yaml"));
  EXPECT_FALSE(fs::exists(folder_ / "final_shape.csv"));
}

TEST_F(RunFolder, ARunMayTestTheShapeThatTheLastOneLeftThere) {
  fs::create_directories(folder_);
  const std::string shape = "x,y,z\nm,m,m\n0,0,0\n0,0,0.1\n0,0,0.2\n0,0,0.3\n";
  std::ofstream(folder_ / "final_shape.csv") << shape;
  Method method = load_method(kConfig + "from_file.yaml");
  method.specimen.file = (folder_ / "final_shape.csv").string();
  begin(method);
  EXPECT_EQ(text_of(folder_ / "specimen.csv"), shape);
  EXPECT_FALSE(fs::exists(folder_ / "final_shape.csv"));
}

TEST_F(RunFolder, AFileWhereTheFolderShouldBe) {
  std::ofstream(folder_.string()) << "x";
  EXPECT_THROW(begin(load_method(kConfig + "straight.yaml")), InvalidInput);
}

TEST(ResultYaml, TextsAreQuotedOnOneLine) {
  RunFacts facts;
  facts.reason = "a \"quoted\"\nreason: with # signs";
  facts.warnings = {"one", "two, three"};
  const YAML::Node result = YAML::Load(result_yaml(Results(), facts));
  EXPECT_EQ(result["reason"].as<std::string>(), "a \"quoted\" reason: with # signs");
  EXPECT_EQ(result["warnings"][1].as<std::string>(), "two, three");
}

TEST(ResultYaml, WarnsOfWhatTheResultsShow) {
  Results results;
  results.not_equilibrated = "not equilibrated: the fastest node still moved";
  results.knot_type = KnotType::kCrossed;
  results.untangled_at = 12.5;
  results.curve.jump_force = 1.25;
  results.curve.jump_extension = 0.0123456;
  results.curve.force_after_jump = 0.1;
  results.roller_touched_at = 0.05;
  results.max_penetration = 0.06;
  results.energy_balance_error = 0.02;
  RunFacts facts;
  facts.warnings = {"of the run"};
  const YAML::Node result = YAML::Load(result_yaml(results, facts));
  const std::vector<std::string> warnings = result["warnings"].as<std::vector<std::string>>();
  EXPECT_THAT(warnings, ::testing::ElementsAre(
                            HasSubstr("through itself at 12.5 s"), HasSubstr("0.06 radii"), HasSubstr("differ by 0.02"),
                            HasSubstr("jumped open at an extension of 0.0123 m: the load went from "
                                      "1.25 N to 0.1 N"),
                            HasSubstr("a roller bore on a knot or its tail from an extension of 0.05 m"), "of the run",
                            HasSubstr("still moved")));
  EXPECT_FALSE(result["knot_type_preserved"].as<bool>());
  EXPECT_TRUE(result["not_equilibrated"].as<bool>());
}

TEST(ResultYaml, SaysOfANullWhy) {
  Results results;
  results.true_peak_force = 9.0;
  results.motion_pattern = MotionPattern::kSliding;
  results.curve.no_plateau = "the load is not level";
  RunFacts facts;
  facts.errors = {0.1, 0.1, 0.1};
  const std::string yaml = result_yaml(results, facts);
  for (const char* line :
       {"plateau_force: null  # see no_plateau_because\n", "no_plateau_because: \"the load is not level\"\n",
        "lock_extension: null  # the knots still slid at the end of the pull\n",
        "lock_extension_error: null  # the knots still slid at the end of the pull\n",
        "break_extension: null  # the rod did not break\n", "jump_force: null  # no knot jumped open\n",
        "hysteresis: null  # no cycle was closed\n", "reason: null\n"})
    EXPECT_THAT(yaml, HasSubstr(line));
  EXPECT_THAT(result_yaml(Results(), facts), HasSubstr("peak_force: null  # nothing was pulled\n"));
}

/// What a convergence study says of a knot that holds is not said of one that jumped open.
TEST(ResultYaml, AKnotThatJumpedOpenHasNoErrors) {
  Results results;
  results.lock_extension = 0.05;
  results.curve.locked_stiffness = 1e5;
  RunFacts facts;
  facts.errors = {0.1, 0.1, 0.1};
  EXPECT_DOUBLE_EQ(YAML::Load(result_yaml(results, facts))["lock_extension_error"].as<double>(), 0.005);
  results.curve.jump_force = results.curve.jump_extension = results.curve.force_after_jump = 1.0;
  const std::string yaml = result_yaml(results, facts);
  for (const char* key : {"plateau_force_error", "lock_extension_error", "locked_stiffness_error"})
    EXPECT_THAT(yaml, HasSubstr(std::string(key) + ": null  # unknown: a knot jumped open"));
}

TEST(ResultYaml, AKnotThatOpenedAsTheLoopWasMountedSaysWhyItHasNeitherLockNorStiffness) {
  Results results;
  results.motion_pattern = MotionPattern::kSliding;
  results.true_peak_force = 100.0;
  results.opened_when_mounted = 0.012;
  const std::string yaml = result_yaml(results, RunFacts());
  for (const char* key : {"lock_extension", "locked_stiffness"})
    EXPECT_THAT(yaml, HasSubstr(std::string(key) + ": null  # a knot opened as the loop was mounted\n"));
}

/// Beside what mesh and tolerances move, which is all that a convergence study tells.
TEST(ResultYaml, WhatSpeedTakesOfTheForceIsInTheErrorsOfForces) {
  Results results;
  results.true_plateau_force = 5.0;
  results.lock_extension = 0.05;
  results.curve.locked_stiffness = 1e5;
  results.rate.drag = 0.02;
  results.rate.inertia = 0.03;
  RunFacts facts;
  facts.errors = {0.1, 0.1, 0.1};
  facts.material.radius = facts.material.bending_stiffness = 1.0;  // a force of 1 N is one of closed knots
  const YAML::Node result = YAML::Load(result_yaml(results, facts));
  EXPECT_DOUBLE_EQ(result["plateau_force_error"].as<double>(), 0.15 * 5.0);
  EXPECT_DOUBLE_EQ(result["lock_extension_error"].as<double>(), 0.1 * 0.05);
  EXPECT_DOUBLE_EQ(result["locked_stiffness_error"].as<double>(), 0.15 * 1e5);
}

/// A lock 2 mm further out is 0.2 of the part, over which the stiffness grows by half; the part moves by twice as much.
TEST(ResultYaml, AStiffnessThatGrowsAlongTheCurveIsAsUnsureAsItsLock) {
  Results results;
  results.motion_pattern = MotionPattern::kSliding;
  results.lock_extension = 0.05;
  results.curve.locked_stiffness = 1e5;
  results.curve.locked = LockedPart{1e5, 5e4, 0.01, 30};
  RunFacts facts;
  facts.errors = {0.1, 0.04, 0.1};
  EXPECT_DOUBLE_EQ(YAML::Load(result_yaml(results, facts))["locked_stiffness_error"].as<double>(), (0.1 + 0.2) * 1e5);
  results.motion_pattern = MotionPattern::kStretching;
  results.lock_extension.reset();
  results.curve.locked = LockedPart{1e5, -5e4, 0.02, 30};
  EXPECT_DOUBLE_EQ(YAML::Load(result_yaml(results, facts))["locked_stiffness_error"].as<double>(), (0.1 + 0.15) * 1e5)
      << "three tenths of the part";
  results.curve.locked_stiffness = 0.0;
  results.curve.locked = LockedPart{0.0, 5e4, 0.02, 30};
  EXPECT_EQ(YAML::Load(result_yaml(results, facts))["locked_stiffness_error"].as<double>(), 0.0) << "a level load";
}

/// Straight lines of 1e5 N/m, drawn with 5 N of noise: 95 % of their slopes lie within the errors beside them.
TEST(ResultYaml, TheNoiseOfTheLoadCellIsInTheErrorOfAStiffness) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 5.0);
  RunFacts facts;
  facts.errors.locked_stiffness = 0.0;
  facts.load_cell.noise = 5.0;
  constexpr int kDraws = 400;
  int within = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Pull pull;
    for (int i = 0; i <= 200; ++i) pull.push_back({0.1 * i, 5e-5 * i, Sample::kNone, 5.0 * i + noise(random)});
    Results results;
    results.curve = curve_readings(pull, false);
    results.curve.locked->change = 0.0;  // which has an error of its own
    const double error = YAML::Load(result_yaml(results, facts))["locked_stiffness_error"].as<double>();
    within += std::abs(*results.curve.locked_stiffness - 1e5) <= error;
  }
  EXPECT_GT(within, 0.92 * kDraws);
  EXPECT_LT(within, 0.99 * kDraws);
}

/// Ctrl-C while the knots are tied finds them still far from where they will be.
TEST(Warnings, NothingIsSaidOfKnotsThatWereNotReleased) {
  Results results;
  results.tied_knot_distance = 0.0967;
  RunFacts facts;
  facts.knot_distance = 0.15;
  const auto said = [&] { return printed_warnings(results, facts); };
  EXPECT_THAT(said(), ::testing::Contains(HasSubstr("the knots moved as they were released")));
  results.ended_by = EndedBy::kOperator;
  EXPECT_THAT(said(), ::testing::Not(::testing::Contains(HasSubstr("the knots moved"))));
  results.true_peak_force = 1.0;
  EXPECT_THAT(said(), ::testing::Contains(HasSubstr("the knots moved as they were released")));
}

/// Without gravity a light loop slides as far.
TEST(Warnings, ALoopThatSlidAlongItsRollersIsTold) {
  Results results;
  RunFacts facts;
  facts.material.radius = 1e-3;
  facts.slid_along = 2.9e-3;
  EXPECT_THAT(printed_warnings(results, facts), ::testing::Not(::testing::Contains(HasSubstr("slid along the axes"))));
  facts.slid_along = 3.1e-3;
  EXPECT_THAT(printed_warnings(results, facts), ::testing::Contains(HasSubstr("slid along the axes")));
}

TEST(GravityWarnings, HoldTheWeightAgainstTheSlidingForceAndElseAgainstTheLargest) {
  Results results;
  results.true_peak_force = 30.0;
  RunFacts facts;
  facts.weight = 0.4;
  EXPECT_THAT(gravity_warnings(results, facts), ::testing::ElementsAre(HasSubstr("1.33 % of the largest force")));
  results.true_plateau_force = 4.0;
  EXPECT_THAT(gravity_warnings(results, facts), ::testing::ElementsAre(HasSubstr("10 % of the sliding force")));
  facts.weight = 0.03;
  EXPECT_THAT(gravity_warnings(results, facts), ::testing::IsEmpty());
}

TEST(ResultYaml, WarnsOfATestThatEndedBeforeAnythingWasPulled) {
  Results results;
  results.ended_by = EndedBy::kTravel;
  RunFacts facts;
  facts.reason = "mount: the grips meet";
  EXPECT_THAT(printed_warnings(results, facts),
              ::testing::ElementsAre("the test ended before anything was pulled: mount: the grips meet"));
  results.true_peak_force = 1.0;
  EXPECT_THAT(printed_warnings(results, facts), ::testing::IsEmpty());
}

/// Before all others: the rod is then not the one that was meant.
TEST(ResultYaml, ThePrintedWarningsHaveDeepContactsAndRodsThatCrossed) {
  Results results;
  EXPECT_THAT(printed_warnings(results, RunFacts()), ::testing::IsEmpty());
  results.max_penetration = 0.06;
  EXPECT_THAT(printed_warnings(results, RunFacts()),
              ::testing::ElementsAre(
                  "strands are pressed into each other by up to 0.06 radii, where a contact is right up to 0.05"));
  results.knot_type = KnotType::kCrossed;
  results.untangled_at = 3.0;
  EXPECT_THAT(printed_warnings(results, RunFacts()).front(), "the rod ran through itself at 3 s");
}

/// A free loop of the radius R bears 2 T R^2 = k_b: at 0.05 k_b/h^2 it is 3.16 h.
TEST(ResultYaml, WarnsOfAnOverhandThatWasNotPulledTight) {
  Results results;
  RunFacts facts;
  facts.one_knot_in_a_strand = true;
  facts.material.radius = 0.002;
  facts.material.bending_stiffness = 4e-6;  // k_b/h^2 is 1 N
  results.true_peak_force = 0.05;
  EXPECT_THAT(printed_warnings(results, facts),
              ::testing::ElementsAre(
                  HasSubstr("the pull ended while the knot was still loose: the largest force, 0.05 "
                            "N, leaves its loop a radius of about 3.16 radii of the rod, and more "
                            "with friction; it is tight from about 0.125 N on, to which a longer pull brings it")));
  results.true_peak_force = 0.13;
  EXPECT_THAT(printed_warnings(results, facts), ::testing::IsEmpty());
  results.true_peak_force = 0.05;
  results.knot_type = KnotType::kChanged;
  EXPECT_THAT(printed_warnings(results, facts), ::testing::IsEmpty()) << "there is no knot";
}

TEST(ResultYaml, OfOneKnotNothingIsSaidOfALockOfTwo) {
  Results results;
  results.true_peak_force = 1.0;
  const std::string yaml = result_yaml(results, RunFacts());
  EXPECT_THAT(yaml,
              HasSubstr("lock_extension: null  # only two knots that slide towards each other lock, and there are "
                        "none\n"));
  EXPECT_THAT(yaml, HasSubstr("locked_stiffness: null  # the load has no rise with three readings or more\n"));
}

TEST(ResultYaml, TellsOfAPullThatEndedBeforeTheKnotsLocked) {
  Results results;
  results.motion_pattern = MotionPattern::kSliding;
  results.true_plateau_force = 3.8;
  EXPECT_THAT(events(results), ::testing::ElementsAre(HasSubstr("the pull ended while the knots still slid")));
  results.lock_extension = 0.08;
  EXPECT_THAT(events(results), ::testing::IsEmpty());
}

/// Its lock is known from how the knots move.
TEST(ResultYaml, AStiffnessOfTooFewReadingsIsNoneAndSaysSo) {
  Results results;
  results.motion_pattern = MotionPattern::kSliding;
  results.true_peak_force = 100.0;
  results.lock_extension = results.curve.rises_at = 0.05;
  EXPECT_THAT(result_yaml(results, RunFacts()),
              HasSubstr("locked_stiffness: null  # the load was read fewer than three times between the lock and the "
                        "peak\n"));
  results.curve.rises_at.reset();
  EXPECT_THAT(result_yaml(results, RunFacts()),
              HasSubstr("locked_stiffness: null  # the lock does not show in the load\n"));
  results.curve.rises_at = 0.05;
  results.motion_pattern = MotionPattern::kUntangling;
  results.untangled_at = 3.0;
  EXPECT_THAT(result_yaml(results, RunFacts()), HasSubstr("locked_stiffness: null  # the knot came undone\n"));
}

/// Locks are studied that the knots have come to.
TEST(ResultYaml, AStiffnessReadWhileTheKnotsStillSlideHasNoError) {
  Results results;
  results.motion_pattern = MotionPattern::kSliding;
  results.true_peak_force = 56.0;
  results.curve.lock_extension_by_load = 0.0847;
  results.curve.locked_stiffness = 1.9e4;
  RunFacts facts;
  facts.errors = {0.1, 0.1, 0.1};
  EXPECT_THAT(result_yaml(results, facts),
              HasSubstr("locked_stiffness_error: null  # the knots still slid at the end of the pull\n"));
  results.lock_extension = 0.085;
  EXPECT_DOUBLE_EQ(YAML::Load(result_yaml(results, facts))["locked_stiffness_error"].as<double>(), 1.9e3);
}

TEST(ResultYaml, SaysHowFarTheLoadCellMayBeOff) {
  Results results;
  results.true_peak_force = 2000.0;
  results.true_plateau_force = 6.0;
  RunFacts facts;
  YAML::Node result = YAML::Load(result_yaml(results, facts));
  EXPECT_TRUE(result["load_cell_error"].IsNull());
  EXPECT_TRUE(result["plateau_load_cell_error"].IsNull());
  EXPECT_EQ(result["warnings"].size(), 0u);
  facts.load_cell.capacity = 1000.0;
  facts.load_cell.accuracy = 0.005;
  facts.load_cell.floor = 0.01;
  facts.load_cell.overload = 1.5;
  result = YAML::Load(result_yaml(results, facts));
  EXPECT_DOUBLE_EQ(result["load_cell_error"].as<double>(), 0.005 * 2000.0);
  EXPECT_DOUBLE_EQ(result["plateau_load_cell_error"].as<double>(), 0.01 * 1000.0);
  EXPECT_THAT(
      result["warnings"].as<std::vector<std::string>>(),
      ::testing::ElementsAre("the plateau force lies below the load cell's floor of 10 N",
                             "the load cell was overloaded: above 1500 N it reads the force at its mechanical stop"));
  results.true_peak_force = 9.0;
  EXPECT_THAT(result_yaml(results, facts), HasSubstr("the peak force lies below"));
}

}  // namespace
}  // namespace knot_utm
