// What a page on a comparison is made of. The page itself: test/python/report.

#include "knot_utm/run/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/run/command_hint.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

TEST(CommandLine, IsOneThatAShellReads) {
  const char* words[] = {"tensile_test", "--set", "program.pull.until={extension: 0.03}", "it's", ""};
  EXPECT_EQ(command_line(5, words), R"(tensile_test --set 'program.pull.until={extension: 0.03}' 'it'\''s' '')");
}

class ReportIn : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    fs::create_directories(folder());
  }
  static std::string file(const std::string& name) { return folder() + "/" + name; }

  const Pull a_{{0.0, 0.0, 0.0, 1.5}, {1.0, 0.25, 0.0, 2.0}};
};

TEST_F(ReportIn, AComparisonIsItsYamlAndBothPulls) {
  write_comparison(file("new/folder"), "a: x\n", a_, a_, "x", "y");
  EXPECT_EQ(read_whole(file("new/folder/comparison.yaml")), "a: x\n");
  EXPECT_EQ(read_whole(file("new/folder/b.csv")), "extension,load\nm,N\n0,1.5\n0.25,2\n");
}

TEST_F(ReportIn, AComparisonReplacesNoRunAndNothingThatItCompares) {
  write_whole(file("b.csv"), "measured");
  EXPECT_THROW(write_comparison(folder(), "", a_, a_, "x", file("./b.csv")), InvalidInput);
  EXPECT_EQ(read_whole(file("b.csv")), "measured");
  EXPECT_FALSE(fs::exists(file("a.csv")));
  fs::create_hard_link(file("b.csv"), file("report.html"));
  EXPECT_THROW(write_comparison(folder(), "", a_, a_, "x", file("b.csv"), true), InvalidInput);
  write_whole(file("result.yaml"), "");
  EXPECT_THROW(write_comparison(folder(), "", a_, a_, "x", "y"), InvalidInput);
  EXPECT_THROW(write_comparison(file("b.csv/below"), "", a_, a_, "x", "y"), InvalidInput);
  EXPECT_THROW(write_comparison("", "", a_, a_, "x", "y"), InvalidInput);
}

TEST_F(ReportIn, AnotherComparisonGoesBeside) {
  const auto compared = [&](const std::string& yaml) {
    return write_comparison(file("beside"), yaml, a_, a_, "x", "y");
  };
  EXPECT_EQ(compared("a: x\nb: y\nrms: 1\n"), file("beside"));
  EXPECT_EQ(compared("a: x\nb: y\nrms: 1\n"), file("beside")) << "to the byte";
  EXPECT_EQ(compared("a: x\nb: y\nrms: 2\n"), file("beside-2")) << "of files that have changed since";
  EXPECT_EQ(compared("a: x\nb: z\nrms: 3\n"), file("beside-3"));
  EXPECT_EQ(read_whole(file("beside/comparison.yaml")), "a: x\nb: y\nrms: 1\n");
  EXPECT_EQ(write_comparison(file("beside"), "a: v\nb: w\n", a_, a_, "v", "w", true), file("beside"));

  fs::create_directories(file("mine"));
  write_whole(file("mine/report.html"), "mine");
  EXPECT_EQ(write_comparison(file("mine"), "a: x\nb: y\n", a_, a_, "x", "y"), file("mine-2"));
  EXPECT_EQ(read_whole(file("mine/report.html")), "mine");
}

}  // namespace
}  // namespace knot_utm
