#include "knot_utm/study/tied_specimen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <set>
#include <sstream>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/record/loading_steps.hpp"
#include "knot_utm/record/preparing_steps.hpp"
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
    options.folder = folder() + "/" + name;
    options.overwrite = true;
    outcome = run_headless(method, options);
    return options.folder + "/";
  }
  std::vector<std::string> kept() const {
    std::vector<std::string> files;
    std::error_code error;
    for (fs::directory_iterator entry(cache.folder(), error), end; !error && entry != end; ++entry)
      files.push_back(entry->path().string());
    return files;
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

  const CacheFolder cache{folder() + "/cache", 1U << 30U};
  HeadlessOptions options;
  HeadlessOutcome outcome;
  std::string said;
  int computed = 0;  // commands
};

TEST_F(Tied, TakenUpItLeavesTheSameBytesAsATestThatTiesIt) {
  const Method method = quick(), other = quick({"program.pull.until={extension: 0.002}", "ends.load=4000"});
  const std::string alone = run("alone", method);
  const int all = computed;
  EXPECT_TRUE(kept().empty());

  options.cache = cache;
  options.interrupted = [&] { return !kept().empty(); };
  const std::string stopped = run("stopped", other);
  EXPECT_EQ(kept().size(), 1u);
  EXPECT_EQ(said, "");
  EXPECT_GT(computed, 0);
  expect_the_same_files(stopped, run("stopped_again", other));
  EXPECT_EQ(computed, 0) << "nothing was left to do";

  options.interrupted = [] { return false; };
  const std::string taken_up = run("taken_up", method);
  EXPECT_THAT(said, HasSubstr("taken from the cache"));
  EXPECT_GT(computed, 0);
  EXPECT_LT(computed, all);
  EXPECT_TRUE(outcome.ended.has_value());
  EXPECT_GT(outcome.wall_time, 0.0);
  expect_the_same_files(alone, taken_up);
  EXPECT_EQ(kept().size(), 1u);
}

TEST_F(Tied, IsThatOfWhatTheFileOfItsKnotSays) {
  fs::create_directories(folder());
  const std::string config = std::string(KNOT_UTM_SOURCE_DIR) + "/config/",
                    reef = read_whole(config + "knots/reef.yaml");
  const auto depends_on = [&](const std::string& name, const std::string& text) {
    write_whole(folder() + "/" + name, text);
    return tied_from(load_method(config + "knot.yaml", {"specimen.knot=" + folder() + "/" + name}), 1, false);
  };
  std::string moved = reef;
  moved.replace(moved.find("[0.6, 2.8, 3.0]"), 15, "[0.6, 2.8, 3.1]");
  const std::string first = depends_on("a.yaml", reef);
  EXPECT_EQ(depends_on("b.yaml", reef), first);
  EXPECT_NE(depends_on("a.yaml", moved), first);
}

TEST_F(Tied, IsNotKeptOfATestThatIsInterruptedBefore) {
  options.cache = cache;
  options.interrupted = [&] { return computed > 10; };
  run("interrupted", quick());
  EXPECT_FALSE(outcome.ended);
  EXPECT_TRUE(kept().empty());
}

TEST_F(Tied, WhatIsDamagedOrForeignIsTiedAnewAndReplaced) {
  options.cache = cache;
  options.shapes = false;
  const Method method = quick();
  const std::string file = cache.file_of(tied_from(method, 3, false));
  options.interrupted = [&] { return fs::is_regular_file(file); };
  const std::string first = run("first", method);
  ASSERT_EQ(kept().size(), 1u);
  const std::string whole = read_whole(file);
  const std::optional<TiedSpecimen> tied = TiedSpecimen::of(method, false, cache);
  ASSERT_TRUE(tied);
  const auto take_up = [&] {
    TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
    ProgramRunner program = make_program(method, bench.longest_step());
    const bool taken = tied->take_up(method, bench, program).has_value();
    EXPECT_EQ(program.last().step, taken ? 3 : -1);
    EXPECT_EQ(bench.time() > 0.0, taken);
    return taken;
  };
  EXPECT_TRUE(take_up());
  std::vector<std::string> damaged = {"", "\n", "something else", whole + "more", std::string(whole.size(), '\0')};
  for (const double part : {0.001, 0.01, 0.2, 0.5, 0.8, 0.99})
    damaged.push_back(whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
  damaged.push_back(whole.substr(0, whole.size() - 1));
  for (std::size_t at = 3; at < whole.size(); at += whole.size() / 9) {
    damaged.push_back(whole);
    damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 0x10);
  }
  for (const std::string& bytes : damaged) {
    write_whole(file, bytes);
    EXPECT_FALSE(take_up()) << bytes.size();
  }
  // A state of another specimen, in the place of this one.
  const Method its = quick({"specimen.preload=12"});
  cache.write(tied_from(its, 3, false), whole);
  TestingMachine bench(its.specimen, its.material, its.machine, its.physics);
  ProgramRunner program = make_program(its, bench.longest_step());
  EXPECT_FALSE(TiedSpecimen::of(its, false, cache)->take_up(its, bench, program));
  // A folder in its place: the next test ties the specimen, and keeps it.
  fs::remove(file);
  fs::create_directories(file + "/folder");
  expect_the_same_files(first, run("again", method));
  EXPECT_EQ(said, "");
  EXPECT_EQ(read_whole(file).size(), whole.size());
  EXPECT_TRUE(take_up());
}

/// All scalars of a map, with their dotted keys; lists count from 0.
void each_leaf(const YAML::Node& node, const std::string& key, const std::function<void(const std::string&)>& visit) {
  const auto below = [&](const std::string& name) { return key.empty() ? name : key + "." + name; };
  if (node.IsMap())
    for (const auto& item : node) each_leaf(item.second, below(item.first.Scalar()), visit);
  else if (node.IsSequence() && node.size() > 0 && !node[0].IsScalar())
    for (std::size_t i = 0; i < node.size(); ++i) each_leaf(node[i], below(std::to_string(i)), visit);
  else
    visit(key);
}

/// The value at a dotted key, as it is written; empty: there is none.
std::string value_at(YAML::Node node, const std::string& key) {
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '.');) {
    if (node.IsSequence() && std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isdigit(c); }))
      node.reset(node[std::stoul(part)]);
    else if (node.IsMap() && node[part])
      node.reset(node[part]);
    else
      return {};
  }
  return YAML::Dump(node);
}

/// A key of the program that the tied specimen depends on.
bool is_of_tying(const std::string& key) {
  return key.rfind("program.", 0) == 0 && (key[8] < '3' || key.rfind("program.tie", 0) == 0 ||
                                           key.rfind("program.release", 0) == 0 || key.rfind("program.mount", 0) == 0);
}

bool is_physical(const std::string& key) {
  const bool words = key == "material.name" || key == "material.notes" || key == "machine.load_cell.name" ||
                     key == "machine.load_cell.notes";
  const std::string section = key.substr(0, key.find('.'));
  return !words && (section == "specimen" || section == "material" || section == "machine" || section == "physics" ||
                    is_of_tying(key));
}

/// Other values that a key may have, of which most are refused.
std::vector<std::string> other_values(const std::string& now) {
  std::vector<std::string> values;
  if (const std::optional<double> number = parse_number(now))
    for (const double factor : {1.0009, 0.9991, 1.1, 0.9, 2.0}) values.push_back(format_yaml_number(*number * factor));
  values.insert(
      values.end(),
      {"1",    "2",     "3",        "0.5",        "0.01",        "100",     "true",          "false",
       "on",   "off",   "opposite", "free",       "follow",      "edge",    "smoothed",      "centreline",
       "fine", "nodes", "elastic",  "frictional", "neo_hookean", "20N",     "[0, 0, -9.81]", "multiple_fisherman",
       "lbf",  "mm",    "in",       "words",      "2020-01-01",  "tension", "soft",          "0"});
  return values;
}

/// A method that is `quick` but for one key; empty where none is allowed.
std::optional<Method> with_another(const std::string& key, const YAML::Node& own,
                                   const std::vector<std::string>& base) {
  const std::string now = value_at(own, key);
  for (const std::string& value : other_values(now)) {
    std::vector<std::string> settings = base;
    settings.push_back(key + "=" + value);
    try {
      const Method other = quick(settings);
      const std::string then = value_at(YAML::Load(method_yaml(other)), key);
      if (then != now) return other;
    } catch (const InvalidInput&) {
    }
  }
  return std::nullopt;
}

TEST(TiedFrom, ChangesWithEveryKeyThatTheSpecimenDependsOnAndWithNoOther) {
  // Keys that have an effect on one of these rods and machines only.
  const std::vector<std::vector<std::string>> bases = {
      {"material=suture_3-0_nylon", "specimen.edge_length=auto", "machine.roller_friction=0.2"},
      {},
      {"material=nylon", "machine.roller_friction=0.2", "machine.roller_rotation=free",
       "material.breaking={law: tension_and_bending, bending_share: 0.01}"}};
  std::set<std::string> changed, all;
  for (const std::vector<std::string>& base : bases) {
    const Method method = quick(base);
    const YAML::Node own = YAML::Load(method_yaml(method));
    const std::string from = tied_from(method, 3, false);
    std::set<std::string> keys;
    each_leaf(own, "", [&](const std::string& key) { keys.insert(key); });
    all.insert(keys.begin(), keys.end());
    for (const MethodKey& key : method_keys()) keys.insert(key.key);
    for (const std::string& key : keys) {
      if (key.rfind("automatic.", 0) == 0 || changed.count(key) > 0) continue;
      const std::optional<Method> other = with_another(key, own, base);
      if (!other) continue;
      changed.insert(key);
      EXPECT_EQ(tied_from(*other, 3, false) != from, is_physical(key)) << key;
    }
  }
  EXPECT_GT(changed.size(), 60u);
  for (const std::string& key : all)
    EXPECT_TRUE(changed.count(key) > 0 || key.rfind("automatic.", 0) == 0) << key << " was not tried";
}

TEST(TiedFrom, SaysStepAndReadingsToo) {
  const std::string from = tied_from(quick(), 3, false);
  EXPECT_GT(from.size(), 1000u);
  EXPECT_EQ(from, tied_from(quick(), 3, false));
  EXPECT_NE(from, tied_from(quick(), 3, true));
  EXPECT_NE(from, tied_from(quick(), 2, false));
}

TEST(StepAfterTying, IsTheFirstThatDoesSomethingElse) {
  const auto after = [](const Program& program) { return step_after_tying(program); };
  EXPECT_EQ(after({TieStep(), ReleaseStep(), MountStep(), BalanceStep(), PullStep()}), 3);
  EXPECT_EQ(after({TieStep(), PullStep()}), 1);
  EXPECT_EQ(after({TieStep(), ReleaseStep(), HoldStep(), MountStep(), PreloadStep(), PullStep()}), 4);
  EXPECT_EQ(after({TieStep(), ReleaseStep(), MountStep(), HoldStep()}), std::nullopt) << "nothing follows";
  EXPECT_EQ(after({BalanceStep(), PullStep()}), std::nullopt);
  EXPECT_EQ(after({HoldStep(), PullStep()}), std::nullopt) << "nothing is tied";
}

/// The tool, with a cache of this test's own.
class CachedTool : public OwnFolder {
 protected:
  static std::string line(const std::string& out, const std::string& more = "") {
    std::string words = "tighten --out '" + folder() + "/" + out + "' " + more;
    for (const std::string& one : kQuick) words += " --set '" + one + "'";
    return "KNOT_UTM_CACHE_LIMIT=100 KNOT_UTM_CACHE_DIR='" + folder() + "/cache' " + tool("tensile_test", words);
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
  EXPECT_EQ(std::distance(fs::directory_iterator(folder() + "/cache"), fs::directory_iterator()), 1);
  EXPECT_THAT(answer_of(line("c", "--quiet --overwrite")).text, Not(HasSubstr("cache"))) << "it is no warning";
}

TEST_F(CachedTool, RefusesALimitThatIsNoNumber) {
  const Answer answer =
      answer_of("KNOT_UTM_CACHE_LIMIT=1G " + tool("tensile_test", "straight --out '" + folder() + "/a'"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text,
            "tensile_test: KNOT_UTM_CACHE_LIMIT is 1G, but must be a whole number of MiB, 0 to 1073741824\n");
  EXPECT_FALSE(fs::exists(folder()));
}

}  // namespace
}  // namespace knot_utm
