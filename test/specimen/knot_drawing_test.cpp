// A knot that is sketched through points: where its ropes lie, and what is refused.
#include "knot_utm/specimen/knot_drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "complaint.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/topology/crossings.hpp"
#include "knot_utm/topology/knot_invariants.hpp"
#include "knot_utm/tying/tying_rig.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

constexpr SketchSize kSize{0.003, 0.3, 0.05, 0.003};

/// Two elbows that hang in each other: the simplest bend there is.
KnotDrawing hooks() {
  KnotDrawing out;
  out.name = "hooks";
  out.strands = {
      {{"lower", "lower_tail"}, {{0, 0, -8}, {0, 0, -4}, {0, 1, 0}, {3, 2, 2}, {6, 1, 3}, {9, 0, 3}}},
      {{"upper_tail", "upper"}, {{-6, 5, -6}, {-4, 4, -3}, {0, 4, -2}, {4, -1, -1}, {4, -2, 3}, {4, -2, 7}}}};
  out.lower = {"lower"};
  out.upper = {"upper"};
  out.tie = {{{"lower_tail", 1.0}}, {{"upper_tail", 0.5}}};
  return out;
}

TEST(KnotDrawing, RunsFromGripToGripAndItsTailsRunOnStraight) {
  const Centreline rod = sketch(hooks(), kSize);
  ASSERT_EQ(rod.cuts.size(), 1u);
  const int cut = rod.cuts[0], last = static_cast<int>(rod.points.cols()) - 1;
  EXPECT_NEAR(rod.points(2, 0), 0.0, 1e-12);
  EXPECT_NEAR(rod.points(2, last), kSize.end_to_end, 1e-12);
  ASSERT_EQ(rod.held_lower.size(), 1u);
  ASSERT_EQ(rod.held_upper.size(), 1u);
  EXPECT_EQ(rod.held_lower[0].node, 0);
  EXPECT_EQ(rod.held_upper[0].node, last);
  // The last point and the way that leads there, as sketched; the knot lies half-way between the grips.
  const Vec3 middle(0.0, 0.0, 0.5 * kSize.end_to_end + 0.5 * kSize.radius);
  const Vec3 end = kSize.radius * Vec3(9, 0, 3) + middle + kSize.tail * Vec3(3, -1, 0).normalized();
  EXPECT_NEAR((rod.points.col(cut) - end).norm(), 0.0, 1e-9);
}

TEST(KnotDrawing, PullsAnEndOfTheUpperGripAlongTheLoadAxis) {
  KnotDrawing drawing = hooks();
  drawing.tie = {{{"upper", 0.7}}};
  const Centreline rod = sketch(drawing, kSize);
  ASSERT_EQ(rod.pull_groups.size(), 1u);
  const PulledEnd& end = rod.pull_groups[0][0];
  EXPECT_TRUE(end.held());
  EXPECT_EQ(end.node, rod.held_upper[0].node);
  EXPECT_EQ(end.held_next, rod.held_upper[0].next);
  EXPECT_EQ(end.direction, Vec3::UnitZ());
  EXPECT_FALSE(sketch(hooks(), kSize).pull_groups[0][0].held());
}

TEST(KnotDrawing, GoesThroughItsPointsAsFarAsItsBendsAreRoundedOff) {
  const Centreline rod = sketch(hooks(), kSize);
  for (const KnotDrawing::Strand& strand : hooks().strands)
    for (const Vec3& point : strand.points) {
      const Vec3 place = kSize.radius * point + (0.15 + 0.0015) * Vec3::UnitZ();
      // A Gaussian of one radius moves a bend of four radii by an eighth of a radius, and edges are one radius long.
      EXPECT_LT((rod.points.colwise() - place).colwise().norm().minCoeff(), 0.8 * kSize.radius);
    }
}

TEST(KnotDrawing, FindsALandmarkAlongItsStrandAtAnyLengthOfEdges) {
  KnotDrawing knot = hooks();
  knot.landmarks = {{"bend", 0, 2}, {"hook", 1, 3}, {"end", 1, 5}};
  knot.readings = {{"loop", KnotReading::Kind::kLoop, 0, 0}, {"way", KnotReading::Kind::kDistance, 1, 2}};
  for (const double edge : {0.003, 0.0015, 0.0005}) {
    SketchSize size = kSize;
    size.edge_length = edge;
    const Centreline rod = sketch(knot, size);
    ASSERT_EQ(rod.readings.size(), 2u);
    EXPECT_EQ(rod.readings[0].kind, KnotReading::Kind::kLoop);
    EXPECT_EQ(rod.readings[0].second, rod.readings[0].first);
    EXPECT_LE(rod.readings[0].first, rod.cuts[0]);
    EXPECT_GT(rod.readings[1].first, rod.cuts[0]);
    const std::pair<int, Vec3> places[] = {
        {rod.readings[0].first, {0, 1, 0}}, {rod.readings[1].first, {4, -1, -1}}, {rod.readings[1].second, {4, -2, 7}}};
    for (const auto& [node, point] : places) {
      const Vec3 place = kSize.radius * point + (0.15 + 0.0015) * Vec3::UnitZ();
      // Half an edge, and what a Gaussian of one radius moves so sharp a bend by.
      EXPECT_LT((rod.points.col(node) - place).norm(), 0.5 * edge + 0.5 * kSize.radius) << edge;
    }
  }
}

TEST(KnotDrawing, RopesOfTwoRadiiMayComeAsNearAsBothAreThick) {
  SketchSize one = kSize, thin = kSize, first_thin = kSize;
  thin.others = first_thin.first = 0.5;
  const auto side_by_side = [](double apart) {
    KnotDrawing out;
    out.name = "two";
    out.strands = {{{"lower", "lower_tail"}, {{0, 0, -8}, {0, 0, -4}, {0, 0, 0}, {0, 0, 4}}},
                   {{"upper_tail", "upper"}, {{apart, 0, -4}, {apart, 0, 0}, {apart, 0, 4}, {apart, 0, 8}}}};
    out.lower = {"lower"};
    out.upper = {"upper"};
    return out;
  };
  EXPECT_NO_THROW(sketch(side_by_side(2.1), one));
  EXPECT_THROW(sketch(side_by_side(1.9), one), InvalidInput);
  for (const SketchSize& size : {thin, first_thin}) {
    EXPECT_NO_THROW(sketch(side_by_side(1.55), size));
    EXPECT_THAT(complaint_of([&] { sketch(side_by_side(1.45), size); }),
                HasSubstr("must be at least both radii apart, 1.5 radii"));
  }
}

TEST(KnotDrawing, IsRefusedWhereAStrandBendsMoreSharplyThanTheRodIsThick) {
  KnotDrawing knot;
  knot.name = "hairpin";
  knot.strands = {{{"lower", "upper"}, {{0, 0, -8}, {0, 0, -4}, {0, 0, 3}, {0, 0.2, 0}, {0, 0.2, 5}, {0, 0.2, 9}}}};
  knot.lower = {"lower"};
  knot.upper = {"upper"};
  EXPECT_THAT(complaint_of([&] { sketch(knot, kSize); }),
              HasSubstr("specimen.knot hairpin: a strand bends with a radius of "));
}

TEST(KnotDrawing, StandsOnItsFirstPostWhereTheLowerGripHoldsNoEnd) {
  KnotDrawing knot;
  knot.name = "hook";
  knot.strands = {
      {{"tail", "upper"}, {{-5, 0, 8}, {-5, 0, 4}, {-5, 0, 0}, {0, 0, -5}, {5, 0, 0}, {5, 0, 4}, {5, 0, 8}}}};
  knot.upper = {"upper"};
  knot.posts = {{Vec3(0, 0, 1), Vec3::UnitY(), 2.0}};
  EXPECT_NEAR(height_of_origin(knot, kSize), -0.003, 1e-12);
  EXPECT_NO_THROW(sketch(knot, kSize));
  knot.posts[0].radius = 6.0;
  EXPECT_THROW(sketch(knot, kSize), InvalidInput);
}

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
