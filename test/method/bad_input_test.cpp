// Wrong input, one line each: file, key, and exit code 2. The whole sentences of ten of them are in
// plain_messages_test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "complaint.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::Not;

std::string shipped(const std::string& name) { return std::string(KNOT_UTM_SOURCE_DIR) + "/config/" + name + ".yaml"; }

/// Settings of a shipped method that must not pass, with a blank and a bar between them, and how the message goes on
/// after the file's name.
struct Wrong {
  const char* settings;
  const char* begin;
  const char* method = "tighten";
};

const Wrong kWrong[] = {
    // Keys
    {"specimen.nots=3", "specimen.nots is no key of a method"},
    {"speciment.knot=overhand", "speciment is no key of a method"},
    {"physics.friction.mu=0.3", "physics.friction.mu is no key"},
    {"material.colour=red", "material.colour is no key"},
    {"program.pull.until.strain=0.1", "program.4.pull.until.strain"},
    {"program.balance={now: true}", "program.3.balance.now"},
    {"specimen.preload.value=3", "specimen.preload.value"},
    {"program.9.pull.speed=1", "program.9.pull.speed"},
    {"specimen={turns: 1, turns: 2}", "specimen.turns"},
    // Types
    {"specimen=3", "specimen is 3"},
    {"specimen.turns=one", "specimen.turns is \"one\""},
    {"specimen.turns=1.5", "specimen.turns is 1.5"},
    {"specimen.file=[a, b]", "specimen.file"},
    {"physics.gravity=9.81", "physics.gravity is 9.81"},
    {"physics.gravity=[0, 0]", "physics.gravity is [0, 0]"},
    {"program={}", "program"},
    {"program=[pull]", "program.0"},
    {"material=", "material is missing"},
    {"material=[nylon]", "material"},
    // Values, among them those of a wrong unit
    {"specimen.knot=hitched", "specimen.knot"},
    {"specimen.turns=5", "specimen.turns is 5"},
    {"specimen.end_to_end=250", "specimen.end_to_end is 250"},
    {"specimen.end_to_end=250 mm", "specimen.end_to_end"},
    {"specimen.end_to_end=.nan", "specimen.end_to_end"},
    {"specimen.preload=-1", "specimen.preload is -1"},
    {"specimen.edge_length=0", "specimen.edge_length is 0"},
    {"material=rubber", "material is \"rubber\""},
    {"material.radius=3.175", "material.radius is 3.175"},
    {"material={radius: 0.003}", "material.density is missing"},
    {"material.friction_couple=0.5", "material.friction_couple is 0.5"},
    {"material.rolling_resistance=1.1", "material.rolling_resistance is 1.1"},
    {"machine.grips=hooks", "machine.grips"},
    {"machine.stiffness=-5", "machine.stiffness is -5"},
    {"machine.load_cell=1MN", "machine.load_cell"},
    {"machine.load_cell.accuracy=0.5", "machine.load_cell.accuracy is 0.5"},
    {"machine.load_cell.seed=-1", "machine.load_cell.seed is -1"},
    {"program=[{push: {}}]", "program.0"},
    {"program.pull.speed=3.3", "program.4.pull.speed is 3.3"},
    {"program.pull.until.break=yes", "program.4.pull.until.break"},
    {"program=[{hold: {}}]", "program.0.hold.duration is missing"},
    {"physics.friction.law=coulomb", "physics.friction.law is \"coulomb\""},
    {"physics.max_step=0", "physics.max_step is 0"},
    {"report.units.force=kg", "report.units.force"},
    {"specification.peek_force.min=3", "specification.peek_force"},
    {"specification.ended_by.min=3", "specification.ended_by"},
    {"specification.peak_force={}", "specification.peak_force is missing"},
    {"specification.peak_force={min: 3, max: 2}", "specification.peak_force is {min: 3, max: 2}"},
    {"ends.break_at_fraction_of_peak=40", "ends.break_at_fraction_of_peak is 40"},
    // Values that do not go together
    {"specimen.edge_length=0.0064", "specimen.edge_length is 0.0064"},
    {"specimen={knot_distance: 0.24, end_to_end: 0.25}", "specimen.end_to_end is 0.25"},
    {"specimen.knot=overhand", "machine.grips"},
    {"specimen.knot=capstan", "machine.grips"},
    {"specimen.knot=file", "specimen.file is missing"},
    {"specimen={knot: file, file: nowhere.csv}", "specimen.file: cannot read"},
    {"specimen.preload=0.05", "specimen.preload is 0.05"},
    {"specimen.length=0.5", "specimen.length is 0.5"},
    {"machine.load_cell.resolution=60000", "machine.load_cell.resolution is 60000"},
    {"machine={grips: clamps, roller_friction: 0.2}", "machine.roller_friction is 0.2"},
    {"program=[{pull: {}}]", "program.0.pull.until is missing"},
    {"program=[{hold: {duration: 1}}, {tie: {}}]", "program.1"},
    {"program=[{release: {}}]", "program.0"},
    {"program.pull.until.load=60000", "program.4.pull.until.load is 60000"},
    {"program=[{cycle: {count: 1}}]", "program.0.cycle"},
    {"program=[{cycle: {extension: [0.02, 0.01], count: 1}}]", "program.0.cycle.extension"},
    {"program=[{cycle: {load: [0, 6e4], count: 1}}]", "program.0.cycle.load"},
    {"program=[{hold: {duration: 1, load: 3}}]", "program.0.hold.load is 3"},
    {"program=[{follow: {record: nowhere.csv}}]", "program.0.follow.record: cannot read"},
    {"ends.load=60000", "ends.load is 60000"},
    {"physics.friction={law: memory, exponent: 0.5}", "physics.friction.exponent is 0.5"},
    {"physics.friction={law: power, reference_pressure: 100}", "physics.friction.exponent is missing"},
    {"physics.twist=off", "physics.twist is off"},
    {"material.section=soft", "material.section"},
    {"material.hardening=0.5", "material.hardening is 0.5"},
    {"material.bending_law=plastic", "material.yield_strain is missing"},
    {"material=steel_wire | material.bending_law=frictional", "material.friction_moment is missing"},
    {"material=steel_wire | material.friction_moment=0.06", "material.friction_moment is 0.06"},
    {"material.rolling_resistance=0.1 | material.friction_couple=0", "material.rolling_resistance is 0.1"},
    {"material.bending_stiffness=4e-5 | material.twisting_stiffness=3.9e-7",
     "material.twisting_stiffness is 3.9e-07, but must be at least a hundredth of bending_stiffness, 4e-07 N m2"},
    {"material.breaking.law=tension_and_bending", "material.breaking.bending_share is missing"},
    {"material.breaking.bending_share=0.1", "material.breaking.bending_share is 0.1"},
    {"material.breaking={law: tension_and_bending, bending_share: 1}", "material.breaking.bending_share is 1"},
    {"material.breaking_force=150", "material.breaking_force is 150"},
    {"machine.roller_diameter=0.3 | specimen={knot_distance: 0.12, end_to_end: 0.22}",
     "machine.roller_diameter is 0.3"},
    // Of other methods
    {"specimen.handedness=opposite", "specimen.handedness", "straight"},
    {"specimen.preload=20", "specimen.preload is 20", "straight"},
    {"machine.roller_diameter=0.05", "machine.roller_diameter is 0.05", "straight"},
    {"program.0={tie: {}}", "program.0", "straight"},
    {"program.0={mount: {}}", "program.0", "straight"},
    {"program.0={twist: {turns: 0}}", "program.0.twist.turns is 0", "straight"},
    {"program.pull.until.extension=0.2", "program.1.pull.until.extension is 0.2", "capstan"},
    {"specimen.knot=reef | other_material=nylon | other_material.twisting_stiffness=1e-9",
     "other_material.twisting_stiffness is 1e-09", "knot"},
    {"specimen.natural_curvature=20 | material.bending_law=plastic | material.yield_strain=0.05",
     "specimen.natural_curvature is 20", "from_file"},
};

/// What can be set beside these, which no check is to forbid.
const Wrong kRight[] = {
    {"physics.twist=off | material=steel_wire | physics.friction.at=centreline", ""},
    {"material.rolling_resistance=0.1", ""},
    {"material.bending_stiffness=4e-5 | material.twisting_stiffness=4e-7", ""},
    {"material.bending_law=plastic | material.yield_strain=0.05", ""},
    {"material=steel_wire | material.bending_law=frictional | material.friction_moment=0.06", ""},
    {"program.pull.until.extension=0.2 | specimen.tail=0.25", "", "capstan"},
    {"material=steel_wire | specimen.natural_curvature=20 | machine.grips=clamps", "", "from_file"},
};

std::string complaint(const std::string& file, const std::vector<std::string>& overrides = {}) {
  return complaint_of([&] { load_test(file, overrides); });
}

std::string complaint(const Wrong& wrong) {
  std::vector<std::string> settings;
  const std::string all = wrong.settings, between = " | ";
  for (std::size_t begin = 0; begin <= all.size();) {
    const std::size_t end = std::min(all.find(between, begin), all.size());
    settings.push_back(all.substr(begin, end - begin));
    begin = end + between.size();
  }
  return complaint(shipped(wrong.method), settings);
}

TEST(BadInput, IsNamedOnOneLineWithFileAndKey) {
  for (const Wrong& wrong : kWrong)
    EXPECT_THAT(complaint(wrong),
                AllOf(HasSubstr(std::string(wrong.method) + ".yaml: " + wrong.begin), Not(HasSubstr("\n"))))
        << wrong.settings;
  for (const Wrong& right : kRight) EXPECT_EQ(complaint(right), "") << right.settings;
}

class BadFile : public MadeFolder {
 protected:
  static std::string write(const char* name, const std::string& text) {
    std::ofstream(in(name)) << text;
    return in(name);
  }
};

TEST_F(BadFile, MissingEmptyBrokenOrNoMap) {
  EXPECT_THAT(complaint("/nowhere/method.yaml"), Eq("cannot read /nowhere/method.yaml: no such file"));
  EXPECT_THAT(complaint(folder()), Eq("cannot read " + folder() + ": is a directory"));
  EXPECT_THAT(complaint(write("long.yaml", std::string(70000, '#'))), HasSubstr("longer than 65536 characters"));
  EXPECT_THAT(complaint(write("empty.yaml", "")), HasSubstr("empty.yaml: the file is empty, but must be a map"));
  EXPECT_THAT(complaint(write("list.yaml", "[1, 2]")), HasSubstr("list.yaml: the file is a list, but must be a map"));
  EXPECT_THAT(complaint(write("text.yaml", "root:x:0:0")),
              HasSubstr("text.yaml: the file is a text, but must be a map"));
  EXPECT_THAT(
      complaint(write("broken.yaml", "specimen:\n  knot: [\nmaterial: x")),
      AllOf(HasSubstr("broken.yaml: line "), HasSubstr("end of sequence flow not found"), Not(HasSubstr("\n"))));
  for (const char* two : {"a: 1\n---\nb: 2\n", "---\na: 1\n--- # more\n", "a: 1\n...\nb: 2\n"})
    EXPECT_THAT(complaint(write("two.yaml", two)),
                HasSubstr("two.yaml: the file holds several YAML documents, but must be one"));
  for (const char* one : {"# first\n---\nspecimen: {}\n...\n# last\n", "%YAML 1.2\n---\nspecimen: {}\n"})
    EXPECT_THAT(complaint(write("one.yaml", one)), HasSubstr("material is missing"));
  EXPECT_THAT(complaint(write("latin.yaml", "specimen: {knot: straight}\n# n\xE9ud\n")),
              HasSubstr("latin.yaml: line 2: a letter is not in UTF-8; save the file as UTF-8"));
  EXPECT_THAT(complaint(write("binary.yaml", std::string("\x00\x01\xff\xfe: {", 7))), HasSubstr("binary.yaml: "));
}

TEST_F(BadFile, AWrongMaterialFileIsNamedItself) {
  fs::create_directories(in("materials"));
  write("materials/odd.yaml", "radius: 3.175");
  const std::string text = complaint(write("method.yaml", "material: odd\nprogram: [{hold: {duration: 1}}]"));
  EXPECT_THAT(text, AllOf(HasSubstr("odd.yaml: radius is 3.175"), HasSubstr("0.05 m")));
}

/// Each of these once ended the process, or would take its memory.
TEST(BadInput, WhatHasNoEndIsRefused) {
  const auto said_of = [](const std::string& text, const std::vector<std::string>& overrides = {}) {
    return complaint_of([&] { parse_method(text, "endless.yaml", overrides); });
  };
  const std::string rest = "\nmaterial: nylon\nprogram: [{hold: {duration: 1}}]\n";
  const std::string itself = said_of("specimen: &a {knot: *a}" + rest);
  EXPECT_THAT(itself, AllOf(HasSubstr("endless.yaml: specimen.knot is {knot: {knot:"), HasSubstr("--list knots")));
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 15; ++i) {
    const std::string name = "a" + std::to_string(i), list = "*a" + std::to_string(i - 1);
    bomb += name + ": &" + name + " [" + list + "," + list + "," + list + "," + list + "," + list + "]\n";
  }
  EXPECT_THAT(said_of(bomb + "specimen: {knot: *a14}" + rest), HasSubstr("specimen.knot is [["));
  EXPECT_THAT(said_of("specimen: " + std::string(1000, '[')), HasSubstr("nested too deeply"));
  EXPECT_THAT(said_of("specimen: {}" + rest, {"specimen.turns=" + std::string(1000, '[')}),
              AllOf(HasSubstr("the value is not YAML"), HasSubstr("nested too deeply")));
  std::string key;
  for (int i = 0; i < 30000; ++i) key += "a.";
  EXPECT_THAT(said_of("specimen: {}" + rest, {key + "b=1"}), HasSubstr("no key of a method has more than 8 parts"));
  EXPECT_THAT(said_of("# " + std::string(70000, 'x') + rest), HasSubstr("longer than 65536 characters"));
  for (const std::string& line : {itself, said_of("specimen: {knot: " + std::string(5000, 'x') + "}" + rest)}) {
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
  const std::map<std::string, std::string> words{
      {"handedness", "opposite"}, {"file", "shape.csv"}, {"closed", "true"}, {"natural_towards", "y"}};
  return words.at(key);
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
        // The ends of no rod can be joined.
        EXPECT_THAT(line, AllOf(HasSubstr(": specimen." + key + " is "),
                                HasSubstr(key == "closed" ? "must be false" : "only for knot: " + knots_with(key))));
      }
  }
  EXPECT_EQ(seen.size(), knots().size());
}

/// The command itself: exit code 2, one line, nothing written.
TEST_F(BadFile, TheCommandSaysItInOneLineAndWritesNothing) {
  const std::string out = in("out"), file = "tighten";
  // Refused as the method is read, as its records and its specification are, and as its specimen is made.
  const std::vector<std::string> lines{file + " --set specimen.turns=5",
                                       file + " --set 'program=[{follow: {record: nowhere.csv}}]'",
                                       file + " --set specification.peek_force.min=3",
                                       file + " --set 'specimen={knot: file, file: nowhere.csv}'",
                                       file + " --no-such-option",
                                       "/nowhere/method.yaml",
                                       ""};
  for (const std::string& line : lines) {
    const Answer answer = answer_of(tool("tensile_test", line + " --out '" + out + "'"));
    EXPECT_EQ(answer.code, 2) << line;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << line << "\n" << answer.text;
    EXPECT_FALSE(fs::exists(out)) << line;
  }
}

}  // namespace
}  // namespace knot_utm
