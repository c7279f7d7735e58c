// What a page on a comparison is made of. The page itself: test/python/report.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/summary.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

TEST(CommandLine, IsOneThatAShellReads) {
  const char* words[] = {"tensile_test", "--set", "program.pull.until={extension: 0.03}", "it's", ""};
  EXPECT_EQ(command_line(5, words), R"(tensile_test --set 'program.pull.until={extension: 0.03}' 'it'\''s' '')");
}

class ReportIn : public MadeFolder {
 protected:
  const Pull a_{{0.0, 0.0, 0.0, 1.5}, {1.0, 0.25, 0.0, 2.0}};
};

TEST_F(ReportIn, AComparisonReplacesNoRunAndNothingThatItCompares) {
  write_whole(in("b.csv"), "measured");
  EXPECT_THROW(write_comparison(folder(), "", a_, a_, "x", in("./b.csv")), InvalidInput);
  EXPECT_EQ(read_whole(in("b.csv")), "measured");
  EXPECT_FALSE(fs::exists(in("a.csv")));
  fs::create_hard_link(in("b.csv"), in("report.html"));
  EXPECT_THROW(write_comparison(folder(), "", a_, a_, "x", in("b.csv"), true), InvalidInput);
  write_whole(in("result.yaml"), "");
  EXPECT_THROW(write_comparison(folder(), "", a_, a_, "x", "y"), InvalidInput);
  EXPECT_THROW(write_comparison(in("b.csv/below"), "", a_, a_, "x", "y"), InvalidInput);
  EXPECT_THROW(write_comparison("", "", a_, a_, "x", "y"), InvalidInput);
}

TEST_F(ReportIn, AnotherComparisonGoesBeside) {
  const auto compared = [&](const std::string& yaml) { return write_comparison(in("beside"), yaml, a_, a_, "x", "y"); };
  EXPECT_EQ(compared("a: x\nb: y\nrms: 1\n"), in("beside"));
  EXPECT_EQ(compared("a: x\nb: y\nrms: 1\n"), in("beside")) << "to the byte";
  EXPECT_EQ(compared("a: x\nb: y\nrms: 2\n"), in("beside-2")) << "of files that have changed since";
  EXPECT_EQ(compared("a: x\nb: z\nrms: 3\n"), in("beside-3"));
  EXPECT_EQ(read_whole(in("beside/comparison.yaml")), "a: x\nb: y\nrms: 1\n");
  EXPECT_EQ(write_comparison(in("beside"), "a: v\nb: w\n", a_, a_, "v", "w", true), in("beside"));

  fs::create_directories(in("mine"));
  write_whole(in("mine/report.html"), "mine");
  EXPECT_EQ(write_comparison(in("mine"), "a: x\nb: y\n", a_, a_, "x", "y"), in("mine-2"));
  EXPECT_EQ(read_whole(in("mine/report.html")), "mine");
}

}  // namespace
}  // namespace knot_utm
