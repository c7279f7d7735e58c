// What result.yaml and the console say of results.
#include "knot_utm/verdict/result_keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "knot_utm/record/sample.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "run/command.hpp"

namespace knot_utm {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Results, the facts beside them, and what is said of both.
struct Told : testing::Test {
  Results results;
  RunFacts facts;

  Told() {
    results.motion_pattern = MotionPattern::kSliding;
    results.true_peak_force = 10.0;
  }
  std::string yaml() const { return result_yaml(results, facts); }
  YAML::Node operator[](const char* key) const { return YAML::Load(yaml())[key]; }
  double number(const char* key) const { return (*this)[key].as<double>(); }
  std::vector<std::string> printed() const { return printed_warnings(results, facts); }
  std::vector<std::string> warnings() const { return all_warnings(results, facts); }
  /// Whether a line begins so.
  testing::AssertionResult says(const std::string& line) const {
    if (("\n" + yaml()).find("\n" + line) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "it says " << (*this)[line.substr(0, line.find(':')).c_str()];
  }
};
using ResultYaml = Told;
using Warnings = Told;

TEST(ResultKeys, StandInResultYamlInTheirOrder) {
  std::vector<std::string> written, known;
  for (const auto& line : YAML::Load(result_yaml(Results(), RunFacts()))) written.push_back(line.first.Scalar());
  for (const ResultKey& key : result_keys()) known.emplace_back(key.name);
  EXPECT_EQ(written, known);
}

TEST(ResultKeys, AreWrittenOnceInAPlaceOfTheReportAndSayWhatTheyAre) {
  const std::set<std::string> places{result_place::kHead, result_place::kBeside, result_place::kCertificate};
  std::set<std::string> seen;
  std::map<std::string, int> tables;
  for (const ResultKey& key : result_keys()) {
    EXPECT_TRUE(seen.insert(key.name).second) << key.name;
    EXPECT_STRNE(key.unit, "") << key.name;
    EXPECT_STRNE(key.meaning, "") << key.name;
    EXPECT_EQ(key.table() == 0, places.count(key.group) == 1) << key.name;
    EXPECT_EQ(tables.emplace(key.group, key.table()).first->second, key.table()) << key.name;
  }
}

/// A load behind a lock depends on where the lock is, one at which a knot breaks on friction; of other kinds nothing is
/// known, and words say so.
TEST_F(ResultYaml, SaysHowFarThePeakMayBeOff) {
  results.motion_pattern = MotionPattern::kNone;
  results.true_peak_force.reset();
  EXPECT_TRUE(says("peak_force_error: null  # nothing was pulled"));
  results.true_peak_force = results.curve.peak_force = 1000.0;
  EXPECT_TRUE(says("peak_force_error: null  # unknown: no convergence study covers this case"));
  facts.errors = {0.05, 0.01, 0.02};
  results.motion_pattern = MotionPattern::kSliding;
  EXPECT_TRUE(says("peak_force_error: 50\n")) << "it still slides";
  results.lock_extension = 0.1;
  results.curve.locked_stiffness = 2e4;
  EXPECT_TRUE(says("peak_force_error: 40\n"));
  results.break_extension = 0.15;
  EXPECT_TRUE(says("peak_force_error: 20\n"));
  results.break_place = BreakPlace::kStrand;
  facts.material.breaking_force = 500.0;
  facts.strands = 2;
  EXPECT_TRUE(says("peak_force_error: 2\n")) << "the load at which it parts was given";
  results.break_place = BreakPlace::kKnot;
  EXPECT_TRUE(says("peak_force_error: 50\n"));
  results.motion_pattern = MotionPattern::kUntangling;
  EXPECT_TRUE(says("peak_force_error: null  # unknown: no convergence study covers this case"));
}

/// At high speed the last step passes the strength that was given: 133 N where 100 N were.
TEST_F(ResultYaml, SaysThatAFastBreakIsOffByWhatPassesTheStrength) {
  results.break_place = BreakPlace::kStrand;
  facts.material.breaking_force = 100.0;
  for (const double reached : {100.05, 133.0}) {
    results.true_peak_force = results.curve.peak_force = reached;
    EXPECT_NEAR(number("peak_force_error") / reached, reached < 101.0 ? 2e-3 : 0.33, 1e-9);
  }
}

/// Where strands roll they were studied: plateau and lock have larger errors, the stiffness has none.
TEST_F(ResultYaml, HasLargerErrorsOfHardlyClosedKnotsWhoseStrandsRoll) {
  facts.material.radius = 1e-3;
  facts.material.bending_stiffness = 1e-6;
  facts.errors = {0.05, 0.01, 0.02, true};
  results.lock_extension = 0.1;
  results.curve.locked_stiffness = 7.0;
  for (const double force : {0.2, 0.1}) {
    const bool closed = force > 0.15;
    results.curve.plateau_force = results.true_plateau_force = force;
    EXPECT_NEAR(number("plateau_force_error"), (closed ? 0.05 : 0.1) * force, 1e-12);
    EXPECT_NEAR(number("lock_extension_error"), closed ? 1e-3 : 2e-3, 1e-12);
    EXPECT_EQ(static_cast<bool>(says("locked_stiffness_error: null  # unknown: the knots were hardly closed")),
              !closed);
  }
}

TEST_F(ResultYaml, SaysTheForceOverTheDeadLoadAtTheOtherEnd) {
  results.steady_force = 12.0;
  EXPECT_TRUE(says("force_ratio: null  # no dead load"));
  facts.dead_load = 8.0;
  EXPECT_TRUE(says("force_ratio: 1.5\n"));
  facts.dead_load = 16.0;
  EXPECT_TRUE(says("force_ratio: null  # the strand does not slide"));
  results.steady_force.reset();
  EXPECT_TRUE(says("force_ratio: null  # the force is not steady"));
  results.break_extension = 0.1;
  EXPECT_TRUE(says("force_ratio: null  # the rod broke"));
  results.true_peak_force.reset();
  EXPECT_TRUE(says("force_ratio: null  # "));
}

/// Of a loop two strands bear the load.
TEST_F(ResultYaml, SaysHowMuchOfItsStrengthAKnotLeaves) {
  EXPECT_TRUE(says("knot_efficiency: null  # there is no knot"));
  facts.may_hold_a_knot = true;
  results.true_peak_force = 64.0;
  facts.material.stretching_stiffness = 1024.0;
  facts.material.breaking_force = 128.0;
  facts.material.breaking.law = static_cast<BreakingLaw>(1);
  facts.material.breaking.set("bending_share", 0.5);
  EXPECT_TRUE(says("knot_efficiency: null  # the rod did not break"));
  results.break_extension = 0.1;
  EXPECT_TRUE(says("knot_efficiency: 0.5\n"));
  EXPECT_TRUE(says("knot_efficiency_error: null  # "));
  facts.errors.break_in_bend = 0.04;
  EXPECT_TRUE(says("knot_efficiency_error: 0.02\n"));
  facts.strands = 2;
  EXPECT_TRUE(says("knot_efficiency: 0.25\n"));
  facts.material.breaking.law = static_cast<BreakingLaw>(0);  // whose force is reached as in a straight rod
  EXPECT_TRUE(says("knot_efficiency: null  # not predicted: "));
}

/// A rope that bears more than it was tied with nearly locks, and the mesh may decide whether it slips or parts.
TEST_F(ResultYaml, HasAnErrorOfTheLargestLoadOfAKnotFromAFileUnlessARopeNearlyLocks) {
  results.true_peak_force = 32.0;
  facts.errors.largest_load = 0.125;
  facts.preload = 64.0;
  facts.material.radius = 1e-3;
  facts.material.bending_stiffness = 1e-4;
  facts.material.stretching_stiffness = 1e6;
  EXPECT_TRUE(says("peak_force_error: 4\n"));
  facts.preload = 16.0;
  EXPECT_TRUE(says("peak_force_error: null  # "));
  facts.material.stretching_stiffness = 400.0;
  EXPECT_TRUE(says("peak_force_error: 4\n")) << "of a solid rod";
}

/// Beside what mesh and tolerances move, which is all that a convergence study tells.
TEST_F(ResultYaml, WhatSpeedTakesOfTheForceIsInTheErrorsOfForces) {
  results.true_plateau_force = 5.0;
  results.lock_extension = 0.05;
  results.curve.locked_stiffness = 1e5;
  results.rate.drag = 0.02;
  results.rate.inertia = 0.03;
  facts.errors = {0.1, 0.1, 0.1};
  facts.material.radius = facts.material.bending_stiffness = 1.0;  // a force of 1 N is one of closed knots
  EXPECT_DOUBLE_EQ(number("plateau_force_error"), 0.15 * 5.0);
  EXPECT_DOUBLE_EQ(number("lock_extension_error"), 0.1 * 0.05);
  EXPECT_DOUBLE_EQ(number("locked_stiffness_error"), 0.15 * 1e5);
}

/// A lock 2 mm further out is 0.2 of the part, over which the stiffness grows by half; the part moves by twice as much.
TEST_F(ResultYaml, AStiffnessThatGrowsAlongTheCurveIsAsUnsureAsItsLock) {
  results.lock_extension = 0.05;
  results.curve.locked_stiffness = 1e5;
  results.curve.locked = LockedPart{1e5, 5e4, 0.01, 30};
  facts.errors = {0.1, 0.04, 0.1};
  EXPECT_DOUBLE_EQ(number("locked_stiffness_error"), (0.1 + 0.2) * 1e5);
  results.motion_pattern = MotionPattern::kStretching;
  results.lock_extension.reset();
  results.curve.locked = LockedPart{1e5, -5e4, 0.02, 30};
  EXPECT_DOUBLE_EQ(number("locked_stiffness_error"), (0.1 + 0.15) * 1e5) << "three tenths of the part";
  results.curve.locked_stiffness = 0.0;
  results.curve.locked = LockedPart{0.0, 5e4, 0.02, 30};
  EXPECT_EQ(number("locked_stiffness_error"), 0.0) << "a level load";
}

/// Straight lines of 1e5 N/m, drawn with 5 N of noise: 95 % of their slopes lie within the errors beside them.
TEST_F(ResultYaml, TheNoiseOfTheLoadCellIsInTheErrorOfAStiffness) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 5.0);
  facts.errors.locked_stiffness = 0.0;
  facts.load_cell.noise = 5.0;
  constexpr int kDraws = 400;
  int within = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Pull pull;
    for (int i = 0; i <= 200; ++i) pull.push_back({0.1 * i, 5e-5 * i, Sample::kNone, 5.0 * i + noise(random)});
    results = Results();
    results.curve = curve_readings(pull, false);
    results.curve.locked->change = 0.0;  // which has an error of its own
    within += std::abs(*results.curve.locked_stiffness - 1e5) <= *known_errors(results, facts).locked_stiffness;
  }
  EXPECT_GT(within, 0.92 * kDraws);
  EXPECT_LT(within, 0.99 * kDraws);
}

/// A pull that ended as its plateau was settled has no peak, and nobody expected a lock of it.
TEST_F(ResultYaml, LeavesOutWhatTheRestOfAPullWouldTell) {
  results.ended_by = EndedBy::kPlateau;
  results.curve.plateau_force = results.true_plateau_force = 9.0;
  facts.errors = {0.05, 0.01, 0.02};
  EXPECT_TRUE(says("ended_by: plateau\n"));
  EXPECT_TRUE(says("plateau_force_error: 0.45"));
  for (const char* key :
       {"lock_extension", "lock_extension_error", "locked_stiffness", "locked_stiffness_error", "peak_force",
        "peak_force_error", "true_peak_force", "largest_drop", "energy_to_peak", "secant_stiffness", "load_cell_error"})
    EXPECT_TRUE(says(key + std::string(": null  # the pull ended as soon as its plateau was settled\n")));
  EXPECT_THAT(printed(), IsEmpty());
}

/// Deep contacts and rods that crossed come first: the rod is then not the one that was meant.
TEST_F(Warnings, SayWhatTheResultsShow) {
  EXPECT_THAT(printed(), IsEmpty());
  results.not_equilibrated = "not equilibrated: the fastest node still moved";
  results.knot_type = KnotType::kCrossed;
  results.untangled_at = 12.5;
  results.curve.jump_force = 1.25;
  results.curve.jump_extension = 0.0123456;
  results.curve.force_after_jump = 0.1;
  results.max_penetration = 0.06;
  results.energy_balance_error = 0.02;
  facts.warnings = {"of the run"};
  const auto all =
      ElementsAre("the rod ran through itself at 12.5 s",
                  "strands are pressed into each other by up to 0.06 radii, where a contact is right up to 0.05",
                  HasSubstr("differ by 0.02"),
                  HasSubstr("jumped open at an extension of 0.0123 m: the load went from 1.25 N to 0.1 N"),
                  "of the run", HasSubstr("still moved"));
  EXPECT_THAT((*this)["warnings"].as<std::vector<std::string>>(), all);
  EXPECT_THAT(printed(), all);
  EXPECT_FALSE((*this)["knot_type_preserved"].as<bool>());
  EXPECT_TRUE((*this)["not_equilibrated"].as<bool>());
}

/// Each a little before its limit and a little beyond it.
TEST_F(Warnings, BeginAtTheirLimits) {
  facts.material.radius = facts.knot_distance = facts.end_to_end = results.span_at_largest_thrust = 1.0;
  facts.material.bending_stiffness = facts.pull_speed = facts.load_cell.capacity = results.span_at_peak_torque = 1.0;
  facts.buckling_factor = results.tension_at_peak_torque = 1.0;
  results.true_plateau_force = 10.0;
  results.lock_extension = 1.0;
  const Results plain = results;
  const double least_torque = 2.0 * std::hypot(1.0, M_PI);
  struct Limit {
    const char* words;
    double at;
    std::function<void(Results&, double)> set;
  };
  const std::vector<Limit> limits{
      {"the energies and the work differ", 0.01, [](Results& of, double x) { of.energy_balance_error = x; }},
      {"strands are pressed into each other", 0.05, [](Results& of, double x) { of.max_penetration = x; }},
      {"the forces on the two grips differ", 0.01, [](Results& of, double x) { of.force_balance_error = x; }},
      {"the knots are ", 1.01, [](Results& of, double x) { of.knot_distance = x; }},
      {"the grips are ", 1.01, [](Results& of, double x) { of.gauge_length = of.knot_distance = x; }},
      {"may writhe", least_torque, [](Results& of, double x) { of.peak_torque = x; }},
      {"buckles at 1 N", 1.0, [](Results& of, double x) { of.largest_thrust = x; }},
      {"drag makes up", 0.01, [](Results& of, double x) { of.rate.drag = x; }},
      {"inertia changes the force", 0.01, [](Results& of, double x) { of.rate.inertia = x; }},
      {"something let go at once", 100.0, [](Results& of, double x) { of.fastest_node = x; }},
  };
  for (const Limit& limit : limits)
    for (const double share : {0.999, 1.001}) {
      results = plain;
      limit.set(results, share * limit.at);
      EXPECT_EQ(testing::Matches(Contains(HasSubstr(limit.words)))(warnings()), share > 1.0) << limit.words;
    }
}

TEST_F(ResultYaml, SaysHowFarTheLoadCellMayBeOff) {
  results.true_peak_force = 2000.0;
  results.true_plateau_force = 6.0;
  facts.load_cell.capacity = 1000.0;
  facts.load_cell.accuracy = 0.005;
  facts.load_cell.floor = 0.01;
  EXPECT_DOUBLE_EQ(number("load_cell_error"), 0.005 * 2000.0);
  EXPECT_DOUBLE_EQ(number("plateau_load_cell_error"), 0.01 * 1000.0);
  EXPECT_THAT(warnings(), Contains("the plateau force lies below the load cell's floor of 10 N"));
}

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

std::vector<std::string> warnings_of(const std::string& name, const std::vector<std::string>& set) {
  return foreseen_warnings(load_method(kConfig + name + ".yaml", set));
}

TEST(Foreseen, NothingIsSaidOfTheShippedMethods) {
  for (const std::string& folder : {kConfig, kConfig + "standards/"})
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".yaml" && entry.path().filename() != "from_file.yaml") {
        EXPECT_THAT(foreseen_warnings(load_method(entry.path().string())), IsEmpty()) << entry.path();
      }
}

TEST(Foreseen, KnotsThatAreTiedNearTheRollers) {
  const std::vector<std::string> set{"material=polypropylene", "specimen.knot_distance=0.2", "specimen.end_to_end="};
  EXPECT_THAT(warnings_of("tighten", {set[0], set[1], set[2] + "0.25"}),
              ElementsAre(AllOf(HasSubstr("specimen.end_to_end is 0.25 m, only 15.7 radii more than"),
                                HasSubstr("from 19 radii more on, which is a specimen.end_to_end of 0.26 m"))));
  EXPECT_THAT(warnings_of("tighten", {set[0], set[1], set[2] + "0.261"}), IsEmpty());
  EXPECT_THAT(warnings_of("tighten", {set[0], set[1], set[2] + "0.25", "machine.grips=nodes"}),
              testing::Each(testing::Not(HasSubstr("rollers are near"))))
      << "there are no rollers";
}

TEST(Foreseen, SlipsOfUnitsAreAskedAbout) {
  const auto asked = [](const std::string& key, const std::string& value) {
    std::vector<std::string> settings = {"program=[{hold: {duration: 1}}]", "material." + key + "=" + value};
    if (key == "bending_stiffness") settings.push_back("material.twisting_stiffness=" + value);
    return warnings_of("straight", settings);
  };
  EXPECT_THAT(asked("density", "100"), ElementsAre(HasSubstr("material.density is 100 kg/m3, where cork has 200")));
  EXPECT_THAT(asked("density", "20000"), ElementsAre(HasSubstr("is it in kg/m3")));
  // E in MPa; that it would then also bend too stiffly needs no word.
  EXPECT_THAT(asked("stretching_stiffness", "0.0734"),
              ElementsAre(HasSubstr("which is E = 2.32 kPa, where rubber has 1 MPa")));
  EXPECT_THAT(asked("bending_stiffness", "4.31e-11"), ElementsAre(HasSubstr("of that of a solid rod")));
  EXPECT_THAT(asked("bending_stiffness", "43.1"), ElementsAre(HasSubstr("is it in N m2?")));
  EXPECT_THAT(asked("breaking_force", "2.5"), ElementsAre(HasSubstr("at a strain of 3.41e-05: is it in N?")));
}

TEST(SpeedWarnings, SayThatKnotsAreTiedInHaste) {
  const Method plain = load_method(kConfig + "tighten.yaml");
  EXPECT_THAT(speed_warnings(plain), IsEmpty());
  const std::string by_default =
      format_number(std::round(100.0 * plain.program[0]->speed / plain.material.radius) / 100.0);
  EXPECT_THAT(speed_warnings(load_method(kConfig + "tighten.yaml", {"program.tie.speed=0.029"})), IsEmpty());
  EXPECT_THAT(speed_warnings(load_method(kConfig + "tighten.yaml", {"program.tie.speed=0.1"})),
              ElementsAre(HasSubstr("tied at 31.5 radii a second, by default at " + by_default + ";")));
}

YamlLines results() {
  YamlLines lines;
  lines.number("peak_force", 60.0);
  lines.number("lock_extension", std::nullopt);
  lines.count("steps", 7);
  return lines;
}

TEST(Verdict, IsNoneWhereNothingWasAskedFor) { EXPECT_EQ(verdict({}, results()).passed, std::nullopt); }

TEST(Verdict, LimitsThemselvesAreAllowed) {
  const Verdict found = verdict({{"peak_force", 60.0, 60.0}, {"steps", std::nullopt, 7.0}}, results());
  EXPECT_EQ(found.passed, true);
  EXPECT_THAT(found.failed, IsEmpty());
}

TEST(Verdict, SaysOfEachRequirementWhyItIsNotMet) {
  const Verdict found = verdict({{"peak_force", 61.5, std::nullopt},
                                 {"steps", 8.0, 9.0},
                                 {"peak_force", std::nullopt, 59.0},
                                 {"lock_extension", std::nullopt, 0.1}},
                                results());
  EXPECT_EQ(found.passed, false);
  EXPECT_THAT(found.failed, ElementsAre("peak_force is 60, less than the least that is allowed, 61.5",
                                        "steps is 7, less than the least that is allowed, 8",
                                        "peak_force is 60, more than the most that is allowed, 59",
                                        "lock_extension has no value in this test"));
}

TEST(Specification, MayNameNumbersOfTheResultOnly) {
  for (const char* key : {"peak_force", "plateau_force", "lock_extension", "untangled_at", "steps", "wall_time"})
    EXPECT_NO_THROW(check_specification({{key, 1.0, {}}})) << key;
  for (const char* key : {"motion_pattern", "warnings", "knot_type_preserved", "excess_length", "version"})
    EXPECT_THROW(check_specification({{key, 1.0, {}}}), InvalidInput) << key;
}

}  // namespace
}  // namespace knot_utm
