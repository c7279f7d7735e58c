// What a method does not set suits the rod, however thin or thick, soft or stiff it is.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {
namespace {

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";
constexpr double kPaperRadius = 0.003175;  // [m]

/// A rod of this modulus [Pa], which bends as a solid one or, by `limpness`, more easily.
std::string material(double radius, double modulus, double limpness) {
  const double stretching = modulus * M_PI * radius * radius, bending = stretching * radius * radius / 4.0 / limpness;
  const auto text = [](const char* key, double value) {
    return std::string(key) + ": " + std::to_string(value * 1e12) + "e-12, ";
  };
  return "material={" + text("radius", radius) + text("stretching_stiffness", stretching) +
         "bending_stiffness: " + std::to_string(bending * 1e18) +
         "e-18, twisting_stiffness: " + std::to_string(bending * 1e18) +
         "e-18, density: 1100, friction_coefficient: 0.4}";
}

Centreline drawn(const Method& m) { return specimen_centreline(m.specimen, m.material, m.machine, m.physics); }

class EveryRod : public testing::TestWithParam<double> {};

TEST_P(EveryRod, HasDefaultsThatNobodyRefuses) {
  const double h = GetParam();
  for (const auto& [modulus, limpness] : {std::pair{1e6, 1.0}, std::pair{3e9, 1.0}, std::pair{2e9, 4e3}})
    for (const char* name : {"tighten", "overhand", "straight"}) {
      const Method m = load_method(kConfig + name + ".yaml", {material(h, modulus, limpness)});
      const double r = m.material.radius / kPaperRadius;
      const Eigen::Index nodes = drawn(m).points.cols();
      const Method paper = load_method(kConfig + name + ".yaml", {material(kPaperRadius, modulus, limpness)});
      EXPECT_NEAR(static_cast<double>(nodes), static_cast<double>(drawn(paper).points.cols()), 1.5) << name;
      EXPECT_NEAR(m.program.back()->speed, 0.0033 * r, 1e-12) << name;
      EXPECT_GT(m.machine.travel, *m.program.back().as<PullStep>()->until.extension) << name;
      // As written into the run's folder, and read again.
      const std::string text = method_yaml(m);
      EXPECT_EQ(method_yaml(parse_method(text, "method.yaml")), text) << name;
    }
}

/// Of a thread and of a hawser, in numbers.
TEST(MethodDefaults, OfAThreadAndOfAHawserFollowFromTheRadius) {
  const std::vector<std::string> ends{"physics.friction.law=smoothed"};
  for (const double h : {1.25e-4, 0.02}) {
    std::vector<std::string> set = ends;
    set.push_back(material(h, 1e9, 1e3));
    const Method m = load_method(kConfig + "tighten.yaml", set);
    EXPECT_NEAR(m.specimen.edge_length, 1.00787 * h, 1e-5 * h);
    EXPECT_NEAR(m.program[0]->speed, 3.14961 * h, 1e-5 * h);
    EXPECT_NEAR(m.program[4]->speed, 1.03937 * h, 1e-5 * h);
    EXPECT_NEAR(*m.physics.friction.value("slip_tolerance"), 0.314961 * h, 1e-5 * h);
    EXPECT_FALSE(m.physics.drag);
    EXPECT_FALSE(m.physics.inertia);
    // Friction that creeps is Coulomb's only where the pull is faster than that.
    set.emplace_back("program.pull.speed=" + std::to_string(0.1 * h));
    EXPECT_NEAR(load_method(kConfig + "tighten.yaml", set).physics.friction.value("slip_tolerance").value(),
                0.1 * h / 3.3, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(MethodDefaults, EveryRod, testing::Values(1e-5, 1.2e-4, 5e-4, 2e-3, 0.003175, 0.0125, 0.05));

TEST(MethodDefaults, AreThePapersForItsRods) {
  const Method loop = load_method(kConfig + "tighten.yaml");
  EXPECT_EQ(loop.specimen.knot_distance, 0.15);
  EXPECT_EQ(loop.specimen.end_to_end, 0.25);
  EXPECT_EQ(loop.specimen.tail, 0.03);
  EXPECT_EQ(loop.specimen.edge_length, 0.0032);
  EXPECT_EQ(loop.machine.roller_diameter, 0.0381);
  EXPECT_EQ(loop.machine.travel, 1.0);
  EXPECT_EQ(loop.program[0]->speed, 0.01);
  EXPECT_EQ(loop.program[2]->speed, 0.0033);
  EXPECT_EQ(loop.program[4].as<PullStep>()->until.extension, 0.12);
  const Method overhand = load_method(kConfig + "overhand.yaml");
  EXPECT_EQ(overhand.specimen.length, 1.0);
  EXPECT_EQ(overhand.specimen.end_to_end, 0.7);
  EXPECT_EQ(overhand.specimen.edge_length, 0.0032);
  EXPECT_EQ(overhand.program.back().as<PullStep>()->until.extension, 0.1);
  EXPECT_EQ(overhand.machine.load_cell.name, "20N");
  const Method straight = load_method(kConfig + "straight.yaml");
  EXPECT_EQ(straight.specimen.length, 0.25);
  EXPECT_EQ(straight.specimen.edge_length, 0.005);
  EXPECT_EQ(straight.program.back().as<PullStep>()->until.extension, 0.01);
  const Method file = load_method(kConfig + "from_file.yaml");
  EXPECT_EQ(file.specimen.edge_length, 0.005);
}

TEST(MethodDefaults, MakeRoomForWhatIsSet) {
  for (const std::vector<std::string>& set :
       std::vector<std::vector<std::string>>{{"specimen.knot_distance=0.5"},
                                             {"specimen.end_to_end=0.2"},
                                             {"machine.roller_diameter=0.4"},
                                             {"specimen.knot_distance=0.3", "machine.roller_diameter=0.2"}})
    EXPECT_NO_THROW(drawn(load_method(kConfig + "tighten.yaml", set))) << set.front();
  for (const std::vector<std::string>& set : std::vector<std::vector<std::string>>{{"specimen.turns=2"},
                                                                                   {"specimen.turns=3"},
                                                                                   {"specimen.turns=4"},
                                                                                   {"specimen.end_to_end=0.95"},
                                                                                   {"specimen.end_to_end=3"},
                                                                                   {"specimen.length=0.5"}})
    EXPECT_NO_THROW(drawn(load_method(kConfig + "overhand.yaml", set))) << set.front();
  EXPECT_NO_THROW(drawn(load_method(kConfig + "straight.yaml", {"specimen.length=0.01"})));
  EXPECT_EQ(load_method(kConfig + "tighten.yaml", {"program.pull.until.extension=3"}).machine.travel, 6.0);
}

TEST(MethodDefaults, EveryShippedMaterialMakesASpecimenAndIsPulled) {
  for (const auto& file : std::filesystem::directory_iterator(kConfig + "materials")) {
    const std::string name = file.path().stem().string();
    const Method loop = load_method(kConfig + "tighten.yaml", {"material=" + name});
    EXPECT_NO_THROW(drawn(loop)) << name;
    EXPECT_TRUE(loop.material.tying_preload.has_value()) << name;
    const Method m = load_method(kConfig + "straight.yaml", {"material=" + name, "physics.accuracy=draft"});
    TestingMachine bench(m.specimen, m.material, m.machine, m.physics);
    Command command;
    command.sequence = 1;
    command.step = 1;
    command.phase = Phase::kPull;
    command.time = 1.0;
    command.displacement = 0.001 * m.specimen.length;
    const Sample sample = bench.respond(command);
    EXPECT_NEAR(sample.force_upper, 0.001 * m.material.stretching_stiffness,
                0.02 * 0.001 * m.material.stretching_stiffness)
        << name;
  }
}

}  // namespace
}  // namespace knot_utm
