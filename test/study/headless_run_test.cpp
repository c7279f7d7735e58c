#include "knot_utm/study/headless_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "complaint.hpp"
#include "knot_utm/analysis/statistics.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/study/batch.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// The shipped straight rod, which is pulled within milliseconds, and a folder of this test's own.
class HeadlessRun : public OwnFolder {
 protected:
  HeadlessRun() {
    options.folder = in("run");
    options.interrupted = [] { return false; };
  }
  std::string curve() const { return read_whole(options.folder + "/curve.csv"); }

  const Method method = load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml");
  HeadlessOptions options;
};

TEST_F(HeadlessRun, ShowsEveryRecordAndKeepsShapesOnlyWhereTheyAreAskedFor) {
  for (const bool asked : {false, true}) {
    int shown = 0;
    options.overwrite = true;
    options.keep_shapes = asked;
    options.progress = [&](const Sample&, const ProgramRunner&, double) { ++shown; };
    const HeadlessOutcome outcome = run_headless(method, options);
    EXPECT_TRUE(outcome.ended.has_value());
    EXPECT_FALSE(outcome.failed);
    EXPECT_EQ(outcome.folder, options.folder);
    EXPECT_EQ(fs::exists(shapes_file(options.folder)), asked);
    EXPECT_TRUE(fs::exists(options.folder + "/final_shape.csv"));
    SamplesReader samples(options.folder);
    Record record;
    while (samples.next(record)) continue;
    EXPECT_GT(shown, 3);
    EXPECT_EQ(samples.records(), static_cast<std::uint64_t>(shown));
    EXPECT_EQ(samples.final_shape().cols() > 0, asked);
  }
}

TEST_F(HeadlessRun, InterruptedItLeavesWhatWasMeasured) {
  ASSERT_TRUE(run_headless(method, options).ended);
  const std::string whole = curve();
  options.folder += "_interrupted";
  int asked = 0;
  options.interrupted = [&] { return ++asked > 3; };
  EXPECT_FALSE(run_headless(method, options).ended);
  EXPECT_LT(curve().size(), whole.size());
  EXPECT_EQ(whole.find(curve()), 0u);
  EXPECT_THAT(read_whole(options.folder + "/result.yaml"), HasSubstr("ended_by: operator\nreason: \"interrupted\"\n"));
  EXPECT_FALSE(has_complete_result(options.folder));
}

/// A rod of nylon so stiff that its load grows by 195 N from one command to the next, and by twice as much from one
/// reading of the cell to the next.
TEST_F(HeadlessRun, ALimitIsALimitAndThePeakIsItsReading) {
  const std::string usual = "program=[{balance: {}}, {pull: {speed: 1.6e-3, until: {extension: 0.01}}}]";
  const std::string to_load = "program=[{balance: {}}, {pull: {speed: 1.6e-3, until: {load: 200}}}]";
  const std::string compliant = "machine.stiffness=1e5";
  for (const std::vector<std::string>& changes : std::vector<std::vector<std::string>>{
           {"ends.load=200", usual}, {to_load}, {"ends.load=200", compliant, usual}, {compliant, to_load}}) {
    std::vector<std::string> all{"material=nylon", "specimen.length=0.1"};
    all.insert(all.end(), changes.begin(), changes.end());
    options.overwrite = true;
    const HeadlessOutcome outcome =
        run_headless(load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml", all), options);
    EXPECT_EQ(outcome.ended, EndedBy::kLoad);
    const YAML::Node result = YAML::LoadFile(options.folder + "/result.yaml");
    const double peak = result["peak_force"].as<double>();
    EXPECT_NEAR(peak, 200.0, 2.0) << all.back();
    EXPECT_EQ(result["warnings"].size(), 0u);
    // The last row of the curve is the end of the pull, and the peak.
    const std::vector<CurveRow> rows = read_curve(options.folder + "/curve.csv");
    EXPECT_EQ(rows.back().load, peak);
    EXPECT_EQ(rows.back().extension, result["peak_extension"].as<double>());
    EXPECT_NEAR(rows.back().load / rows.back().extension, result["secant_stiffness"].as<double>(), 2e-3 * peak * 1e4);
  }
}

TEST_F(HeadlessRun, ThatGaveUpSaysWhy) {
  const HeadlessOutcome outcome = run_headless(load_method(KNOT_UTM_SOURCE_DIR "/test/ros/impossible.yaml"), options);
  EXPECT_EQ(outcome.ended, EndedBy::kSolver);
  EXPECT_THAT(outcome.reason, HasSubstr("the time step fell below"));
  EXPECT_THAT(outcome.reason, HasSubstr("the residual is largest at node "));
}

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

class Batch : public OwnFolder {
 protected:
  Batch() {
    options.folder = in("batch");
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
    options.folder = in("jobs_" + std::to_string(jobs));
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
  for (const SampledSpecimen& specimen : draw_specimens(method)) stiffness.push_back(specimen.drawn[0].second);
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
  options.folder = in("other");
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

Method straight(const std::string& specimens) {
  return load_method(kConfig + "straight.yaml", {"specimens=" + specimens});
}

std::string refused(const std::string& method, const std::vector<std::string>& overrides) {
  return complaint_of([&] { draw_specimens(load_method(kConfig + method, overrides)); });
}

TEST(Specimens, OneIsDrawnAsAmongAllOthers) {
  const Method method = straight("{count: 3, scatter: {specimen.length: {normal: 0.02}}}");
  const std::vector<SampledSpecimen> all = draw_specimens(method);
  for (const int number : {3, 1}) {
    const SampledSpecimen one = draw_specimen(method, number);
    EXPECT_EQ(one.number, number);
    EXPECT_EQ(one.drawn, all[static_cast<std::size_t>(number - 1)].drawn);
    EXPECT_EQ(method_yaml(one.method), method_yaml(all[static_cast<std::size_t>(number - 1)].method));
  }
}

/// The standard error of a standard deviation over n normal readings is its 1/sqrt(2 n)-th part, that of the mean the
/// 1/sqrt(n)-th; three of them, which the fixed seed keeps. Leaving out what is beyond 3 standard deviations takes 1.3
/// % of the standard deviation.
TEST(Specimens, AreDrawnWithTheSpreadThatTheMethodSays) {
  constexpr int kCount = 400;
  const Method method = straight(
      "{count: 400, scatter: {specimen.length: {normal: 0.02}, material.radius: {uniform: 0.1}, "
      "material.density: {log_normal: 0.2}}}");
  std::vector<double> lengths, radii, densities;
  for (const SampledSpecimen& specimen : draw_specimens(method)) {
    lengths.push_back(specimen.method.specimen.length);
    radii.push_back(specimen.method.material.radius);
    densities.push_back(std::log(specimen.method.material.density / method.material.density));
    EXPECT_EQ(specimen.drawn[0].second, lengths.back());
    EXPECT_EQ(specimen.method.specimens.count, 1);
  }
  const double of_sd = 3.0 / std::sqrt(2.0 * kCount), of_mean = 3.0 / std::sqrt(1.0 * kCount);
  const Statistics length = statistics_of(lengths), radius = statistics_of(radii), density = statistics_of(densities);
  EXPECT_NEAR(*length.cv, 0.02 * (1.0 - 0.013), 0.02 * of_sd);
  EXPECT_NEAR(*length.mean / method.specimen.length, 1.0, 0.02 * of_mean);
  EXPECT_LE(*length.maximum, 1.06 * method.specimen.length);
  EXPECT_NEAR(*radius.cv, 0.1 / std::sqrt(3.0), 0.1 * of_sd);
  EXPECT_GE(*radius.minimum, 0.9 * method.material.radius);
  EXPECT_LE(*radius.maximum, 1.1 * method.material.radius);
  EXPECT_NEAR(*density.sd, 0.2 * (1.0 - 0.013), 0.2 * of_sd);
  EXPECT_NEAR(*density.mean, 0.0, 0.2 * of_mean);
}

/// No number of specimens averages the cell's systematic error out, as in a laboratory.
TEST(Specimens, AreReadByOneCellWithNoiseOfItsOwnForEach) {
  const auto drawn = draw_specimens(straight("{count: 2}")), others = draw_specimens(straight("{count: 2, seed: 2}"));
  const auto cell = [](const SampledSpecimen& specimen) { return specimen.method.machine.load_cell; };
  EXPECT_EQ(cell(drawn[0]).seed, cell(drawn[1]).seed);
  EXPECT_NE(cell(drawn[0]).noise_run, cell(drawn[1]).noise_run);
  EXPECT_NE(cell(drawn[0]).noise_run, cell(others[0]).noise_run);
}

TEST(Specimens, AreRefusedBeforeAnyIsTested) {
  const std::string scatter = "specimens.scatter=";
  EXPECT_THAT(refused("straight.yaml", {"specimens.count=2", scatter + "{specimen.lenght: {normal: 0.1}}"}),
              AllOf(HasSubstr("specimen.lenght"), HasSubstr("no key of this method that has a number")));
  EXPECT_THAT(refused("straight.yaml", {"specimens.count=2", scatter + "{specimen.length: 0.1}"}),
              AllOf(HasSubstr("specimens.scatter.specimen.length"), HasSubstr("{normal: 0.05}")));
  EXPECT_THAT(refused("straight.yaml", {"specimens.count=2", scatter + "{specimen.length: {normal: 2}}"}),
              AllOf(HasSubstr("specimens.scatter.specimen.length.normal is 2"), HasSubstr("0.3")));
  EXPECT_THAT(refused("straight.yaml", {"specimens.count=0"}), HasSubstr("specimens.count is 0"));
  EXPECT_THAT(refused("straight.yaml", {"specimens.cuont=2"}), HasSubstr("did you mean specimens.count?"));
  EXPECT_THAT(refused("tighten.yaml", {"specimens.count=50", scatter + "{specimen.knot_distance: {normal: 0.3}}"}),
              AllOf(HasSubstr("cannot be made"), HasSubstr("specimen.")));
}

}  // namespace
}  // namespace knot_utm
