#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "run/command.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kTighten = std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml";
//// A shipped material without a bending law of its own.
const std::string kElastic = "material=steel_wire";

/// Overrides of tighten.yaml that must not pass, and the key that the one line must name.
struct Wrong {
  std::vector<std::string> set;
  const char* key;
};

const std::string kPlastic = "material.bending_law=plastic", kFibres = "material.bending_law=frictional";

const std::vector<Wrong>& wrong_overrides() {
  static const std::vector<Wrong> kTable{
      // Keys
      {{"specimen.nots=3"}, "specimen.nots is no key of a method"},
      {{"report_=3"}, "report_ is no key of a method"},
      {{"physics.friction.mu=0.3"}, "physics.friction.mu"},
      {{"machine.load_cell.range=20"}, "machine.load_cell.range"},
      {{"program.pull.until.strain=0.1"}, "program.4.pull.until.strain"},
      {{"program.balance={now: true}"}, "program.3.balance.now"},
      {{"specimen.preload.value=3"}, "specimen.preload.value"},
      {{"program.9.pull.speed=1"}, "program.9.pull.speed"},
      {{"specimen={turns: 1, turns: 2}"}, "specimen.turns"},
      {{"program=[{hold: {duration: 1, speed: 0.1}}]"}, "program.0.hold.speed"},
      // Types
      {{"specimen=3"}, "specimen is 3"},
      {{"specimen.turns=1.5"}, "specimen.turns is 1.5"},
      {{"specimen.file=[a, b]"}, "specimen.file is [a, b]"},
      {{"physics.gravity=[0, 0]"}, "physics.gravity is [0, 0]"},
      {{"program={}"}, "program is {}"},
      {{"program=[]"}, "program is []"},
      {{"program=[pull]"}, "program.0 is pull"},
      {{"material="}, "material is missing"},
      {{"material=[nylon]"}, "material is [nylon]"},
      {{"program.pull.until.break=yes"}, "program.4.pull.until.break is yes"},
      {{"machine.load_cell.seed=-1"}, "machine.load_cell.seed is -1"},
      // Values, among them those of a wrong unit
      {{"specimen.knot=hitched"}, "specimen.knot is hitched"},
      {{"specimen.end_to_end=250"}, "specimen.end_to_end is 250"},
      {{"specimen.end_to_end=250 mm"}, "specimen.end_to_end is 250 mm"},
      {{"specimen.end_to_end=0,25"}, "specimen.end_to_end is 0,25"},
      {{"specimen.end_to_end=.nan"}, "specimen.end_to_end is .nan"},
      {{"specimen.edge_length=0"}, "specimen.edge_length is 0"},
      {{"specimen.refinement=9"}, "specimen.refinement is 9"},
      {{"material=rubber"}, "material is rubber"},
      {{"material.radius=3.175"}, "material.radius is 3.175"},
      {{"material.friction_coefficient=46"}, "material.friction_coefficient is 46"},
      {{"material.friction_couple=0.5"}, "material.friction_couple is 0.5"},
      {{"material.rolling_resistance=1.1"}, "material.rolling_resistance is 1.1"},
      {{"material={radius: 0.003}"}, "material.density is missing"},
      {{"machine.grips=hooks"}, "machine.grips is hooks"},
      {{"machine.stiffness=-5"}, "machine.stiffness is -5"},
      {{"machine.load_cell=1MN"}, "machine.load_cell is 1MN"},
      {{"machine.load_cell={capacity: 0}"}, "machine.load_cell.capacity is 0"},
      {{"machine.load_cell.accuracy=0.5"}, "machine.load_cell.accuracy is 0.5"},
      {{"machine.load_cell.floor=2"}, "machine.load_cell.floor is 2"},
      {{"machine.load_cell.overload=0.5"}, "machine.load_cell.overload is 0.5"},
      {{"program=[{push: {}}]"}, "program.0 is push"},
      {{"program.pull.speed=3.3"}, "program.4.pull.speed is 3.3"},
      {{"program=[{hold: {}}]"}, "program.0.hold.duration is missing"},
      {{"physics.contact.tolerance=5"}, "physics.contact.tolerance is 5"},
      {{"physics.twist=true"}, "physics.twist is true"},
      {{"physics.residual=1"}, "physics.residual is 1"},
      {{"report.units.force=kg"}, "report.units.force is kg"},
      {{"report.specimen_id=" + std::string(81, '1')}, "report.specimen_id is 1111"},
      {{"specification=good"}, "specification is good"},
      {{"specification.ended_by.min=3"}, "specification.ended_by"},
      {{"specification.peak_force={}"}, "specification.peak_force is missing"},
      {{"specification.peak_force={min: 3, max: 2}"}, "specification.peak_force is {min: 3, max: 2}"},
      {{"specification={peak_force: {min: 3}, peak_force: {max: 4}}"}, "specification.peak_force"},
      {{"ends.break_at_fraction_of_peak=40"}, "ends.break_at_fraction_of_peak is 40"},
      // Values that do not go together
      {{"specimen={knot_distance: 0.24, end_to_end: 0.25}"}, "specimen.end_to_end is 0.25"},
      {{"specimen.knot_distance=0.02"}, "specimen.knot_distance is 0.02"},
      {{"specimen.knot=overhand"}, "machine.grips is rollers"},
      {{"specimen.knot=file"}, "specimen.file is missing"},
      {{"specimen={knot: file, file: nowhere.csv}"}, "specimen.file: cannot read nowhere.csv"},
      {{"machine.load_cell.resolution=60000"}, "machine.load_cell.resolution is 60000"},
      {{"program=[{pull: {until: {break: false}}}]"}, "program.0.pull.until is missing"},
      {{"machine={grips: clamps, roller_friction: 0.2}"}, "machine.roller_friction is 0.2"},
      {{"machine={roller_rotation: free}"}, "machine.roller_rotation is free"},
      {{"physics.friction={law: smoothed, presliding: 0.01}"}, "physics.friction.presliding is 0.01"},
      {{"physics.friction={law: power, reference_pressure: 100}"}, "physics.friction.exponent is missing"},
      {{"program=[{hold: {duration: 1}}, {tie: {}}]"}, "program.1 is tie"},
      {{"program=[{release: {}}]"}, "program.0 is release"},
      {{"program.pull.until.load=60000"}, "program.4.pull.until.load is 60000"},
      {{"program=[{cycle: {count: 1}}]"}, "program.0.cycle"},
      {{"program=[{cycle: {extension: [0, 1], load: [0, 1], count: 1}}]"}, "program.0.cycle"},
      {{"program=[{cycle: {extension: [0.01, 0.02]}}]"}, "program.0.cycle"},
      {{"program=[{cycle: {extension: [0.02, 0.01], count: 1}}]"}, "program.0.cycle.extension is [0.02, 0.01]"},
      {{"program=[{cycle: {load: [0, 6e4], count: 1}}]"}, "program.0.cycle.load is 60000"},
      {{"program=[{hold: {duration: 1, load: 3}}]"}, "program.0.hold.load is 3"},
      {{"program=[{follow: {}}]"}, "program.0.follow.record is missing"},
      {{"program=[{follow: {record: nowhere.csv}}]"}, "program.0.follow.record: cannot read nowhere.csv"},
      {{"ends.load=60000"}, "ends.load is 60000"},
      {{"specimen.preload=0.05"}, "specimen.preload is 0.05"},
      {{"material.breaking_force=150"}, "material.breaking_force is 150"},
      {{"material.breaking={law: tension_and_bending, bending_share: 1}"}, "material.breaking.bending_share is 1"},
      {{"material.breaking.law=tension_and_bending"}, "material.breaking.bending_share is missing"},
      {{"material.breaking.bending_share=0.1"}, "material.breaking.bending_share is 0.1"},
      {{"material=steel_wire", "physics.twist=off"}, "physics.twist is off"},
      {{"physics.friction.at=centreline", "physics.twist=off"}, "physics.twist is off"},
      {{kPlastic}, "material.yield_strain is missing"},
      {{kPlastic, "material.yield_strain=0.05", "material.hardening=2"}, "material.hardening is 2"},
      {{kElastic, kFibres}, "material.friction_moment is missing"},
      {{kElastic, kFibres, "material.friction_moment=0.06", "material.stick_ratio=0.9"}, "material.stick_ratio is 0.9"},
      {{kElastic, "material.friction_moment=0.06"}, "material.friction_moment is 0.06"},
      {{"material.section=soft"}, "material.section"},
      {{"material.rolling_hysteresis=0.2"}, "material.rolling_hysteresis is 0.2"},
      {{"material.rolling_resistance=0.1", "material.friction_couple=0"}, "material.rolling_resistance is 0.1"},
      {{"material.rolling_resistance=0.1", "material.friction_coefficient=0"}, "material.rolling_resistance is 0.1"},
      {{"material.bending_stiffness=4e-5", "material.twisting_stiffness=3.9e-7"},
       "material.twisting_stiffness is 3.9e-07"},
  };
  return kTable;
}

std::string complaint(const std::string& file, const std::vector<std::string>& overrides = {}) {
  try {
    load_test(file, overrides);
  } catch (const InvalidInput& invalid) {
    return invalid.what();
  }
  return "nothing was wrong";
}

TEST(BadInput, IsNamedOnOneLineWithFileKeyAndValue) {
  for (const Wrong& wrong : wrong_overrides()) {
    std::string line = complaint(kTighten, wrong.set);
    line.erase(std::remove(line.begin(), line.end(), '"'), line.end());  // around words
    EXPECT_THAT(line, AllOf(HasSubstr("tighten.yaml: " + std::string(wrong.key)), Not(HasSubstr("\n"))))
        << testing::PrintToString(wrong.set);
  }
}

TEST(BadInput, SaysWhatIsAllowed) {
  const std::pair<const char*, std::string> kSaid[] = {
      {"specimen.prelaod=3", "did you mean specimen.preload?"},
      {"material.colour=red", "radius, density"},
      {"specimen.turns=one", "must be a whole number from 1 to 4"},
      {"specimen.preload=much", "must be a number from 1e-9 to 1e9 (in N), or auto"},
      {"physics.accuracy=best", "must be draft, normal or fine"},
      {"physics.contact.law=edge", "must be smooth"},
      {"physics.friction.slip_tolerance=0.01", "only with law: smoothed"},
      {"specimen.edge_length=0.0064", "twice the radius"},
      {"specimen.length=0.5", "only for knot: " + knots_with("length")},
      {"nonsense", "write key=value"}};
  for (const auto& [set, said] : kSaid) EXPECT_THAT(complaint(kTighten, {set}), HasSubstr(said)) << set;
}

TEST(BadInput, WhatIsLeftWithoutItsReasonIsAllowed) {
  for (const std::vector<std::string>& set : std::vector<std::vector<std::string>>{
           {kElastic, "physics.twist=off", "physics.friction.at=centreline"},
           {"material=pink_vps", "material.rolling_hysteresis=0.2"},
           {"material.rolling_resistance=0.1", "material.friction_coefficient=0", "machine.roller_friction=0.2"},
           {"material.bending_stiffness=4e-5", "material.twisting_stiffness=4e-7"},
           {kPlastic, "material.yield_strain=0.05"},
           {kElastic, kFibres, "material.friction_moment=0.06", "material.compaction=0.002"}})
    EXPECT_EQ(complaint(kTighten, set), "nothing was wrong") << testing::PrintToString(set);
}

TEST(BadInput, ARestShapeNeedsALawThatKeepsIt) {
  const auto of_file = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {kElastic, "material.bending_law=elastic"});
    return complaint(std::string(KNOT_UTM_SOURCE_DIR) + "/config/from_file.yaml", more);
  };
  const std::string curved = "specimen.natural_curvature=20";
  EXPECT_EQ(of_file({curved, "machine.grips=clamps"}), "nothing was wrong");
  EXPECT_THAT(of_file({curved, kPlastic, "material.yield_strain=0.05"}), HasSubstr("material.bending_law is plastic"));
  EXPECT_THAT(of_file({"specimen.natural_curvature=9000"}), HasSubstr("one over the radius"));
  EXPECT_THAT(of_file({curved, "physics.twist=off"}), HasSubstr("a rod that is curved at rest"));
  EXPECT_THAT(complaint(kTighten, {curved}), HasSubstr("only for knot: "));
}

class BadFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "materials"); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const char* name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("knot_utm_bad_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(BadFile, MissingEmptyBrokenOrNoMap) {
  EXPECT_THAT(complaint("/nowhere/method.yaml"), Eq("cannot read /nowhere/method.yaml: no such file"));
  EXPECT_THAT(complaint(folder_.string()), Eq("cannot read " + folder_.string() + ": is a directory"));
  EXPECT_THAT(complaint(write("long.yaml", std::string(70000, '#'))), HasSubstr("longer than 65536 characters"));
  EXPECT_THAT(complaint(write("empty.yaml", "")), HasSubstr("empty.yaml: the file is empty, but must be a map"));
  EXPECT_THAT(complaint(write("list.yaml", "[1, 2]")), HasSubstr("list.yaml: the file is [1, 2], but must be a map"));
  EXPECT_THAT(complaint(write("broken.yaml", "specimen:\n  knot: [\nmaterial: x")),
              AllOf(HasSubstr("broken.yaml: line "), HasSubstr("a list begins with \"[\" and has no \"]\""),
                    Not(HasSubstr("\n"))));
  for (const char* two : {"a: 1\n---\nb: 2\n", "---\na: 1\n--- # more\n", "a: 1\n...\nb: 2\n"})
    EXPECT_THAT(complaint(write("two.yaml", two)),
                HasSubstr("two.yaml: the file holds several YAML documents, but must be one"));
  for (const char* one : {"# first\n---\nspecimen: {}\n...\n# last\n", "%YAML 1.2\n---\nspecimen: {}\n"})
    EXPECT_THAT(complaint(write("one.yaml", one)), HasSubstr("material is missing"));
  EXPECT_THAT(complaint(write("latin.yaml", "specimen: {knot: straight}\n# n\xE9ud\n")),
              HasSubstr("latin.yaml: line 2: a letter is not in UTF-8; save the file as UTF-8"));
  EXPECT_THAT(complaint(write("tab.yaml", "specimen:\n\tknot: overhand\n")),
              HasSubstr("tab.yaml: line 2, column 6: the line is indented by a tab; use blanks"));
  EXPECT_THAT(complaint(write("list_with_tab.yaml", "specimen: [\n\tknot")), HasSubstr("a list begins with \"[\""));
  EXPECT_THAT(complaint(write("binary.yaml", std::string("\x00\x01\xff\xfe: {", 7))), HasSubstr("binary.yaml: "));
}

TEST_F(BadFile, AWrongMaterialFileIsNamedItself) {
  write("materials/odd.yaml", "radius: 3.175");
  const std::string text = complaint(write("method.yaml", "material: odd\nprogram: [{hold: {duration: 1}}]"));
  EXPECT_THAT(text, AllOf(HasSubstr("odd.yaml: radius is 3.175"), HasSubstr("0.05 m")));
}

/// Each of these once ended the process, or would take its memory.
TEST(BadInput, WhatHasNoEndIsRefused) {
  const auto complaint_of = [](const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      parse_method(text, "endless.yaml", overrides);
    } catch (const InvalidInput& invalid) {
      return std::string(invalid.what());
    }
    return std::string("nothing was wrong");
  };
  const std::string rest = "\nmaterial: nylon\nprogram: [{hold: {duration: 1}}]\n";
  const std::string itself = complaint_of("specimen: &a {knot: *a}" + rest);
  EXPECT_THAT(itself, AllOf(HasSubstr("endless.yaml: specimen.knot is {knot: {knot:"), HasSubstr("--list knots")));
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 15; ++i) {
    const std::string name = "a" + std::to_string(i), list = "*a" + std::to_string(i - 1);
    bomb += name + ": &" + name + " [" + list + "," + list + "," + list + "," + list + "," + list + "]\n";
  }
  EXPECT_THAT(complaint_of(bomb + "specimen: {knot: *a14}" + rest), HasSubstr("specimen.knot is [["));
  EXPECT_THAT(complaint_of("specimen: " + std::string(1000, '[')), HasSubstr("nested too deeply"));
  EXPECT_THAT(complaint_of("specimen: {}" + rest, {"specimen.turns=" + std::string(1000, '[')}),
              AllOf(HasSubstr("the value is not YAML"), HasSubstr("nested too deeply")));
  std::string key;
  for (int i = 0; i < 30000; ++i) key += "a.";
  EXPECT_THAT(complaint_of("specimen: {}" + rest, {key + "b=1"}),
              HasSubstr("no key of a method has more than 8 parts"));
  EXPECT_THAT(complaint_of("# " + std::string(70000, 'x') + rest), HasSubstr("longer than 65536 characters"));
  for (const std::string& line : {itself, complaint_of("specimen: {knot: " + std::string(5000, 'x') + "}" + rest)}) {
    EXPECT_LT(line.size(), 1000u);
  }
}

TEST(BadInput, ForeignTextLeavesTheLineWhole) {
  EXPECT_EQ(shown("two\r\nlines\x1b[2J"), "two  lines [2J");
  EXPECT_EQ(shown(std::string("a\0b", 3)), "a b");
  EXPECT_EQ(shown(std::string(501, 'x')), std::string(500, 'x') + "...");
  EXPECT_EQ(InvalidInput("file\n", "key\n", "value\n", "more").what(),
            std::string("file : key  is value , but must be more"));
}

/// A value of a key of `specimen` that is not its plain one, in the range of each number.
std::string other_value(const Method& method, const std::string& key) {
  if (!unit_of_key(method, "specimen." + key).empty()) return "2";
  return key == "handedness" ? "opposite" : "shape.csv";
}

TEST(BadInput, EveryKeyOfAKnotIsRefusedOfTheOthers) {
  std::set<std::string> seen;
  for (const fs::directory_entry& entry : fs::directory_iterator(std::string(KNOT_UTM_SOURCE_DIR) + "/config")) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string file = entry.path().string();
    const Method method = load_method(file);
    const Knot& knot = knot_of(method.specimen);
    seen.insert(knot.about().name);
    for (const Knot* other : knots())
      for (const std::string& key : other->about().keys) {
        if (knot.has(key)) continue;
        const std::string line = complaint(file, {"specimen." + key + "=" + other_value(method, key)});
        EXPECT_THAT(line,
                    AllOf(HasSubstr(": specimen." + key + " is "), HasSubstr("only for knot: " + knots_with(key))));
      }
  }
  EXPECT_EQ(seen.size(), knots().size());
}

/// A pull that would take the rod off its post. The shipped method's own is allowed.
TEST(BadInput, APullThatIsLongerThanTheTailOfACapstan) {
  const std::string capstan = std::string(KNOT_UTM_SOURCE_DIR) + "/config/capstan.yaml";
  EXPECT_EQ(complaint(capstan), "nothing was wrong");
  EXPECT_EQ(complaint(capstan, {"program.pull.until.extension=0.2", "specimen.tail=0.25"}), "nothing was wrong");
  EXPECT_THAT(complaint(capstan, {"program.pull.until.extension=0.2"}),
              AllOf(HasSubstr("program.1.pull.until.extension is 0.2"), HasSubstr("a longer specimen.tail")));
}

/// The command itself: exit code 2, one line, nothing written.
TEST_F(BadFile, TheCommandSaysItInOneLineAndWritesNothing) {
  const fs::path out = folder_ / "out";
  const std::string file = "'" + kTighten + "'";
  // Refused as the method is read, as its records and its specification are, and as its specimen is made.
  const std::vector<std::string> lines{file + " --set specimen.turns=5",
                                       file + " --set 'program=[{follow: {record: nowhere.csv}}]'",
                                       file + " --set specification.peek_force.min=3",
                                       file + " --set 'specimen={knot: file, file: nowhere.csv}'",
                                       file + " --no-such-option",
                                       "/nowhere/method.yaml",
                                       ""};
  for (const std::string& line : lines) {
    const Answer answer = answer_of(tool("tensile_test", line + " --out '" + out.string() + "'"));
    EXPECT_EQ(answer.code, 2) << line;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << line << "\n" << answer.text;
    EXPECT_FALSE(fs::exists(out)) << line;
  }
}

}  // namespace
}  // namespace knot_utm
