// Ropes of two materials as a method gives them: what it reads, what follows from it, what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/breaking/break_watch.hpp"
#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

Method sheet_bend(std::vector<std::string> more) {
  more.insert(more.begin(), {"specimen.knot=sheet_bend", "material=polyester_cord", "physics.accuracy=draft"});
  return load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/knot.yaml", more);
}

Centreline laid(const Method& m) { return specimen_centreline(m.specimen, m.material, m.machine, m.physics); }

TEST(OtherMaterial, IsReadAsAMaterialIsAndWrittenBack) {
  EXPECT_FALSE(sheet_bend({}).material.other);
  const Method method =
      sheet_bend({"other_material=nylon", "other_material.radius=0.001", "physics.friction.pair=0.2"});
  ASSERT_TRUE(method.material.other);
  EXPECT_EQ(method.material.other->name, "nylon");
  EXPECT_EQ(method.material.other->radius, 0.001);
  EXPECT_EQ(method.physics.pair_friction, 0.2);
  const Method again = parse_method(method_yaml(method), std::string(KNOT_UTM_SOURCE_DIR) + "/config/again.yaml");
  EXPECT_EQ(method_yaml(again), method_yaml(method));
  EXPECT_EQ(number_at(again, "other_material.radius"), 0.001);
  EXPECT_FALSE(number_at(sheet_bend({}), "other_material.radius"));
}

TEST(OtherMaterial, TheThickestRopeIsTheUnitAndThinnerOnesHaveShorterEdges) {
  const Method one = sheet_bend({}),
               thin = sheet_bend({"other_material=polyester_cord", "other_material.radius=0.001"}),
               first_thin = sheet_bend({"material.radius=0.001", "other_material=polyester_cord"});
  for (const Method& method : {thin, first_thin}) {
    EXPECT_EQ(method.specimen.tail, one.specimen.tail);
    EXPECT_EQ(method.specimen.end_to_end, one.specimen.end_to_end);
    EXPECT_EQ(method.specimen.edge_length, one.specimen.edge_length);
  }
  const double share = 0.001 / one.material.radius;
  const auto edges = [](const Centreline& rod) {
    const auto edge = [&](Eigen::Index j) { return (rod.points.col(j + 1) - rod.points.col(j)).norm(); };
    return std::make_pair(edge(0), edge(rod.points.cols() - 2));
  };
  const auto [of_first, of_second] = edges(laid(thin));
  EXPECT_NEAR(of_second / of_first, share, 0.02 * share);
  const auto [of_thin, of_thick] = edges(laid(first_thin));
  EXPECT_NEAR(of_thin / of_thick, share, 0.02 * share);
}

TEST(OtherMaterial, FrictionOfThePairIsTheSmallerOneUnlessItIsGiven) {
  const std::vector<std::string> slippery = {"other_material=polyester_cord",
                                             "other_material.friction_coefficient=0.1"};
  const Method smaller = sheet_bend(slippery);
  EXPECT_EQ(pair_friction(smaller.material, smaller.physics), 0.1);
  std::vector<std::string> given = slippery;
  const Method mean = sheet_bend({slippery[0], slippery[1], "physics.friction.pair=mean"});
  EXPECT_EQ(pair_friction(mean.material, mean.physics), 0.5 * (0.1 + mean.material.friction_coefficient));
  EXPECT_THAT(method_yaml(mean), HasSubstr("pair: mean"));
  const double own = mean.material.friction_coefficient;
  for (const auto& [rule, friction] : {std::pair("product", 0.1 * own), {"root_of_product", std::sqrt(0.1 * own)}}) {
    const Method method = sheet_bend({slippery[0], slippery[1], std::string("physics.friction.pair=") + rule});
    EXPECT_DOUBLE_EQ(pair_friction(method.material, method.physics), friction);
    EXPECT_THAT(method_yaml(method), HasSubstr(std::string("pair: ") + rule));
    EXPECT_THROW(sheet_bend({std::string("physics.friction.pair=") + rule}), InvalidInput);
  }
  given.push_back("physics.friction.pair=0.3");
  const Method set = sheet_bend(given);
  const StepSettings settings = step_settings(set.specimen, set.material, set.machine, set.physics);
  ASSERT_TRUE(settings.others);
  EXPECT_EQ(settings.others->between.friction.coefficient(), 0.3);
  EXPECT_EQ(settings.others->own.friction.coefficient(), 0.1);
  EXPECT_EQ(settings.friction.coefficient(), set.material.friction_coefficient);
}

/// Under the same pressure a strand gives way by half of what a contact of its material does.
TEST(OtherMaterial, AContactOfTwoMaterialsGivesWayAsBothDoOneBehindTheOther) {
  const Method method = sheet_bend({"other_material=nylon"});
  const double tolerance = 1e-6, pressure = 10.0;
  const NormalLaw a = normal_law(method.material, tolerance), b = normal_law(*method.material.other, tolerance),
                  both = normal_law_between(method.material, *method.material.other, tolerance);
  const auto linear = [&](const NormalLaw& law) { return pressure / law.stiffness; };
  EXPECT_NEAR(linear(both), 0.5 * (linear(a) + linear(b)), 1e-12 * linear(both));
  EXPECT_NEAR(normal_law_between(method.material, method.material, tolerance).stiffness, a.stiffness,
              1e-12 * a.stiffness);
}

/// The rope that gives way more takes more of the work of rolling, of which it loses its own share.
TEST(OtherMaterial, TheirContactResistsRollingAsItsTwoHalvesDo) {
  const Method method = sheet_bend({"material=pink_vps", "other_material=pink_vps", "other_material.radius=0.001",
                                    "material.rolling_resistance=0.1", "material.rolling_hysteresis=0.1",
                                    "other_material.rolling_resistance=0.3", "other_material.rolling_hysteresis=0"});
  const Material &one = method.material, &other = *method.material.other;
  const StepSettings settings = step_settings(method.specimen, one, method.machine, method.physics);
  const RollingResistance &between = settings.others->rolling_between, &own = settings.others->rolling_own;
  EXPECT_EQ(settings.rolling.coefficient, 0.1);
  EXPECT_EQ(own.coefficient, 0.3);
  EXPECT_EQ(own.radius, 0.001);
  EXPECT_EQ(own.growth, 0.0);
  EXPECT_DOUBLE_EQ(between.radius, 2.0 / (1.0 / one.radius + 1000.0));
  const double k = default_contact_stiffness(one), k_other = default_contact_stiffness(other);
  EXPECT_NEAR(between.coefficient, (0.1 * k_other + 0.3 * k) / (k + k_other), 1e-15);
  // The same one twice is as one.
  const RollingResistance same = rolling_between(one, one, 1e-3);
  EXPECT_DOUBLE_EQ(same.coefficient, settings.rolling.coefficient);
  EXPECT_DOUBLE_EQ(same.radius, settings.rolling.radius);
  EXPECT_NEAR(same.growth, settings.rolling.growth, 1e-15 + 1e-12 * same.growth);
  EXPECT_GT(same.growth, 0.0);
  EXPECT_THAT(
      method.overruled,
      testing::ElementsAre(HasSubstr("other_material.section is soft, but must be round where stretching"),
                           HasSubstr("material.section is soft, but must be round beside a rope that is round")));
  // Beside a rigid one, the soft one takes all the work.
  Material rigid = one;
  rigid.contact_stiffness = 1e13;
  rigid.rolling_resistance = rigid.rolling_hysteresis = 0.0;
  EXPECT_NEAR(rolling_between(one, rigid, 1e-3).coefficient, one.rolling_resistance, 1e-6);
}

TEST(OtherMaterial, TheRopeThatIsNearestToItsOwnBreakingForceParts) {
  const Method method = sheet_bend({"other_material=polyester_cord", "other_material.breaking_force=1000"});
  EXPECT_EQ(weakest(method.material), 1000.0);
  const double force = *method.material.breaking_force, h = method.material.radius;
  EXPECT_GT(force, 1000.0);
  // Both ropes along z, stretched alike.
  const RodProperties rod = make_rod(method.material, *method.material.other, Eigen::VectorXd::Constant(9, h), {4});
  Points x = Points::Zero(3, 10);
  for (int i = 0; i < 10; ++i) x(2, i) = 1.01 * h * i;
  const Exposure found = RopeStrengths(method.material, rod).most_exposed(rod, x);
  EXPECT_GE(found.edge, 5);
  EXPECT_NEAR(found.fraction, 0.01 * method.material.stretching_stiffness / 1000.0, 1e-9);
  const Method unbreakable = sheet_bend({"other_material=polyester_cord", "material.breaking_force=none"});
  EXPECT_TRUE(can_part(unbreakable.material));
  EXPECT_GE(RopeStrengths(unbreakable.material, rod).most_exposed(rod, x).edge, 5);
}

TEST(OtherMaterial, TheAutomaticPreloadTiesTheStifferRopeAndSparesTheWeakerOne) {
  const Method stiff =
      sheet_bend({"material=steel_wire", "other_material=steel_wire", "other_material.bending_stiffness=1e-3"});
  EXPECT_EQ(stiff.specimen.preload, default_preload(*stiff.material.other));
  const Method weak = sheet_bend({"other_material=polyester_cord", "other_material.breaking_force=10"});
  EXPECT_EQ(weak.specimen.preload, 5.0);
}

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

Method straight(std::vector<std::string> overrides) { return load_method(kConfig + "straight.yaml", overrides); }

TEST(LoadTerms, APercentageIsOfTheBreakingForceOfTheMaterial) {
  const Method m =
      straight({"material.breaking_force=1700",
                "program=[{preload: {load: 2.5%}}, {cycle: {load: [10 %, 50 %], count: 3}}, {hold: {duration: 1, "
                "control: load, load: 1e1 %}}, {pull: {until: {load: 80%}}}]"});
  EXPECT_DOUBLE_EQ(m.program[0].as<PreloadStep>()->load, 42.5);
  EXPECT_DOUBLE_EQ(m.program[1].as<CycleStep>()->load->low, 170.0);
  EXPECT_DOUBLE_EQ(m.program[1].as<CycleStep>()->load->high, 850.0);
  EXPECT_DOUBLE_EQ(*m.program[2].as<HoldStep>()->held_load, 170.0);
  EXPECT_DOUBLE_EQ(*m.program[3].as<PullStep>()->until.load, 1360.0);
}

TEST(LoadTerms, TheReferenceTensionIsAnEighthOfTheSquaredDiameter) {
  const Method m = straight({"material.radius=0.008", "program.0={preload: {load: reference_tension}}"});
  EXPECT_DOUBLE_EQ(m.program[0].as<PreloadStep>()->load, 320.0);  // 16 mm: 256 / 8 = 32 daN
}

}  // namespace
}  // namespace knot_utm
