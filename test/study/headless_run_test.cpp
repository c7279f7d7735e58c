#include "knot_utm/study/headless_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
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

TEST_F(HeadlessRun, ThatGaveUpSaysWhy) {
  const HeadlessOutcome outcome = run_headless(load_method(KNOT_UTM_SOURCE_DIR "/test/ros/impossible.yaml"), options);
  EXPECT_EQ(outcome.ended, EndedBy::kSolver);
  EXPECT_THAT(outcome.reason, HasSubstr("the time step fell below"));
  EXPECT_THAT(outcome.reason, HasSubstr("the residual is largest at node "));
}

}  // namespace
}  // namespace knot_utm
