#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/study/headless_run.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// Settings with which a loop is tied within half a second.
const std::vector<std::string> kQuick = {"material=green_vps", "physics.accuracy=draft", "specimen.edge_length=0.005",
                                         "program.pull.until={extension: 0.004}"};

Method quick(std::vector<std::string> more = {}) {
  more.insert(more.begin(), kQuick.begin(), kQuick.end());
  return load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml", more);
}

/// Without the lines that begin so, and without the column of samples.csv that has wall times.
std::string but_for_the_computer(const std::string& file) {
  std::istringstream lines(read_whole(file));
  const bool samples = fs::path(file).filename() == "samples.csv";
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    const auto begins = [&](const char* word) { return line.rfind(word, 0) == 0; };
    if (begins("wall_time:") || begins("real_time_factor:") || begins("peak_memory:")) continue;
    if (samples) {
      const std::size_t first = line.find(',') + 1;
      line.erase(first, line.find(',', first) - first);
    }
    out += line + '\n';
  }
  return out;
}

class Tied : public OwnFolder {
 protected:
  Tied() {
    options.interrupted = [] { return false; };
    options.shapes = true;
    options.remark = [&](const std::string& line) { said += line; };
    options.progress = [&](const Sample&, const ProgramRunner&, double) { ++computed; };
  }

  /// Runs it into a folder of this name, and gives that back.
  std::string run(const std::string& name, const Method& method) {
    said.clear();
    computed = 0;
    options.folder = in(name);
    options.overwrite = true;
    outcome = run_headless(method, options);
    return options.folder + "/";
  }
  std::size_t kept() const {
    std::error_code error;
    const fs::directory_iterator files(in(".tied"), error);
    return error ? 0 : static_cast<std::size_t>(std::distance(files, fs::directory_iterator()));
  }
  static void expect_the_same_files(const std::string& a, const std::string& b) {
    int files = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(a)) {
      const std::string name = entry.path().filename().string();
      ++files;
      ASSERT_TRUE(fs::exists(b + name)) << name;
      EXPECT_TRUE(but_for_the_computer(a + name) == but_for_the_computer(b + name)) << name;
    }
    EXPECT_EQ(files, std::distance(fs::directory_iterator(b), fs::directory_iterator()));
    EXPECT_GE(files, 5);
  }

  HeadlessOptions options;
  HeadlessOutcome outcome;
  std::string said;
  int computed = 0;  // commands
};

TEST_F(Tied, RestoredItLeavesTheSameBytesAsATestThatTiesIt) {
  const Method method = quick(), other = quick({"program.pull.until={extension: 0.002}", "ends.load=4000"});
  const std::string alone = run("alone", method);
  const int all = computed;
  EXPECT_EQ(kept(), 0u);

  options.cache = true;
  options.interrupted = [&] { return computed > 10; };
  run("interrupted", method);
  EXPECT_FALSE(outcome.ended);
  EXPECT_EQ(kept(), 0u) << "it was not tied to the end";

  options.interrupted = [&] { return kept() > 0; };
  const std::string stopped = run("stopped", other);
  EXPECT_EQ(kept(), 1u);
  EXPECT_EQ(said, "");
  EXPECT_GT(computed, 0);
  expect_the_same_files(stopped, run("stopped_again", other));
  EXPECT_EQ(computed, 0) << "nothing was left to do";

  options.interrupted = [] { return false; };
  const std::string restored = run("restored", method);
  EXPECT_THAT(said, HasSubstr("taken from the cache"));
  EXPECT_GT(computed, 0);
  EXPECT_LT(computed, all);
  EXPECT_TRUE(outcome.ended.has_value());
  EXPECT_GT(outcome.wall_time, 0.0);
  expect_the_same_files(alone, restored);
  EXPECT_EQ(kept(), 1u);
}

TEST_F(Tied, WhatIsDamagedOrForeignIsTiedAnewAndReplaced) {
  options.cache = true;
  options.shapes = false;
  const Method method = quick();
  const std::optional<TiedSpecimen> tied = TiedSpecimen::of(method, false, in("any"));
  ASSERT_TRUE(tied);
  const std::string file = tied->file();
  options.interrupted = [&] { return fs::is_regular_file(file) && fs::file_size(file) > 1000; };
  const std::string first = run("first", method);
  ASSERT_EQ(kept(), 1u);
  const std::string whole = read_whole(file);
  const auto restores = [](const TiedSpecimen& specimen, const Method& of) {
    TestingMachine bench(of.specimen, of.material, of.machine, of.physics);
    ProgramRunner program = make_program(of, bench.longest_step());
    const bool restored = specimen.restore(of, bench, program).has_value();
    EXPECT_EQ(program.last().step, restored ? 3 : -1);
    EXPECT_EQ(bench.time() > 0.0, restored);
    return restored;
  };
  EXPECT_TRUE(restores(*tied, method));
  // Archive.TellsEveryDamage has the others.
  for (const std::string& bytes : {std::string(), std::string("something else"), whole.substr(0, whole.size() / 2)}) {
    write_whole(file, bytes);
    EXPECT_FALSE(restores(*tied, method)) << bytes.size();
  }
  // The state of another specimen, in the place of this one.
  const Method its = quick({"specimen.preload=12"});
  const std::optional<TiedSpecimen> other = TiedSpecimen::of(its, false, in("any"));
  write_whole(other->file(), whole);
  EXPECT_FALSE(restores(*other, its));
  // The next test ties the specimen, and keeps it.
  write_whole(file, "something else");
  expect_the_same_files(first, run("again", method));
  EXPECT_EQ(said, "");
  EXPECT_TRUE(restores(*tied, method));
}

TEST(TiedFrom, ChangesWithEverySectionThatTheSpecimenDependsOnAndWithNoOther) {
  const std::string from = tied_from(quick(), 3, false);
  for (const char* other : {"specimen.preload=12", "material.density=1000", "machine.roller_friction=0.2",
                            "physics.accuracy=fine", "program.tie.speed=0.02", "program.release.duration=1"})
    EXPECT_NE(tied_from(quick({other}), 3, false), from) << other;
  for (const char* other : {"material.name=another", "machine.load_cell.notes=words", "ends.load=4000",
                            "program.pull.speed=0.01", "specimens.seed=2"})
    EXPECT_EQ(tied_from(quick({other}), 3, false), from) << other;
}

class TiedFromFile : public MadeFolder {};

TEST_F(TiedFromFile, IsWhatTheFileOfItsKnotSays) {
  const std::string config = std::string(KNOT_UTM_SOURCE_DIR) + "/config/",
                    reef = read_whole(config + "knots/reef.yaml");
  const auto depends_on = [&](const std::string& name, const std::string& text) {
    write_whole(in(name), text);
    return tied_from(load_method(config + "knot.yaml", {"specimen.knot=" + in(name)}), 1, false);
  };
  std::string moved = reef;
  moved.replace(moved.find("[0.6, 2.8, 3.0]"), 15, "[0.6, 2.8, 3.1]");
  const std::string first = depends_on("a.yaml", reef);
  EXPECT_EQ(depends_on("b.yaml", reef), first);
  EXPECT_NE(depends_on("a.yaml", moved), first);
}

class CachedTool : public OwnFolder {
 protected:
  static std::string line(const std::string& out, const std::string& more = "") {
    std::string words = "tighten --out '" + folder() + "/" + out + "' " + more;
    for (const std::string& one : kQuick) words += " --set '" + one + "'";
    return "KNOT_UTM_NO_CACHE= " + tool("tensile_test", words);
  }
  static std::string curve(const std::string& out) { return read_whole(folder() + "/" + out + "/curve.csv"); }
};

TEST_F(CachedTool, TiesOnceForProcessesThatFollowAndSideBySideTheyDoNotDisturbEachOther) {
  const Answer both =
      answer_of(line("a", "--quiet") + " & " + line("b", "--quiet") + "; e=$?; wait $! || e=1; exit $e");
  EXPECT_EQ(both.code, 0) << both.text;
  const Answer third = answer_of(line("c"));
  EXPECT_EQ(third.code, 0) << third.text;
  EXPECT_THAT(third.text, HasSubstr("tensile_test: the tied specimen was taken from the cache (--no-cache ties it"));
  EXPECT_EQ(curve("a"), curve("b"));
  EXPECT_EQ(curve("a"), curve("c"));
  const Answer anew = answer_of(line("d", "--no-cache"));
  EXPECT_THAT(anew.text, Not(HasSubstr("cache")));
  EXPECT_EQ(curve("a"), curve("d"));
  EXPECT_EQ(std::distance(fs::directory_iterator(in(".tied")), fs::directory_iterator()), 1);
  EXPECT_THAT(answer_of(line("c", "--quiet --overwrite")).text, Not(HasSubstr("cache"))) << "it is no warning";
}

}  // namespace
}  // namespace knot_utm
