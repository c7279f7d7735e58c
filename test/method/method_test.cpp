#include "knot_utm/method/method.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "knot_utm/contact/friction.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/method/shipped.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";
const std::string kTighten = kConfig + "tighten.yaml";

struct PaperMaterial {
  const char* name;
  double stretching, bending, friction, preload;
  const char* cell;
};

TEST(Method, MaterialsAreThoseOfThePapersTable) {
  for (const PaperMaterial& row : {PaperMaterial{"nylon", 7.34e4, 4.31e-5, 0.46, 150.0, "50kN"},
                                   PaperMaterial{"polypropylene", 3.90e4, 1.18e-4, 0.63, 70.0, "50kN"},
                                   PaperMaterial{"pink_vps", 1.70, 4.34e-6, 0.54, 1.7, "20N"},
                                   PaperMaterial{"green_vps", 22.15, 5.67e-5, 0.37, 20.0, "50kN"}}) {
    const Method m = load_method(kTighten, {std::string("material=") + row.name});
    EXPECT_EQ(m.material.name, row.name);
    EXPECT_EQ(m.material.radius, 0.003175);
    EXPECT_EQ(m.material.stretching_stiffness, row.stretching);
    EXPECT_EQ(m.material.bending_stiffness, row.bending);
    EXPECT_EQ(m.material.friction_coefficient, row.friction);
    EXPECT_EQ(m.specimen.preload, row.preload);
    EXPECT_EQ(m.machine.load_cell.name, row.cell);
  }
}

/// What is written of it has a number for each `auto` of its specimen.
TEST(Method, EveryShippedFileLoads) {
  int methods = 0;
  for (const auto& file : fs::directory_iterator(kConfig)) {
    if (file.path().extension() != ".yaml") continue;
    Method method;
    EXPECT_NO_THROW(method = load_method(file.path().string())) << file.path();
    const YAML::Node written = YAML::Load(method_yaml(method))["specimen"];
    for (const auto& key : YAML::LoadFile(file.path().string())["specimen"])
      if (key.second.IsScalar() && key.second.Scalar() == "auto") {
        EXPECT_GT(written[key.first.Scalar()].as<double>(0.0), 0.0) << file.path() << ' ' << key.first;
      }
    ++methods;
  }
  EXPECT_GE(methods, 4);
  for (const auto& file : fs::directory_iterator(kConfig + "load_cells")) {
    EXPECT_NO_THROW(load_method(kTighten, {"machine.load_cell=" + file.path().stem().string()})) << file.path();
  }
}

TEST(Method, EveryStandardLoadsAndSaysWhatItIsAndWhatIsNotSimulated) {
  int standards = 0;
  for (const auto& file : fs::directory_iterator(kConfig + "standards")) {
    const std::string name = file.path().stem().string();
    EXPECT_EQ(find_method(name), file.path().string()) << "it has a name of its own";
    EXPECT_EQ(find_method("standards/" + name), file.path().string());
    const Method method = load_method(find_method(name));
    EXPECT_NE(method.report.standard, "") << name;
    EXPECT_NE(method.report.conditioning, "") << name;
    EXPECT_NE(method.report.terminations, "") << name;
    EXPECT_THAT(method.report.notes, HasSubstr("Not simulated: ")) << name;
    ++standards;
  }
  EXPECT_GE(standards, 5);
}

/// To the last bit, also where the nodes of ROS read it again.
TEST(Method, WritesBackToTheSame) {
  for (const char* folder : {"", "standards", "validation"})
    for (const auto& file : fs::directory_iterator(kConfig + folder)) {
      if (file.path().extension() != ".yaml") continue;
      const std::string text = method_yaml(load_method(file.path().string()));
      EXPECT_EQ(method_yaml(parse_method(text, file.path().string())), text) << file.path();
    }
  const std::string odd = method_yaml(load_method(
      kTighten, {"physics.max_step=0.012345678901234567", "physics.friction={law: smoothed, slip_tolerance: 1.0e-4}",
                 "specimens.count=2", "material.breaking_force=1e4", "machine.load_cell.noise=0.1",
                 "machine.load_cell.accuracy=0.005", "machine.load_cell.floor=0.002", "physics.gravity=[0, 0.1, -9.81]",
                 "program=[{preload: {load: 1}}, {hold: {duration: 2}}, {pull: {until: {load: 5, time: 3}}}]"}));
  EXPECT_THAT(odd, HasSubstr("max_step: 0.012345678901234567"));
  EXPECT_THAT(odd, HasSubstr("slip_tolerance: 1.0e-04"));
  EXPECT_EQ(method_yaml(parse_method(odd, kTighten)), odd);
}

/// What older methods wrote of another law, its plain value, is read and goes.
TEST(Method, HasTheKeysOfItsLawsAndOfNoOthers) {
  const std::string elastic = method_yaml(load_method(kTighten));
  EXPECT_EQ(method_yaml(load_method(kTighten, {"material.hardening=0.1", "physics.friction.slip_tolerance=1e-3"})),
            elastic);
  EXPECT_THAT(elastic, Not(AnyOf(HasSubstr("hardening"), HasSubstr("slip_tolerance"))));
  const std::vector<std::string> plastic = {"material.bending_law=plastic", "material.yield_strain=0.05"};
  const Method yields = load_method(kTighten, plastic);
  EXPECT_EQ(yields.material.bending.value("hardening"), 0.1);
  EXPECT_THAT(method_yaml(yields), HasSubstr("hardening: 0.1"));
  EXPECT_EQ(std::get<PlasticBending>(bending_law_of(yields.material)).hardening, 0.1);
}

TEST(Method, WhatAReportSaysAndWhatIsAskedOfATestWriteBackToTheSame) {
  const Method method = load_method(
      kTighten, {"report={specimen_id: \"0012\", standard: NO, conditioning: 'a: #b', terminations: 2026-11-23, "
                 "notes: \"two\\nlines\", units: {force: kN, length: in}}",
                 "specification={peak_force: {min: 100}, lock_extension: {min: 1e-3, max: 0.1}}"});
  EXPECT_EQ(method.report.specimen_id, "0012");
  EXPECT_EQ(method.report.notes, "two\nlines");
  EXPECT_EQ(method.report.force, ForceUnit::kKilonewton);
  EXPECT_EQ(method.report.length, LengthUnit::kInch);
  ASSERT_EQ(method.specification.size(), 2u);
  EXPECT_EQ(method.specification[0].min, 100.0);
  EXPECT_EQ(method.specification[0].max, std::nullopt);
  EXPECT_EQ(method.specification[1].key, "lock_extension");
  const std::string text = method_yaml(method);
  EXPECT_EQ(method_yaml(parse_method(text, kTighten)), text);
}

constexpr const char* kNames = "time,extension,load,knot_distance,end_to_end,load_lower,phase\ns,m,N,m,m,N,-\n";

using OwnMethod = MadeFolder;

TEST_F(OwnMethod, WritesEveryStepBackToTheSame) {
  const std::string copy = in("copy.yaml"), record = in("record.csv");
  std::ofstream(record) << kNames
                        << "5,0.001,0.5,nan,nan,nan,pull\n6,0.0025,1.5,nan,nan,nan,pull\n8,0.002,1,nan,nan,nan,pull\n";
  const Method method = load_test(
      kTighten,
      {"ends={load: 4000, time: 600, break_at_fraction_of_peak: 0.4}",
       "program=[{preload: {load: 5, load_rate: 2, balance: false}}, {pull: {load_rate: 10, until: {load: 50}}}, "
       "{hold: {duration: 3, control: load, load: 20}}, {cycle: {extension: [0.001, 0.002], count: 3}}, {cycle: "
       "{load: [1, 2], time: 9}}, {return: {extension: 0.001, load: 1}}, {follow: {record: " +
           record + "}}]"});
  ASSERT_EQ(method.program.size(), 7u);
  EXPECT_EQ(method.program[2].as<HoldStep>()->held_load, 20.0);
  EXPECT_EQ(method.program[3].as<CycleStep>()->extension->high, 0.002);
  EXPECT_EQ(method.program[4].as<CycleStep>()->cycles, 0);
  EXPECT_EQ(method.program[5].as<ReturnStep>()->load, 1.0);
  const std::vector<RecordedPlace>& recorded = method.program[6].as<FollowStep>()->recorded;
  ASSERT_EQ(recorded.size(), 3u);
  EXPECT_DOUBLE_EQ(recorded[1].time, 1.0);
  EXPECT_NEAR(recorded[1].displacement, 1.5e-3, 1e-15);
  EXPECT_NEAR(recorded[2].displacement, 1e-3, 1e-15);
  EXPECT_EQ(method.ends.load, 4000.0);
  EXPECT_EQ(method.ends.break_at_fraction_of_peak, 0.4);
  const std::string text = method_yaml(method);
  std::ofstream(copy) << text;
  EXPECT_EQ(method_yaml(load_test(copy)), text);
}

TEST(Method, OverridesReachEveryKey) {
  const Method m = load_method(
      kTighten, {"program.pull.speed=0.001", "program.1.release.duration=5", "material.friction_coefficient=0.2",
                 "specimen.preload=20", "machine.load_cell.sampling_rate=10", "physics.contact.tolerance=0.05"});
  EXPECT_EQ(m.program[4]->speed, 0.001);
  EXPECT_EQ(m.program[1]->duration, 5.0);
  EXPECT_EQ(m.material.friction_coefficient, 0.2);
  EXPECT_EQ(m.material.name, "nylon");
  EXPECT_EQ(m.specimen.preload, 20.0);
  EXPECT_EQ(m.machine.load_cell.sampling_rate, 10.0);
  EXPECT_EQ(m.machine.load_cell.capacity, 50e3);
  EXPECT_EQ(m.physics.contact_tolerance, 0.05);
}

TEST_F(OwnMethod, HasTheFilesBesideItBeforeTheShippedOnes) {
  fs::create_directories(in("methods"));
  fs::create_directories(in("config/materials"));
  fs::copy_file(kTighten, in("methods/mine.yaml"));
  std::ofstream(in("config/materials/nylon.yaml"))
      << "{radius: 0.003, density: 1000, stretching_stiffness: 9, bending_stiffness: 1.0e-5, twisting_stiffness: "
         "1.0e-5, friction_coefficient: 0.1}";
  const Method m = load_method(in("methods/mine.yaml"));
  EXPECT_EQ(m.material.stretching_stiffness, 9.0);
  EXPECT_EQ(m.machine.load_cell.name, "auto");
}

/// They have plain values, which say what the test is not.
TEST(Method, AsItIsWrittenItHasNoKeysWithoutEffect) {
  const YAML::Node overhand = YAML::Load(method_yaml(load_method(kConfig + "overhand.yaml")));
  for (const char* key : {"knot_distance", "tail", "handedness", "wrap", "post_diameter"})
    EXPECT_FALSE(overhand["specimen"][key].IsDefined()) << key;
  for (const char* key : {"knot", "turns", "length", "end_to_end", "edge_length"})
    EXPECT_TRUE(overhand["specimen"][key].IsDefined()) << key;
  for (const char* key : {"roller_diameter", "far_side"}) EXPECT_FALSE(overhand["machine"][key].IsDefined()) << key;
  const YAML::Node loop = YAML::Load(method_yaml(load_method(kConfig + "tighten.yaml")));
  for (const char* key : {"roller_diameter", "far_side"}) EXPECT_TRUE(loop["machine"][key].IsDefined()) << key;
}

TEST(MethodKeys, StandThereOnceAndSayAllThatAPageNeeds) {
  std::map<std::string, MethodKey> keys;
  for (const MethodKey& one : method_keys()) {
    EXPECT_TRUE(keys.emplace(one.key, one).second) << one.key;
    for (const std::string& said : {one.label, one.unit, one.otherwise, one.allowed}) EXPECT_NE(said, "") << one.key;
  }
  EXPECT_EQ(keys["specimen.tail"].label + "; " + keys["specimen.tail"].note, "tails; of a capstan from post to load");
  EXPECT_THAT(keys["specimen.knot_distance"].otherwise, HasSubstr("`auto`: 47.2 radii"));
  EXPECT_EQ(keys["specimen.knot_distance"].with, loops());
  EXPECT_EQ(keys["material.radius"].otherwise, "required");
  EXPECT_EQ(keys["other_material.radius"].allowed, "1e-5 to 0.05");
  EXPECT_EQ(keys["material.hardening"].with, "plastic");
  EXPECT_EQ(keys["machine.far_side"].allowed, "`held`, `free`");
}

TEST(MethodKeys, AreThoseOfEveryKnotLawAndStep) {
  const std::vector<MethodKey> keys = method_keys();
  const auto unit_of = [&](const std::string& key) {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const MethodKey& one) { return one.key == key; });
    return found == keys.end() ? "no such key" : found->unit;
  };
  for (const Knot* knot : knots()) {
    EXPECT_STRNE(knot->about().title, "") << knot->about().name;
    for (const std::string& key : knot->about().keys) EXPECT_NE(unit_of("specimen." + key), "no such key") << key;
  }
  for (const LawKey& key : FrictionRegistry::keys())
    EXPECT_EQ(unit_of(std::string("physics.friction.") + key.name), key.unit);
  for (const LawKey& key : BendingRegistry::keys()) EXPECT_EQ(unit_of(std::string("material.") + key.name), key.unit);
  for (const char* step : {"tie", "mount", "preload", "pull", "hold", "cycle", "return"})
    EXPECT_EQ(unit_of(std::string("program.") + step + ".speed"), "m/s") << step;
  EXPECT_EQ(unit_of("program.pull.until.load"), "N");
  EXPECT_EQ(unit_of("program.cycle.extension"), "m");
}

/// What a nearer choice leaves without effect goes, whether a file of a material gave it or the method.
TEST(OverruledKeys, OfAFormerLawGo) {
  const std::string own =
      "material={radius: 1e-3, density: 1000, stretching_stiffness: 1e4, bending_stiffness: 1e-6, twisting_stiffness: "
      "1e-6, friction_coefficient: 0.4, bending_law: frictional, friction_moment: 0.05, rolling_resistance: 0.1}";
  for (const std::string& material : {std::string("material=nylon"), own}) {
    const std::string elastic = method_yaml(load_method(kTighten, {"material.bending_law=elastic", material}));
    EXPECT_THAT(elastic, Not(AnyOf(HasSubstr("friction_moment"), HasSubstr("stick_ratio"), HasSubstr("compaction"))));
  }
  const std::string power =
      method_yaml(load_method(kTighten, {"physics.friction={law: power, exponent: 0.9, reference_pressure: 100}"}));
  const std::string memory = method_yaml(parse_method(power, "method.yaml", {"physics.friction.law=memory"}));
  EXPECT_EQ(memory, method_yaml(parse_method(method_yaml(load_method(kTighten)), "method.yaml")));
}

TEST(OverruledKeys, OfStrandsThatDoNotRollGo) {
  ASSERT_GT(load_method(kTighten).material.rolling_resistance, 0.0);
  EXPECT_THAT(load_method(kTighten).overruled, testing::IsEmpty());
  for (const char* held : {"material.friction_couple=0", "physics.friction.at=centreline",
                           "physics.friction={at: centreline}", "material.friction_coefficient=0"}) {
    const Method method = load_method(kTighten, {held});
    EXPECT_EQ(method.material.rolling_resistance, 0.0) << held;
    EXPECT_THAT(method.overruled,
                testing::ElementsAre(HasSubstr("material.rolling_resistance is 0.3, but has an effect only with ")));
    EXPECT_THAT(foreseen_warnings(method), testing::Contains(method.overruled.front()));
  }
}

}  // namespace
}  // namespace knot_utm
