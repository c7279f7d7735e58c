#include "knot_utm/specimen/centreline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <regex>
#include <string>

#include "complaint.hpp"
#include "knot_utm/specimen/fisherman.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

double largest_turn(const Points& points);

void expect_equal_edges(const Points& points, double edge_length) {
  const Eigen::Index edges = points.cols() - 1;
  const Eigen::VectorXd length = (points.rightCols(edges) - points.leftCols(edges)).colwise().norm();
  // Equal along the sketched curve: chords are shorter by (turn)^2/24, and an edge may turn more than the node at its
  // end.
  EXPECT_LT(length.maxCoeff() / length.minCoeff() - 1.0, 1e-3 + std::pow(largest_turn(points), 2) / 12.0);
  EXPECT_NEAR(length.mean(), edge_length, 0.02 * edge_length);
}

Vec3 at(const Centreline& line, double arclength) {
  Eigen::Index i = 0;
  double left = arclength, edge = (line.points.col(1) - line.points.col(0)).norm();
  while (left > edge && i + 2 < line.points.cols()) {
    left -= edge;
    ++i;
    edge = (line.points.col(i + 1) - line.points.col(i)).norm();
  }
  return line.points.col(i) + left / edge * (line.points.col(i + 1) - line.points.col(i));
}

double largest_turn(const Points& points) {
  double largest = 0.0;
  for (Eigen::Index i = 1; i + 1 < points.cols(); ++i) {
    const Vec3 a = points.col(i) - points.col(i - 1);
    const Vec3 b = points.col(i + 1) - points.col(i);
    largest = std::max(largest, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return largest;
}

TEST(EdgeGrading, LaysShortEdgesInAZoneAndGrowsAwayFromIt) {
  Points line = Points::Zero(3, 1001);
  line.row(2).setLinSpaced(0.0, 1.0);
  const Points nodes = resample_graded(line, {0.02, {{0.4, 0.5, 0.005}}});
  EXPECT_EQ(nodes(2, 0), 0.0);
  EXPECT_EQ(nodes(2, nodes.cols() - 1), 1.0);
  double before = 0.0;
  for (Eigen::Index i = 0; i + 1 < nodes.cols(); ++i) {
    const double edge = nodes(2, i + 1) - nodes(2, i), middle = 0.5 * (nodes(2, i + 1) + nodes(2, i));
    const double wanted = std::min(0.02, 0.005 + 0.25 * std::max({0.0, 0.4 - middle, middle - 0.5}));
    EXPECT_NEAR(edge, wanted, 0.05 * wanted) << middle;
    if (before > 0.0) {
      EXPECT_LT(std::abs(edge / before - 1.0), 0.3) << middle;
    }
    before = edge;
  }
}

TEST(FishermanLoop, KeepsItsStrandsApartInEqualEdges) {
  const double h = FishermanShape().radius;
  for (const Handedness handedness : {Handedness::kSame, Handedness::kOpposite}) {
    for (const double looseness : {4.2, 4.7, 5.1}) {
      for (const double edge : {0.5 * h, 0.75 * h, h}) {
        FishermanShape shape;
        shape.handedness = handedness;
        shape.looseness = looseness;
        shape.edge_length = edge;
        const Centreline line = fisherman_loop(shape);
        expect_equal_edges(line.points, edge);
        const double gap = nearest_places(line.points, 1.5 * M_PI * h).distance / (2.0 * h);
        EXPECT_GT(gap, 1.05) << "looseness " << looseness << " edge " << edge / h;
        EXPECT_LT(largest_turn(line.points), edge / (0.8 * h));
        RecordProperty("gap", std::to_string(gap));
      }
    }
  }
}

TEST(FishermanLoop, LiesAroundItsRollersWithItsKnotsOnOneSide) {
  for (const Handedness handedness : {Handedness::kSame, Handedness::kOpposite}) {
    FishermanShape shape;
    shape.handedness = handedness;
    shape.knot_distance = 0.12;
    const double h = shape.radius;
    const Centreline line = fisherman_loop(shape);
    const double rolled = shape.roller_radius + h;
    for (const double z : {0.0, shape.end_to_end}) {
      const Eigen::VectorXd distance =
          (line.points.row(0).array().square() + (line.points.row(2).array() - z).square()).sqrt();
      EXPECT_GT(distance.minCoeff(), rolled - 0.02 * h);
      EXPECT_LT(distance.minCoeff(), rolled + 0.05 * h);
    }
    const Vec3 top = at(line, line.upper_apex);
    const Vec3 bottom = at(line, line.lower_apex);
    EXPECT_NEAR(top.z(), line.points.row(2).maxCoeff(), 0.1 * h);
    EXPECT_NEAR(bottom.z(), line.points.row(2).minCoeff(), 0.1 * h);
    EXPECT_NEAR(top.z() - bottom.z(), shape.end_to_end + 2.0 * rolled, 0.1 * h);

    ASSERT_EQ(line.knots.size(), 2u);
    const double middle = 0.5 * shape.end_to_end;
    for (int k = 0; k < 2; ++k) {
      const KnotLandmarks& knot = line.knots[static_cast<std::size_t>(k)];
      const double out = k == 0 ? -1.0 : 1.0;
      const double z = middle + out * 0.5 * shape.knot_distance;
      EXPECT_NEAR(at(line, knot.coil_middle).z(), z, 0.2 * h);
      EXPECT_NEAR(at(line, knot.threaded).z(), z, 0.05 * h);
      EXPECT_NEAR((at(line, knot.standing_begin).z() - z) * out, -5.0 * h, 0.05 * h);
      EXPECT_NEAR((at(line, knot.tail_end) - at(line, knot.tail_exit)).norm(), shape.tail, 1e-6);
      // Middle of the coil lies a coil's radius from the strand that it holds, and from its own standing part.
      const Vec3 axis = 0.5 * (at(line, knot.threaded) + at(line, knot.standing_begin));
      const Vec3 across = at(line, knot.coil_middle) - axis;
      EXPECT_NEAR(std::hypot(across.x(), across.y()), shape.looseness * h, 0.15 * h);
    }
  }
}

TEST(FishermanLoop, SameHandedKnotsAreImagesUnderAHalfTurn) {
  const FishermanShape shape;
  const Centreline line = fisherman_loop(shape);
  Points turned = line.points.rowwise().reverse();
  turned.row(1) *= -1.0;
  turned.row(2) = (shape.end_to_end - turned.row(2).array()).matrix();
  EXPECT_LT((turned - line.points).cwiseAbs().maxCoeff(), 1e-3 * shape.radius);
}

std::string refused_key(const FishermanShape& shape) {
  try {
    fisherman_loop(shape);
  } catch (const InvalidInput& error) {
    return error.key;
  }
  return "";
}

TEST(FishermanLoop, RefusesWhatDoesNotFitTheMachine) {
  EXPECT_EQ(refused_key({}), "");
  const struct {
    double FishermanShape::*member;
    double value;
    const char* key;
  } cases[] = {{&FishermanShape::knot_distance, 0.02, "specimen.knot_distance"},
               {&FishermanShape::knot_distance, 0.22, "specimen.end_to_end"},
               {&FishermanShape::end_to_end, 0.05, "specimen.end_to_end"},
               {&FishermanShape::edge_length, 0.01, "specimen.edge_length"},
               {&FishermanShape::edge_length, std::numeric_limits<double>::quiet_NaN(), "specimen.edge_length"},
               {&FishermanShape::tail, -0.1, "specimen.tail"},
               {&FishermanShape::looseness, 3.0, "specimen.looseness"},
               {&FishermanShape::roller_radius, 0.004, "machine.roller_diameter"}};
  for (const auto& one : cases) {
    FishermanShape shape;
    shape.*one.member = one.value;
    EXPECT_EQ(refused_key(shape), one.key) << one.value;
  }
}

TEST(Overhand, HasTheLengthAndEndsItIsAskedFor) {
  for (int turns = 1; turns <= 4; ++turns) {
    for (const double excess : {0.65, 0.9}) {
      OverhandShape shape;
      shape.turns = turns;
      shape.length = 2.0;
      shape.end_to_end = shape.length - excess;
      const Centreline line = overhand(shape);
      expect_equal_edges(line.points, shape.edge_length);
      EXPECT_NEAR(line.length(), shape.length, 0.01 * excess);
      EXPECT_LT(line.points.leftCols(1).norm(), 1e-9);
      EXPECT_LT((line.points.rightCols(1) - Vec3(0.0, 0.0, shape.end_to_end)).norm(), 1e-9);
      EXPECT_GT(nearest_places(line.points, 1.5 * M_PI * shape.radius).distance, 2.1 * shape.radius);
    }
  }
}

TEST(Overhand, TakesTheEndToEndDistancesThatARefusalNames) {
  OverhandShape shape;
  shape.end_to_end = 0.01;
  const std::string refusal = complaint_of([&] { overhand(shape); });
  std::smatch limits;
  ASSERT_TRUE(std::regex_search(refusal, limits, std::regex("([0-9.]+) to ([0-9.]+) m"))) << refusal;
  const double least = std::stod(limits[1]), most = std::stod(limits[2]);
  for (const double taken : {least, most}) {
    shape.end_to_end = taken;
    EXPECT_EQ(complaint_of([&] { overhand(shape); }), "");
  }
  for (const double refused : {0.99 * least, 1.01 * most}) {
    shape.end_to_end = refused;
    EXPECT_NE(complaint_of([&] { overhand(shape); }), "") << refused << ": " << refusal;
  }
}

/// A straight strand, one turn of a helix of ten radii h = 1 with a pitch of four, and a straight strand.
Points one_turn() {
  Points out(3, 101);
  for (int i = 0; i <= 100; ++i) {
    const double angle = 2.0 * M_PI * (i - 30) / 40.0;
    if (i < 30)
      out.col(i) << 4.0 * (i - 30), -10.0, 0.0;
    else if (i <= 70)
      out.col(i) << 10.0 * std::sin(angle), -10.0 * std::cos(angle), 0.1 * (i - 30);
    else
      out.col(i) << 4.0 * (i - 70), -10.0, 4.0;
  }
  return out;
}

TEST(FromPoints, HasShorterEdgesWhereTheRodComesNearItself) {
  const Points points = one_turn();
  const Points fine = 1e3 * from_points(1e-3 * points, 1e-3, 2e-3, "shape", 4.0).points;
  const std::vector<double> along = arclengths(fine);
  const double turn = 20.0 * M_PI, middle = 120.0 + 0.5 * turn;
  for (std::size_t i = 1; i < along.size(); ++i) {
    const double edge = along[i] - along[i - 1], here = 0.5 * (along[i] + along[i - 1]);
    if (std::abs(here - middle) < 0.5 * turn) {
      EXPECT_NEAR(edge, 0.5, 0.01) << "in the turn, at " << here;
    } else if (std::abs(here - middle) > 0.5 * turn + 20.0) {
      EXPECT_NEAR(edge, 2.0, 0.04) << "in the strands, at " << here;
    }
  }
  const Points line = straight(0.1, 1e-3, 2e-3).points;
  EXPECT_EQ(from_points(line, 1e-3, 2e-3, "shape", 4.0).points.cols(), 201) << "everywhere where it never does";
}

TEST(PartNearItself, IsThatOfAllPairsOfNodes) {
  for (const double near : {3.0, 4.5, 8.0, 15.0, 30.0}) {
    const Points points = one_turn();
    const std::vector<double> along = arclengths(points);
    double first = 1e9, last = -1e9;
    for (std::size_t i = 0; i < along.size(); ++i)
      for (std::size_t j = 0; j < along.size(); ++j) {
        const Vec3 gap = points.col(static_cast<int>(i)) - points.col(static_cast<int>(j));
        if (std::abs(along[i] - along[j]) < 25.0 || gap.norm() >= near) continue;
        first = std::min(first, along[i]);
        last = std::max(last, along[i]);
      }
    const auto part = part_near_itself(points, near, 25.0);
    ASSERT_EQ(part.has_value(), last > first) << near;
    if (!part) continue;
    EXPECT_EQ(part->first, first) << near;
    EXPECT_EQ(part->second, last) << near;
  }
}

Points two_strands_that_cross() {
  Points out(3, 4);
  out << Vec3(0.0, 0.0, 0.0), Vec3(0.2, 0.0, 0.0), Vec3(0.2, 0.1, 0.0), Vec3(0.1, -0.1, 0.0);
  return out;
}

TEST(FromPoints, RefusesOverlapAndNonsense) {
  Points crossing = two_strands_that_cross();
  EXPECT_THROW(from_points(crossing, 3e-3, 3e-3), InvalidInput);
  crossing(2, 3) = 0.1;
  EXPECT_NO_THROW(from_points(crossing, 3e-3, 3e-3));
  crossing(0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(from_points(crossing, 3e-3, 3e-3), InvalidInput);
  EXPECT_THROW(from_points(Points(3, 0), 3e-3, 3e-3), InvalidInput);
  const Points line = Points::Ones(3, 1) * Eigen::RowVector4d(0.0, 10.0, 20.0, 40.0);
  EXPECT_THROW(from_points(line, 3e-3, 3e-3), InvalidInput) << "more than 20000 edges";
}

/// What is said of points that are refused; empty: they are not.
std::string refusal(const Points& points, double radius, double edge_length) {
  return complaint_of([&] { from_points(points, radius, edge_length, "shape.csv"); });
}

/// A strand that lies half around a straight one. Between its nodes the polyline is nearer than a
/// diameter, whereas the smooth strand touches. The same around an axis that is 0.1 h nearer is refused.
TEST(FromPoints, TakesStrandsThatTouchAlongTheSmoothCentreline) {
  constexpr double h = 3e-3;
  const auto wound = [](double radius) {
    std::vector<Vec3> path = {{0.0, 0.0, -20.0 * h},
                              {0.0, 0.0, 20.0 * h},
                              {20.0 * h, 0.0, 24.0 * h},
                              {20.0 * h, -20.0 * h, 0.0},
                              {radius, -20.0 * h, 0.0}};
    for (int i = 0; i <= 12; ++i) {
      const double angle = M_PI / 12.0 * i;
      path.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    path.emplace_back(-radius, -20.0 * h, 0.0);
    Points out(3, static_cast<Eigen::Index>(path.size()));
    for (std::size_t i = 0; i < path.size(); ++i) out.col(static_cast<Eigen::Index>(i)) = path[i];
    return out;
  };
  EXPECT_EQ(refusal(wound(2.0 * h), h, h), "");
  EXPECT_THAT(refusal(wound(1.9 * h), h, h), testing::HasSubstr("strands overlap"));
}

TEST(NearestPlaces, SeesParallelCrossingAndEndOnSegments) {
  Points u(3, 4);
  u.col(0) << 0.0, 0.0, 0.0;
  u.col(1) << 1.0, 0.0, 0.0;
  u.col(2) << 1.0, 0.3, 0.0;
  u.col(3) << 0.0, 0.3, 0.0;
  EXPECT_NEAR(nearest_places(u, 0.1).distance, 0.3, 1e-12);
  u.col(3) << 0.5, -0.2, 0.1;
  EXPECT_NEAR(nearest_places(u, 0.1).distance, 0.3 * 0.1 / std::hypot(0.5, 0.1), 1e-12);
  // Where it is nearest to the first edge's line: 0.3 - 0.5 u and 0.1 u off it.
  const double u_nearest = 0.3 * 0.5 / (0.5 * 0.5 + 0.1 * 0.1);
  EXPECT_NEAR(nearest_places(u, 0.1).first, 1.0 - 0.5 * u_nearest, 1e-12);
  EXPECT_NEAR(nearest_places(u, 0.1).second, 1.3 + u_nearest * std::sqrt(0.51), 1e-12);
  EXPECT_EQ(nearest_places(u, 10.0).distance, std::numeric_limits<double>::infinity());
}

Material similar(double lengths, double forces) {
  Material out = nylon();
  out.radius *= lengths;
  out.bending_stiffness *= forces * lengths * lengths;
  return out;
}

TEST(SpecimenScales, SimilarSpecimensOfAnyDensityMoveAlike) {
  for (const double lengths : {0.04, 1.0, 6.0})
    for (const double forces : {1e-5, 1.0, 1e4}) {
      Material material = similar(lengths, forces);
      // More than tau = 2e-4 s takes.
      material.density *= std::pow((1.0 + lengths) * 2e-4 / specimen_scales(material).own_time, 2);
      const Material moving = with_scaled_inertia(material, {}, 0.0);
      EXPECT_NEAR(specimen_scales(moving).own_time, 2e-4, 1e-16);
      const double h2 = material.radius * material.radius;
      EXPECT_NEAR(drag_to_rest(moving, false) * h2 * h2 / material.bending_stiffness, 1.2e-7, 1e-19);
      EXPECT_NEAR(specimen_scales(moving).rest_speed / material.radius, 0.0063, 1e-15);
    }
}

TEST(SpecimenScales, SimilarLoopsAccelerateTheSameMassWhateverTheirOwnIs) {
  Material light = nylon();
  light.density *= 1e-3;
  EXPECT_NEAR(inertia_factor(light, {}, 0.0), 1e3 * inertia_factor(nylon(), {}, 0.0), 1e-9);
  EXPECT_LT(inertia_factor(nylon(), {}, 0.0), 1.0);
  // A rod with slack swings, and no more than its own mass is accelerated.
  for (const double slack : {1e-3, 10.0}) EXPECT_LE(inertia_factor(light, {}, slack), 1.0) << slack;
}

TEST(SpecimenScales, ALoopHasADragHoweverLightItIs) {
  Material thread = nylon();
  for (const double lighter : {1e-3, 1e-9}) {
    thread.density = lighter * nylon().density;
    EXPECT_NEAR(drag_to_rest(thread, true) * std::pow(thread.radius, 4) / thread.bending_stiffness, 1.2e-9, 1e-21);
    EXPECT_EQ(drag_to_rest(thread, false), 3.0 * specimen_scales(thread).mass);
  }
  EXPECT_EQ(drag_to_rest(nylon(), true), drag_to_rest(nylon(), false));
}

TEST(SpecimenScales, ASlackLoopSpringsFast) {
  const Material material = nylon();
  const double h = material.radius, tight = 100.0 * h, slack = 1000.0 * h, radius = slack / (2.0 * M_PI);
  EXPECT_EQ(inertia_factor(material, {}, tight), inertia_factor(material, {}, 0.0));
  const SpecimenScales moving = specimen_scales(with_scaled_inertia(material, {}, slack));
  EXPECT_NEAR(radius * radius * std::sqrt(moving.mass / material.bending_stiffness), 0.1, 1e-12);
}

}  // namespace
}  // namespace knot_utm
