#include "knot_utm/study/headless_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The shipped straight rod, which is pulled within milliseconds, and a folder of this test's own.
class HeadlessRun : public OwnFolder {
 protected:
  HeadlessRun() {
    options.folder = folder() + "/run";
    options.interrupted = [] { return false; };
  }
  std::string curve() const { return read_whole(options.folder + "/curve.csv"); }

  const Method method = load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml");
  HeadlessOptions options;
};

TEST_F(HeadlessRun, HandsEveryRecordToTheFurtherWriterAndClosesItOnce) {
  int records = 0, shown = 0, closed = 0;
  std::string place;
  options.further = [&](const std::string& into, const Method&) {
    place = into;
    return FurtherWriter{[&](const Record&) { ++records; }, [&] { ++closed; }};
  };
  options.progress = [&](const Sample&, const ProgramRunner&, double) { ++shown; };
  const HeadlessOutcome outcome = run_headless(method, options);
  EXPECT_TRUE(outcome.ended.has_value());
  EXPECT_FALSE(outcome.failed);
  EXPECT_EQ(place, options.folder);
  EXPECT_EQ(outcome.folder, options.folder);
  EXPECT_GT(records, 3);
  EXPECT_EQ(records, shown);
  EXPECT_EQ(closed, 1);
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

TEST_F(HeadlessRun, KeepsShapesWhereAskedAndChangesNothingElse) {
  const auto shapes = [&] { return options.folder + "/shapes.csv"; };
  ASSERT_TRUE(run_headless(method, options).ended);
  EXPECT_FALSE(fs::exists(shapes()));
  const std::string plain = curve();
  options.folder += "_with_shapes";
  options.shapes = true;
  ASSERT_TRUE(run_headless(method, options).ended);
  EXPECT_EQ(curve(), plain);
  const std::string whole = read_whole(shapes());
  EXPECT_GT(std::count(whole.begin(), whole.end(), '\n'), 100);
}

/// Specimens that are pulled differently are made once.
TEST_F(HeadlessRun, BegunWithAnEarlierRunItLeavesTheSameBytesAsFromTheStart) {
  const std::string held = "program=[{balance: {}}, {hold: {duration: 1}}, {pull: {speed: 0.001, until: {extension: ";
  const auto method_to = [&](const std::string& extension) {
    return load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml", {held + extension + "}}}]"});
  };
  const Method first = method_to("0.002"), other = method_to("0.001");
  ASSERT_TRUE(run_headless(other, options).ended);
  const std::string from_the_start = curve() + read_whole(options.folder + "/curve_full.csv");

  HeadlessOptions early = options;
  early.folder = folder() + "/early";
  early.stop_before = step_called(first.program, "pull");
  EXPECT_FALSE(run_headless(first, early).ended);
  options.folder += "_later";
  options.begin_with = early.folder;
  EXPECT_TRUE(run_headless(other, options).ended);
  EXPECT_EQ(curve() + read_whole(options.folder + "/curve_full.csv"), from_the_start);

  options.folder = early.folder;
  options.overwrite = true;
  EXPECT_THROW(run_headless(other, options), InvalidInput) << "it would write over what it begins with";
}

TEST_F(HeadlessRun, BeginsWithNoRunOfAnotherSpecimenOrProgram) {
  HeadlessOptions early = options;
  early.folder = folder() + "/early";
  early.stop_before = step_called(method.program, "pull");
  run_headless(method, early);
  options.begin_with = early.folder;
  const auto refused = [&](const std::vector<std::string>& changes) -> std::string {
    try {
      run_headless(load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml", changes), options);
    } catch (const InvalidInput& invalid) {
      return invalid.what();
    }
    return "";
  };
  EXPECT_THAT(refused({"specimen.length=0.3"}), HasSubstr("specimen.length is 0.25 there, and 0.3 here"));
  EXPECT_THAT(refused({"machine.load_cell.noise=1"}), HasSubstr("machine.load_cell"));
  EXPECT_THAT(refused({"program=[{hold: {duration: 3}}, {pull: {until: {extension: 0.01}}}]"}),
              HasSubstr("the programs differ from"));
  EXPECT_FALSE(fs::exists(options.folder)) << "nothing was written";
  options.begin_with = folder() + "/nowhere";
  EXPECT_THAT(refused({}), HasSubstr("it holds no run"));
}

}  // namespace
}  // namespace knot_utm
