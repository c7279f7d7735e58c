#include "knot_utm/specimen/multiple_fisherman.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "knot_utm/machine/specimen_centreline.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/specimen/tying_rig.hpp"
#include "knot_utm/topology/knot_invariants.hpp"

namespace knot_utm {
namespace {

struct Scene {
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;

  Scene(const char* knot, int turns, double h, Handedness handedness) {
    material.radius = h;
    material.density = 1000.0;
    material.bending_stiffness = 1e-4;
    material.stretching_stiffness = 1e4;
    material.twisting_stiffness = 1e-4;
    material.friction_coefficient = 0.5;
    specimen = knot_of(knot_named(knot)).defaults(h);
    specimen.knot = knot_named(knot);
    specimen.turns = turns;
    specimen.handedness = handedness;
    specimen.to_be_tied = true;
    machine.roller_diameter = *knot_of(specimen).roller_diameter(h);
    const SpecimenOptions known = specimen;
    knot_of(specimen).suit(known, machine.roller_diameter, h, specimen);
  }

  Centreline centreline() const { return specimen_centreline(specimen, material, machine, {}); }

  LoopTopology::Reading topology() const {
    const Centreline line = centreline();
    TyingRig rig(line,
                 make_rod(material,
                          (line.points.rightCols(line.points.cols() - 1) - line.points.leftCols(line.points.cols() - 1))
                              .colwise()
                              .norm()),
                 {});
    const std::vector<int> standing = rig.standing_nodes();
    return LoopTopology(standing[0], standing[1], material.radius).read(line.points, Vec3::UnitZ());
  }
};

/// Each of its knots alone is a double (triple) overhand, the (2, 2n+1) torus knot, whose determinant is 2n + 1.
TEST(MultipleFisherman, IsMadeOfMultipleOverhands) {
  for (const Handedness hands : {Handedness::kSame, Handedness::kOpposite}) {
    EXPECT_EQ(Scene("fisherman", 1, 3.175e-3, hands).topology().overhand_determinant,
              (std::array<std::int64_t, 2>{3, 3}));
    EXPECT_EQ(Scene("multiple_fisherman", 2, 3.175e-3, hands).topology().overhand_determinant,
              (std::array<std::int64_t, 2>{5, 5}));
    EXPECT_EQ(Scene("multiple_fisherman", 3, 3.175e-3, hands).topology().overhand_determinant,
              (std::array<std::int64_t, 2>{7, 7}));
  }
}

TEST(MultipleFisherman, ClearsItselfForRodsOfAnySize) {
  for (const double h : {1e-4, 3.175e-3, 3e-2})
    for (const int turns : {2, 3})
      for (const Handedness hands : {Handedness::kSame, Handedness::kOpposite}) {
        Centreline line;
        ASSERT_NO_THROW(line = Scene("multiple_fisherman", turns, h, hands).centreline());
        ASSERT_EQ(line.knots.size(), 2u);
        EXPECT_GT(line.knots[0].longer, 0.0);
      }
}

/// A further winding of radius R takes in its own length of rod, 2 pi R, and makes the coil 3.2 h longer, through which
/// standing part and tail run.
TEST(MultipleFisherman, EachWindingTakesInAnotherTurn) {
  const auto length = [](int turns) {
    Scene scene("multiple_fisherman", turns, 3.175e-3, Handedness::kSame);
    scene.specimen.tail = 0.1;
    scene.specimen.end_to_end = 0.4;
    scene.specimen.to_be_tied = false;  // the coils stand where they are asked for
    return scene.centreline().length();
  };
  const double h = 3.175e-3, winding = 2.0 * M_PI * 4.7 * h;
  EXPECT_GT(length(3) - length(2), 2.0 * winding);
  EXPECT_LT(length(3) - length(2), 2.0 * (winding + 2.0 * 3.2 * h));
}

TEST(MultipleFisherman, RefusesOneWindingWhichIsTheFishermansKnot) {
  Scene scene("multiple_fisherman", 1, 3.175e-3, Handedness::kSame);
  try {
    knot_of(scene.specimen).check(scene.specimen, 3.175e-3);
    FAIL() << "accepted";
  } catch (const InvalidInput& invalid) {
    EXPECT_STREQ(invalid.what(), "specimen.turns is 1, but must be 2 or 3; knot: fisherman winds its tails once");
  }
}

}  // namespace
}  // namespace knot_utm
