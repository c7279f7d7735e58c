#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
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
/// A shipped material without a bending law of its own.
const std::string kElastic = "material=steel_wire";

/// An override of tighten.yaml that must not pass, and what the one line must name: key, value and what is allowed.
struct Wrong {
  const char* set;
  const char* key;
  const char* value;
  std::string allowed;
};

/// What a message allows where a key has an effect on some knots only.
std::string of_knots(const char* key) { return "only for knot: " + knots_with(key); }

const std::vector<Wrong>& wrong_overrides() {
  static const std::vector<Wrong> kTable{
      // Keys
      {"specimen.nots=3", "specimen.nots is no key of a method", "", "the keys of specimen are knot, handedness"},
      {"speciment.knot=overhand", "speciment is no key of a method", "", "did you mean specimen?"},
      {"specimen.prelaod=3", "specimen.prelaod is no key of a method", "", "did you mean specimen.preload?"},
      {"report_=3", "report_ is no key of a method", "", "did you mean report?"},
      {"physics.friction.mu=0.3", "physics.friction.mu", "", "the keys of physics.friction are law, "},
      {"material.colour=red", "material.colour", "", "radius, density"},
      {"machine.load_cell.range=20", "machine.load_cell.range", "", "capacity, sampling_rate"},
      {"program.pull.until.strain=0.1", "program.4.pull.until.strain", "", "extension, load, time and break"},
      {"program.0.tie.force=3", "program.0.tie.force", "", "speed"},
      {"program.balance={now: true}", "program.3.balance.now", "", "takes no keys"},
      {"specimen.preload.value=3", "specimen.preload.value", "", "preload is a single value and has no keys"},
      {"program.9.pull.speed=1", "program.9.pull.speed", "9", "from 0 to 4"},
      {"nonsense", "--set", "nonsense", "key=value"},
      {"=3", "--set", "=3", "key=value"},
      {"specimen.turns=[1", "--set specimen.turns=[1", "", "a list begins with"},
      {"specimen={turns: 1, turns: 2}", "specimen.turns", "", "stands twice"},
      // Types
      {"material.stretching_law=hooke", "material.stretching_law", "hooke", "linear or neo_hookean"},
      {"specimen=3", "specimen", "3", "a map"},
      {"specimen.turns=one", "specimen.turns", "one", "a whole number from 1 to 4"},
      {"specimen.turns=1.5", "specimen.turns", "1.5", "a whole number from 1 to 4"},
      {"specimen.file=[a, b]", "specimen.file", "[a, b]", "a text"},
      {"physics.gravity=9.81", "physics.gravity", "9.81", "[x, y, z]"},
      {"physics.gravity=[0, 0]", "physics.gravity", "[0, 0]", "[x, y, z]"},
      {"program={}", "program", "{}", "a list of steps"},
      {"program=[]", "program", "[]", "a list of steps"},
      {"program=[pull]", "program.0", "pull", "one step, {NAME: {...}}"},
      {"material=", "material is missing", "", "green_vps, nylon"},
      {"material=[nylon]", "material", "[nylon]", "green_vps, nylon"},
      // Values, among them those of a wrong unit
      {"specimen.knot=hitched", "specimen.knot", "hitched", "one of the knots that tensile_test --list knots shows"},
      {"specimen.turns=5", "specimen.turns", "5", "1 to 4"},
      {"specimen.end_to_end=250", "specimen.end_to_end", "250", "m"},
      {"specimen.end_to_end=250 mm", "specimen.end_to_end", "250 mm", "m"},
      {"specimen.end_to_end=0,25", "specimen.end_to_end", "0,25", "m"},
      {"specimen.end_to_end=.nan", "specimen.end_to_end", ".nan", "m"},
      {"specimen.preload=-1", "specimen.preload", "-1", "1e-9 to 1e9 N, or auto"},
      {"specimen.preload=much", "specimen.preload", "much", "a number from 1e-9 to 1e9 (in N), or auto"},
      {"specimen.edge_length=0", "specimen.edge_length", "0", "m"},
      {"specimen.refinement=9", "specimen.refinement", "9", "1 to 8"},
      {"material=rubber", "material", "rubber", "green_vps, nylon, pink_vps"},
      {"material.radius=3.175", "material.radius", "3.175", "0.05 m"},
      {"material.density=-1", "material.density", "-1", "kg/m3"},
      {"material.friction_coefficient=46", "material.friction_coefficient", "46", "0 to 5"},
      {"material={radius: 0.003}", "material.density is missing", "", "kg/m3"},
      {"machine.grips=hooks", "machine.grips", "hooks", "rollers, nodes or clamps"},
      {"machine.stiffness=-5", "machine.stiffness", "-5", "at least 1 N/m"},
      {"machine.load_cell=1MN", "machine.load_cell", "1MN", "20N, 50kN"},
      {"machine.load_cell={capacity: 0}", "machine.load_cell.capacity", "0", "N"},
      {"machine.load_cell.sampling_rate=0", "machine.load_cell.sampling_rate", "0", "Hz"},
      {"machine.load_cell.accuracy=0.5", "machine.load_cell.accuracy", "0.5", "0 to 0.1 of the reading"},
      {"machine.load_cell.floor=2", "machine.load_cell.floor", "2", "0 to 1 of capacity"},
      {"machine.load_cell.overload=0.5", "machine.load_cell.overload", "0.5", "at least 1 of capacity"},
      {"machine.load_cell.seed=-1", "machine.load_cell.seed", "-1", "a whole number"},
      {"program=[{push: {}}]", "program.0", "push",
       "tie, release, mount, preload, balance, pull, hold, cycle, return, follow or twist"},
      {"program.pull.speed=3.3", "program.4.pull.speed", "3.3", "0.5 m/s"},
      {"program.pull.until.break=yes", "program.4.pull.until.break", "yes", "true or false"},
      {"program=[{hold: {}}]", "program.0.hold.duration is missing", "", "(in s)"},
      {"physics.friction.law=coulomb", "physics.friction.law", "coulomb", "must be memory, "},
      {"physics.contact.law=edge", "physics.contact.law", "edge", "smooth"},
      {"physics.contact.tolerance=5", "physics.contact.tolerance", "5", "of the radius"},
      {"physics.twist=true", "physics.twist", "true", "auto, on or off"},
      {"physics.accuracy=best", "physics.accuracy", "best", "draft, normal or fine"},
      {"physics.max_step=0", "physics.max_step", "0", "s"},
      {"physics.residual=1", "physics.residual", "1", "of k_b/h2"},
      {"report.units.force=kg", "report.units.force", "kg", "N, kN or lbf"},
      {"report.units.length=cm", "report.units.length", "cm", "mm, in or m"},
      {"report.notes=[a, b]", "report.notes", "[a, b]", "a text"},
      {"report.specimen_id=111111111111111111111111111111111111111111111111111111111111111111111111111111111",
       "report.specimen_id", "111111111111111111111111111111111111111111111111111111111111111111111111111111111",
       "at most 80 characters"},
      {"specification=good", "specification", "good", "a map such as {peak_force: {min: 100}}"},
      {"specification.peek_force.min=3", "specification.peek_force", "", "did you mean specification.peak_force?"},
      {"specification.ended_by.min=3", "specification.ended_by", "", "the keys of specification are"},
      {"specification.peak_force=3", "specification.peak_force", "3", "a map"},
      {"specification.peak_force={}", "specification.peak_force is missing", "", "min, max or both"},
      {"specification.peak_force={least: 3}", "specification.peak_force.least", "", "are min and max"},
      {"specification.peak_force={min: 3, max: 2}", "specification.peak_force", "{min: 3, max: 2}",
       "no larger than its max"},
      {"specification={peak_force: {min: 3}, peak_force: {max: 4}}", "specification.peak_force", "", "stands twice"},
      // Values that do not go together
      {"specimen.edge_length=0.0064", "specimen.edge_length", "0.0064", "twice the radius"},
      {"specimen={knot_distance: 0.24, end_to_end: 0.25}", "specimen.end_to_end", "0.25",
       "knot_distance plus 12 radii"},
      {"specimen.knot_distance=0.02", "specimen.knot_distance", "0.02", "12 radii"},
      {"specimen.knot=overhand", "machine.grips", "rollers", "rollers hold only a loop"},
      {"specimen.knot=file", "specimen.file is missing", "", "a CSV file"},
      {"specimen={knot: file, file: nowhere.csv}", "specimen.file: cannot read", "nowhere.csv", "no such file"},
      {"specimen.knot=knot.yaml", "specimen.knot: cannot read", "knot.yaml", "no such file"},
      {"machine.load_cell.resolution=60000", "machine.load_cell.resolution", "60000", "less than capacity"},
      {"program=[{pull: {}}]", "program.0.pull.until is missing", "", "extension, load, time and break"},
      {"program=[{pull: {until: {break: false}}}]", "program.0.pull.until is missing", "", "one or more of"},
      {"specimen.turns=2", "specimen.turns", "2", of_knots("turns")},
      {"specimen.length=0.5", "specimen.length", "0.5", of_knots("length")},
      {"specimen.file=shape.csv", "specimen.file", "shape.csv", of_knots("file")},
      {"machine={grips: clamps, roller_friction: 0.2}", "machine.roller_friction", "0.2", "only with grips: rollers"},
      {"machine={roller_rotation: free}", "machine.roller_rotation", "free", "only with a roller_friction above 0"},
      {"specimen.knot=capstan", "machine.grips", "rollers", "nodes or clamps"},
      {"machine={roller_friction: 0.1, roller_rotation: spun}", "machine.roller_rotation", "spun", "fixed or free"},
      {"physics.friction.slip_tolerance=0.01", "physics.friction.slip_tolerance", "0.01", "only with law: smoothed"},
      {"physics.friction={law: stribeck}", "physics.friction.law", "stribeck", "memory, smoothed, power or rate"},
      {"physics.friction={law: memory, exponent: 0.5}", "physics.friction.exponent", "0.5", "only with law: power"},
      {"physics.friction={law: power, reference_pressure: 100}", "physics.friction.exponent", "",
       "is missing: give a number from 0.5 to 1 (of the pressure), which law: power needs"},
      {"material.hardening=0.5", "material.hardening", "0.5", "only with bending_law: plastic"},
      {"material.twisting_law=linear", "material.twisting_law is no key", "", "the keys of material are"},
      {"physics.friction.at=skin", "physics.friction.at", "skin", "surface or centreline"},
      {"material.section=square", "material.section", "square", "round or soft"},
      {"material.section=soft", "material.section", "17200", "near the 4 of a solid rod"},
      {"material.friction_couple=0.5", "material.friction_couple", "0.5", "must be 0, 1, or auto"},
      {"material.friction_couple=1.5", "material.friction_couple", "1.5", "must be 0, 1, or auto"},
      {"material.friction_couple=all", "material.friction_couple", "all", "must be 0, 1, or auto"},
      {"physics.friction={law: smoothed, presliding: 0.01}", "physics.friction.presliding", "0.01",
       "only with law: memory"},
      {"program=[{hold: {duration: 1}}, {tie: {}}]", "program.1", "tie", "can only be the first step"},
      {"program=[{release: {}}]", "program.0", "release", "right after tie"},
      {"program.pull.until.load=60000", "program.4.pull.until.load", "60000", "capacity, 50000 N"},
      {"program=[{cycle: {count: 1}}]", "program.0.cycle", "neither extension nor load", "give one of them"},
      {"specimen.preload=0.05", "specimen.preload", "0.05", "does not move the coils, which close only at 2.27 N"},
      {"material.breaking={law: tension_and_bending, bending_share: 1}", "material.breaking.bending_share", "1",
       "so small that the loose coil from which a knot is tied bears specimen.preload, 150 N"},
      {"material.breaking.law=crushing", "material.breaking.law", "crushing", "tension or tension_and_bending"},
      {"material.breaking.law=tension_and_bending", "material.breaking.bending_share is missing", "",
       "a number from 0 to 1, which law: tension_and_bending needs"},
      {"material.breaking.bending_share=0.1", "material.breaking.bending_share", "0.1",
       "only with law: tension_and_bending"},
      {"material.breaking={law: tension_and_bending, bending_share: 1.5}", "material.breaking.bending_share", "1.5",
       "0 to 1"},
      {"material={radius: 0.003, density: 1e3, stretching_stiffness: 1e4, bending_stiffness: 1e-4, "
       "twisting_stiffness: 1e-4, friction_coefficient: 0.4, breaking: {law: tension_and_bending, bending_share: 0}}",
       "material.breaking_force is missing", "", "which material.breaking.law: tension_and_bending needs"},
      {"analysis.margin=maybe", "analysis.margin", "maybe", "true or false"},
      {"analysis={margin: true, program: 1}", "analysis.program is no key of a method", "",
       "the keys of analysis are margin"},
      {"material.breaking_force=150", "material.breaking_force", "150", "more than specimen.preload, 150 N"},
      {"program=[{cycle: {extension: [0, 1], load: [0, 1], count: 1}}]", "program.0.cycle", "both extension and load",
       "give one of them"},
      {"program=[{cycle: {extension: [0.01, 0.02]}}]", "program.0.cycle", "", "count, time or both"},
      {"program=[{cycle: {extension: [0.02, 0.01], count: 1}}]", "program.0.cycle.extension", "[0.02, 0.01]",
       "low below high"},
      {"program=[{cycle: {load: [0, 6e4], count: 1}}]", "program.0.cycle.load", "60000", "capacity"},
      {"program=[{hold: {duration: 1, load: 3}}]", "program.0.hold.load", "3", "only with control: load"},
      {"program=[{hold: {duration: 1, speed: 0.1}}]", "program.0.hold.speed", "", "the keys of program.0.hold are"},
      {"program=[{follow: {}}]", "program.0.follow.record is missing", "", "a curve.csv, or raw data"},
      {"program=[{follow: {record: nowhere.csv}}]", "program.0.follow.record: cannot read", "nowhere.csv",
       "no such file"},
      {"ends.load=60000", "ends.load", "60000", "capacity, 50000 N"},
      {"ends.break_at_fraction_of_peak=40", "ends.break_at_fraction_of_peak", "40", "0 to 0.99"},
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

TEST(BadInput, IsNamedOnOneLineWithFileKeyValueAndWhatIsAllowed) {
  for (const Wrong& wrong : wrong_overrides()) {
    EXPECT_THAT(complaint(kTighten, {wrong.set}),
                AllOf(HasSubstr(std::string(wrong.key).rfind("--", 0) == 0 ? "" : "tighten.yaml: "),
                      HasSubstr(wrong.key), HasSubstr(wrong.value), HasSubstr(wrong.allowed), Not(HasSubstr("\n"))))
        << wrong.set;
  }
}

TEST(BadInput, FrictionAtTheSurfaceNeedsTwist) {
  EXPECT_THAT(complaint(kTighten, {kElastic, "physics.twist=off"}),
              AllOf(HasSubstr("tighten.yaml: physics.twist is off"),
                    HasSubstr("friction at the surface twists the rod"), Not(HasSubstr("\n"))));
  EXPECT_EQ(complaint(kTighten, {kElastic, "physics.twist=off", "physics.friction.at=centreline"}),
            "nothing was wrong");
}

TEST(BadInput, WithoutTwistSaysAllThatNeedsIt) {
  EXPECT_THAT(complaint(kTighten, {"physics.twist=off"}),
              AllOf(HasSubstr("friction at the surface twists the rod, and a rod of this material.bending_law bends on "
                              "frames"),
                    HasSubstr("set physics.friction.at: centreline and material.bending_law: elastic to go without"),
                    Not(HasSubstr("\n"))));
}

TEST(BadInput, HysteresisOfRollingNeedsASolidRod) {
  EXPECT_THAT(
      complaint(kTighten, {"material.rolling_hysteresis=0.2"}),
      AllOf(HasSubstr("tighten.yaml: material.rolling_hysteresis is 0.2, but has an effect only in a solid rod"),
            Not(HasSubstr("\n"))));
  EXPECT_EQ(complaint(kTighten, {"material=pink_vps", "material.rolling_hysteresis=0.2"}), "nothing was wrong");
  EXPECT_THAT(complaint(kTighten, {"material=pink_vps", "material.rolling_hysteresis=1.1"}), HasSubstr("0 to 1"));
  EXPECT_THAT(complaint(kTighten, {"material=pink_vps", "material.rolling_hysteresis=0.2", "material.section=round",
                                   "material.friction_couple=0"}),
              HasSubstr("only with material.friction_couple above 0"));
}

TEST(BadInput, ResistanceToRollingNeedsStrandsThatRoll) {
  const std::string resists = "material.rolling_resistance=0.1";
  for (const char* held : {"material.friction_couple=0", "physics.friction.at=centreline"})
    EXPECT_THAT(complaint(kTighten, {resists, held}),
                AllOf(HasSubstr("material.rolling_resistance is 0.1"),
                      HasSubstr("only with material.friction_couple above 0"), Not(HasSubstr("\n"))))
        << held;
  const std::string greased = "material.friction_coefficient=0";
  EXPECT_THAT(complaint(kTighten, {resists, greased}),
              AllOf(HasSubstr("material.rolling_resistance is 0.1"),
                    HasSubstr("only with a material.friction_coefficient above 0"), Not(HasSubstr("\n"))));
  EXPECT_EQ(complaint(kTighten, {resists, greased, "machine.roller_friction=0.2"}), "nothing was wrong");
  EXPECT_EQ(complaint(kTighten, {resists}), "nothing was wrong");
  for (const char* beyond : {"-0.1", "1.1", ".nan"})
    EXPECT_THAT(
        complaint(kTighten, {std::string("material.rolling_resistance=") + beyond}),
        AllOf(HasSubstr("tighten.yaml: material.rolling_resistance is "), HasSubstr("0 to 1"), Not(HasSubstr("\n"))));
}

TEST(BadInput, ARodThatIsNextToLimpInTwist) {
  const std::vector<std::string> nylon{"material.bending_stiffness=4e-5", "material.twisting_stiffness=3.9e-7"};
  EXPECT_THAT(
      complaint(kTighten, nylon),
      AllOf(HasSubstr("tighten.yaml: material.twisting_stiffness is 3.9e-07, but must be at least a hundredth of "
                      "bending_stiffness, 4e-07 N m2"),
            Not(HasSubstr("\n"))));
  EXPECT_EQ(complaint(kTighten, {nylon[0], "material.twisting_stiffness=4e-7"}), "nothing was wrong");
  EXPECT_THAT(complaint(std::string(KNOT_UTM_SOURCE_DIR) + "/config/knot.yaml",
                        {"specimen.knot=reef", "other_material=nylon", "other_material.twisting_stiffness=1e-9"}),
              HasSubstr("other_material.twisting_stiffness is 1e-09, but must be at least a hundredth of"));
}

TEST(BadInput, ABendThatYieldsNeedsAYieldStrainAndTwist) {
  EXPECT_THAT(complaint(kTighten, {"material.bending_law=plastic"}),
              AllOf(HasSubstr("material.yield_strain is missing"), Not(HasSubstr("\n"))));
  const std::vector<std::string> plastic = {"material.bending_law=plastic", "material.yield_strain=0.05"};
  const auto with = [&](const char* more) {
    std::vector<std::string> all = plastic;
    all.emplace_back(more);
    return complaint(kTighten, all);
  };
  EXPECT_EQ(complaint(kTighten, plastic), "nothing was wrong");
  EXPECT_THAT(with("physics.twist=off"), AllOf(HasSubstr("physics.twist is off"), Not(HasSubstr("\n"))));
  EXPECT_THAT(with("material.hardening=2"), AllOf(HasSubstr("material.hardening"), HasSubstr("0.01 to 1")));
}

TEST(BadInput, ABendWithFrictionNeedsItsMoment) {
  EXPECT_THAT(complaint(kTighten, {kElastic, "material.bending_law=frictional"}),
              AllOf(HasSubstr("material.friction_moment"), Not(HasSubstr("\n"))));
  const auto with = [&](const char* more) {
    return complaint(kTighten, {kElastic, "material.bending_law=frictional", "material.friction_moment=0.06", more});
  };
  EXPECT_EQ(with("material.compaction=0.002"), "nothing was wrong");
  EXPECT_THAT(with("material.friction_moment=-0.1"), HasSubstr("0 to 1 k_b/h"));
  EXPECT_THAT(with("material.stick_ratio=0.9"), HasSubstr("1.01 to 1000"));
  EXPECT_THAT(with("material.hardening=0.5"), HasSubstr("only with bending_law: plastic"));
  EXPECT_THAT(complaint(kTighten, {kElastic, "material.friction_moment=0.06"}),
              HasSubstr("only with bending_law: frictional"));
  EXPECT_THAT(complaint(kTighten, {"material.bending_law=elastic", "material.friction_moment=0.06"}),
              HasSubstr("only with bending_law: frictional"));
}

TEST(BadInput, ARestShapeNeedsALawThatKeepsIt) {
  const auto of_file = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {kElastic, "material.bending_law=elastic"});
    return complaint(std::string(KNOT_UTM_SOURCE_DIR) + "/config/from_file.yaml", more);
  };
  const std::string curved = "specimen.natural_curvature=20";
  EXPECT_EQ(of_file({curved, "machine.grips=clamps"}), "nothing was wrong");
  EXPECT_THAT(of_file({curved, "material.bending_law=plastic", "material.yield_strain=0.05"}),
              AllOf(HasSubstr("specimen.natural_curvature is 20, but material.bending_law is plastic: "),
                    Not(HasSubstr("\n"))));
  EXPECT_THAT(of_file({"specimen.natural_curvature=9000"}), HasSubstr("one over the radius"));
  EXPECT_THAT(of_file({curved, "physics.twist=off"}),
              AllOf(HasSubstr("a rod that is curved at rest"), Not(HasSubstr("\n"))));
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

TEST_F(BadFile, RollersThatTouchEachOther) {
  EXPECT_THAT(complaint(write("rollers.yaml",
                              "specimen: {knot: fisherman, knot_distance: 0.12, end_to_end: 0.22, tail: 0.04}\n"
                              "material: nylon\nmachine: {roller_diameter: 0.3}\n"
                              "program: [tie: {}, release: {}, mount: {}, pull: {until: {extension: 0.08}}]\n")),
              HasSubstr("rollers.yaml: machine.roller_diameter is 0.3, but must be less than 0.2136 m"));
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

/// Keys that tell nothing about a specimen that is pulled as it is drawn.
TEST(BadInput, WhatHasNoEffectOnAStraightRod) {
  const std::string straight = std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml";
  const std::vector<Wrong> table{
      {"specimen.handedness=opposite", "specimen.handedness", "opposite", of_knots("handedness")},
      {"specimen.knot_distance=0.1", "specimen.knot_distance", "0.1", of_knots("knot_distance")},
      {"specimen.end_to_end=0.2", "specimen.end_to_end", "0.2", of_knots("end_to_end")},
      {"specimen.tail=0.05", "specimen.tail", "0.05", of_knots("tail")},
      {"specimen.wrap=2", "specimen.wrap", "2", of_knots("wrap")},
      {"specimen.post_diameter=0.02", "specimen.post_diameter", "0.02", of_knots("post_diameter")},
      {"specimen.tail_load=2", "specimen.tail_load", "2", of_knots("tail_load")},
      {"specimen.preload=20", "specimen.preload", "20", of_knots("preload")},
      {"machine.roller_diameter=0.05", "machine.roller_diameter", "0.05",
       "only for knot: fisherman or multiple_fisherman"},
      {"machine.roller_friction=0.1", "machine.roller_friction", "0.1", "only with grips: rollers"},
      {"program.0={tie: {}}", "program.0", "tie", "needs specimen.knot: fisherman, multiple_fisherman or a file"},
      {"program.0={twist: {turns: 0}}", "program.0.twist.turns", "0", "other than 0"},
      {"program.0={mount: {}}", "program.0", "mount", "needs specimen.knot: fisherman or multiple_fisherman"},
  };
  for (const Wrong& wrong : table) {
    EXPECT_THAT(complaint(straight, {wrong.set}),
                AllOf(HasSubstr(wrong.key), HasSubstr(wrong.value), HasSubstr(wrong.allowed)))
        << wrong.set;
  }
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
