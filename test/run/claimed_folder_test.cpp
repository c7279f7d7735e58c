// Nothing that was measured is written over without being asked for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "knot_utm/method/shipped.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/summary.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ClaimedFolderOf : public OwnFolder {
 protected:
  static std::string claimed(const std::string& asked) { return ClaimedFolder::first_free(asked).path(); }
};

TEST_F(ClaimedFolderOf, ARunIsTheNextFreeOneWhereSomethingWould) {
  for (const char* name :
       {"result.yaml", "curve.csv", "curve_full.csv", "method.yaml", "specimen.csv", "knot.yaml", "test.bag",
        "saved.bag", "final_shape.csv", "shapes.csv", "samples.csv", "comparison.yaml", "report.html", "report.pdf"}) {
    const std::string asked = in(std::string(name) + "_is_there");
    fs::create_directories(asked);
    write_whole(asked + "/" + name, "measured");
    EXPECT_EQ(free_folder(asked), asked + "-2") << name;
    EXPECT_EQ(claimed(asked), asked + "-2") << name;
    EXPECT_EQ(claimed(asked + "/"), asked + "-2") << name;
    EXPECT_EQ(read_whole(asked + "/" + name), "measured");
    EXPECT_EQ(std::distance(fs::directory_iterator(asked), fs::directory_iterator()), 1) << name;
  }
}

TEST_F(ClaimedFolderOf, TwoRunsAtOnceAreTwoFolders) {
  const ClaimedFolder first = ClaimedFolder::first_free(in("run")), second = ClaimedFolder::first_free(in("run"));
  EXPECT_EQ(first.path(), in("run"));
  EXPECT_EQ(second.path(), in("run-2"));
  EXPECT_THROW(ClaimedFolder{in("run")}, InvalidInput);
}

/// The commands, as a user has them.
class KeptRun : public ClaimedFolderOf {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    fs::create_directories(folder());
  }
  static Answer test(const std::string& more) {
    return answer_of("cd '" + folder() + "' && " +
                     tool("tensile_test",
                          "straight --set 'program=[{pull: {until: {extension: 0.001}}}]' "
                          "--set physics.accuracy=draft " +
                              more));
  }
};

TEST_F(KeptRun, IsLeftAsItIsUnlessItMayBeOverwritten) {
  const std::string first = "out/straight";
  ASSERT_EQ(test("").code, 0);
  const std::string result = read_whole(in(first + "/result.yaml"));
  const Answer again = test("--quiet");
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.text, AllOf(HasSubstr(first + " holds a run already"), HasSubstr("written to " + first + "-2"),
                                HasSubstr("--overwrite")));
  EXPECT_EQ(read_whole(in(first + "/result.yaml")), result);
  EXPECT_EQ(read_whole(in(first + "/curve.csv")), read_whole(in(first + "-2/curve.csv")));
  EXPECT_EQ(test("--quiet --overwrite").text, "");
  EXPECT_NE(read_whole(in(first + "/result.yaml")), result) << "its wall time is another one";
  EXPECT_FALSE(fs::exists(in(first + "-3")));
}

/// Comments and `auto` of it would be gone.
TEST_F(ClaimedFolderOf, AMethodThatSomebodyWroteIsNotReplacedByItsRun) {
  fs::create_directories(in("mine"));
  const std::string mine = read_whole(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml");
  write_whole(in("mine/method.yaml"), mine);
  fs::create_symlink("mine/method.yaml", in("link.yaml"));
  for (const char* method : {"mine/method.yaml", "link.yaml"}) {
    const Answer answer =
        answer_of(tool("tensile_test", "'" + in(method) + "' --overwrite --out '" + in("mine") + "'"));
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.text, HasSubstr("the run would write over its own method"));
  }
  EXPECT_EQ(read_whole(in("mine/method.yaml")), mine);
}

/// out/latest leads to the run that was written last, whatever the folder is called that it was written to.
class LatestLink : public OwnFolder {
 protected:
  static std::string made(const std::string& name) {
    fs::create_directories(in(name));
    return in(name);
  }
  static std::string latest() { return fs::read_symlink(in("out/latest")).string(); }
};

TEST_F(LatestLink, LeadsToTheLastOne) {
  EXPECT_EQ(point_latest_to(made("out/tighten")), in("out/latest"));
  EXPECT_EQ(latest(), "tighten");
  point_latest_to(made("out/a b") + "/");
  EXPECT_EQ(latest(), "a b");
  point_latest_to(in("out/latest"));  // a run that went on by that name
  EXPECT_EQ(latest(), "a b");
  EXPECT_EQ(std::distance(fs::directory_iterator(in("out")), fs::directory_iterator()), 3);
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

}  // namespace
}  // namespace knot_utm
