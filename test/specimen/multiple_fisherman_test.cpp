// knot: multiple_fisherman.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/topology/crossings.hpp"
#include "knot_utm/topology/knot_invariants.hpp"
#include "knot_utm/tying/tying_rig.hpp"

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
    return reader(line).read(line.points, Vec3::UnitZ());
  }

  LoopTopology reader(const Centreline& line) const {
    const std::vector<int> standing = standing_nodes(line);
    return {standing[0], standing[1], material.radius, line.knots[0].windings};
  }

  std::vector<int> standing_nodes(const Centreline& line) const {
    TyingRig rig(line,
                 make_rod(material,
                          (line.points.rightCols(line.points.cols() - 1) - line.points.leftCols(line.points.cols() - 1))
                              .colwise()
                              .norm()),
                 {});
    return rig.standing_nodes();
  }
};

/// The space around the upper knot sheared along the load axis, so that the windings of its coil lie aslant: at
/// `slope`, fading over a way along that axis that is much longer than it shifts anything, so that it is one to one.
Points aslant(const Centreline& line, double h, double slope, double heading) {
  Points points = line.points;
  const Vec3 threaded = points.col(line.nearest_node(line.knots[1].threaded));
  const double reach = 8.0 * h;  // beyond the coil nothing shifts
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 from = points.col(i) - threaded;
    const double beside = from.x() * std::cos(heading) + from.y() * std::sin(heading);
    const double fades = std::exp(-std::pow(std::hypot(from.x(), from.y()) / reach, 4));
    const double near = std::exp(-std::pow(from.z() / (3.0 * reach), 2));
    points(2, i) += slope * beside * fades * near;
  }
  return points;
}

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

/// What a tail that is wound once would be cut at is a winding that rises and falls again.
TEST(MultipleFisherman, StaysTheSameKnotWhereItsWindingsLieAslant) {
  const double h = 3.175e-3;
  int misread_as_wound_once = 0;
  for (const int turns : {2, 3})
    for (const Handedness hands : {Handedness::kSame, Handedness::kOpposite}) {
      const Scene scene("multiple_fisherman", turns, h, hands);
      const Centreline line = scene.centreline();
      LoopTopology topology = scene.reader(line);
      const LoopTopology::Reading tied = topology.read(line.points, Vec3::UnitZ());
      for (const double slope : {0.2, 0.4, 0.6})
        for (double heading = 0.0; heading < 2.0 * M_PI; heading += 0.25 * M_PI) {
          const Points tilted = aslant(line, h, slope, heading);
          const LoopTopology::Reading reading = LoopTopology(topology).read_as(tied, tilted, Vec3::UnitZ());
          EXPECT_EQ(reading.overhand_determinant, tied.overhand_determinant) << turns << " " << slope << " " << heading;
          EXPECT_TRUE(reading.same_knot(tied)) << turns << " " << slope << " " << heading;
          const OverhandStrand once =
              OverhandStrand::follow(tilted, 1, line.nearest_node(line.knots[1].standing_begin), Vec3::UnitZ(), h);
          if (line.nearest_node(line.knots[1].tail_exit) - once.cut > 10) ++misread_as_wound_once;
        }
    }
  EXPECT_GT(misread_as_wound_once, 20) << "the windings do not lie aslant enough to mean anything";
}

}  // namespace
}  // namespace knot_utm
