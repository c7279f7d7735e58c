#include "knot_utm/settings/accuracy.hpp"

#include <gtest/gtest.h>

#include <string>

#include "knot_utm/contact/friction.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/verdict/run_warnings.hpp"

namespace knot_utm {
namespace {

struct Loop {
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;
  PhysicsOptions physics;

  Loop() {
    specimen.to_be_tied = true;
    material.radius = 3e-3;
    material.bending_stiffness = 1e-4;
    material.stretching_stiffness = 1e4;
    material.friction_coefficient = 0.7;
    material.friction_couple = 0.0;
  }
  Tolerances tolerances() const { return knot_utm::tolerances(physics, specimen, material); }
  RelativeErrors errors() const { return relative_errors(specimen, material, machine, physics); }
};

TEST(RelativeErrors, OfEdgesOfOneRadiusAtNormalIsThatOfTheStudy) {
  Loop loop;
  loop.specimen.edge_length = loop.material.radius;
  loop.material.friction_coefficient = 0.9;
  EXPECT_DOUBLE_EQ(loop.errors().plateau_force.value(), 0.06);
  loop.material.friction_coefficient = 0.4;
  EXPECT_DOUBLE_EQ(loop.errors().plateau_force.value(), 0.12);
}

/// Friction among fibres that nearly locks the knots makes small errors of the mesh large.
TEST(RelativeErrors, GrowAsKnotsNearlyLockThemselves) {
  Loop loop;
  loop.material.friction_couple = 1.0;
  loop.material.friction_coefficient = 0.9;
  const auto with_moment = [&loop](double moment) {
    loop.material.bending.law = static_cast<BendingLaw>(2);
    loop.material.bending.set("friction_moment", moment);
    return loop.errors().plateau_force.value();
  };
  EXPECT_NEAR(with_moment(0.07 / 0.9), 2.0 * with_moment(0.0), 1e-12);
  EXPECT_NEAR(with_moment(0.14 / 0.9), 5.0 * with_moment(0.0), 1e-12);
}

/// In one material, tied by the program.
TEST(RelativeErrors, OfTheLargestLoadAreKnownOfKnotsFromFiles) {
  const auto errors = [](std::vector<std::string> settings) {
    settings.emplace_back("specimen.knot=reef");
    const Method method = load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/knot.yaml", settings);
    return relative_errors(method.specimen, method.material, method.machine, method.physics).largest_load;
  };
  const std::string linear = "material.stretching_law=linear";
  const double solid = errors({"material=pink_vps", "material.section=round", linear}).value(),
               rope = errors({"material=nylon"}).value();
  EXPECT_FALSE(errors({"material=pink_vps"})) << "soft sections were not studied";
  EXPECT_GT(rope, solid);
  EXPECT_LT(errors({"material=nylon", "physics.accuracy=fine"}).value(), 0.6 * rope);
  EXPECT_FALSE(errors({"material=nylon", "other_material=polyester_cord"}));
  EXPECT_FALSE(errors({"material=nylon", "program=[{pull: {until: {extension: 0.1}}}]"})) << "as it is drawn";
}

/// By the fourth root of the pre-load over 6 k_b/h^2, up to a third.
TEST(Tolerances, EdgesAreShorterInRopesThatAreTiedHard) {
  const auto refinement = [](const Loop& loop, double preload) {  // F_p h^2/k_b
    Loop tied = loop;
    const double h = tied.material.radius;
    tied.specimen.preload = preload * tied.material.bending_stiffness / (h * h);
    return tied.tolerances().refinement;
  };
  Loop rope, draft, fine, solid, untied, overhand, chosen;
  draft.physics.accuracy = Accuracy::kDraft;
  fine.physics.accuracy = Accuracy::kFine;
  solid.material.stretching_stiffness = 4.0 * 1e-4 / (3e-3 * 3e-3);
  untied.specimen.to_be_tied = false;
  overhand.specimen.knot = knot_named("overhand");
  chosen.specimen.refinement = 2.5;
  EXPECT_DOUBLE_EQ(refinement(rope, 4.0), 2.25);
  EXPECT_NEAR(refinement(rope, 6.0 * 1.2 * 1.2 * 1.2 * 1.2), 2.25 * 1.2, 1e-9);
  EXPECT_DOUBLE_EQ(refinement(rope, 50.0), 3.0);
  EXPECT_DOUBLE_EQ(refinement(fine, 50.0), 4.0);
  for (const Loop& loop : {draft, solid, untied, overhand, chosen})
    EXPECT_EQ(refinement(loop, 50.0), refinement(loop, 4.0));
}

TEST(Tolerances, OfASolidRodOfAnyShapeAreThoseOfAnOpenKnot) {
  const auto residual = [](const std::string& name, const char* material) {
    const Method method = load_method(KNOT_UTM_SOURCE_DIR "/config/" + name, {std::string("material=") + material});
    return tolerances(method.physics, method.specimen, method.material).residual;
  };
  EXPECT_EQ(residual("from_file.yaml", "pink_vps"), residual("overhand.yaml", "pink_vps"));
  EXPECT_EQ(residual("from_file.yaml", "nylon"), residual("tighten.yaml", "nylon"));
  EXPECT_GT(residual("from_file.yaml", "pink_vps"), 10.0 * residual("tighten.yaml", "pink_vps"));
}

/// With the whole couple of friction and fibres that rub, and not with one of them.
TEST(RelativeErrors, AreGivenForStrandsThatRollAsTheStudyHadThem) {
  const auto errors = [](const std::string& change) {
    const Method m = load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml",
                                 {"material=polypropylene", "specimen.edge_length=0.003175", change});
    return relative_errors(m.specimen, m.material, m.machine, m.physics);
  };
  const double near = 0.06 * 0.63 / 0.07;
  EXPECT_NEAR(errors("physics.accuracy=normal").plateau_force.value(), 0.09 * 0.8 / 0.63 * (1.0 + near * near), 1e-12);
  EXPECT_NEAR(errors("physics.accuracy=normal").lock_extension.value(), 0.014, 1e-12);
  EXPECT_NEAR(errors("physics.accuracy=normal").locked_stiffness.value(), 0.016 * 0.8 / 0.63, 1e-12);
  for (const char* other : {"material.friction_couple=0", "material.bending_law=elastic"})
    EXPECT_FALSE(errors(other).plateau_force) << other;
  const RelativeErrors opposite = errors("specimen.handedness=opposite");
  EXPECT_NEAR(opposite.plateau_force.value(), 0.43, 1e-12);
  EXPECT_NEAR(opposite.lock_extension.value(), 0.055, 1e-12);
  EXPECT_NEAR(opposite.locked_stiffness.value(), 0.14, 1e-12);
}

TEST(RelativeErrors, AreNotGivenWhereNoStudySays) {
  Loop smoothed, untied, overhand, rolling, rough, rubber, straight;
  smoothed.physics.friction.law = law_named("smoothed");
  untied.specimen.to_be_tied = false;
  overhand.specimen.knot = knot_named("overhand");
  rolling.material.friction_couple = 1.0;
  rough.machine.roller_friction = 0.2;
  straight.specimen.knot = knot_named("straight");
  EXPECT_TRUE(straight.errors().locked_stiffness);
  rubber.material.stretching.law = straight.material.stretching.law = static_cast<StretchingLaw>(1);
  for (const Loop& loop : {smoothed, untied, overhand, rolling, rough, rubber, straight}) {
    EXPECT_FALSE(loop.errors().plateau_force);
    EXPECT_FALSE(loop.errors().lock_extension);
    EXPECT_FALSE(loop.errors().locked_stiffness);
  }
}

/// With the square of the edges, as the mesh of a bend goes.
TEST(Errors, OfABreakInABendAreThoseOfAKnotThatItsBendHelpsToPart) {
  Loop knot;
  knot.specimen.knot = knot_named("overhand");
  knot.material.breaking_force = 2500.0;
  EXPECT_FALSE(knot.errors().break_in_bend) << "tension alone parts it";
  knot.material.breaking.law = static_cast<BreakingLaw>(1);
  knot.material.breaking.set("bending_share", 0.1);
  const double normal = knot.errors().break_in_bend.value();
  EXPECT_GT(normal, 0.03);
  EXPECT_LT(normal, 0.1);
  knot.specimen.edge_length *= 0.5;
  EXPECT_LT(knot.errors().break_in_bend.value(), 0.85 * normal);
  knot.specimen.knot = knot_named("straight");
  EXPECT_FALSE(knot.errors().break_in_bend) << "it has no knot";
}

}  // namespace
}  // namespace knot_utm
