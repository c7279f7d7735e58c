#include "knot_utm/contact/edge_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "contact/nodal_forces.hpp"
#include "knot_utm/contact/closest_points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/material.hpp"
#include "reference.hpp"
#include "rod/finite_difference.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 3e-3;

// ---- the law ----------------------------------------------------------------------------------------------------

TEST(R10EdgeLaw, ForceAtTouchAndEnergyJumpAtTheSeam) {
  const EdgeLaw law{3e6, 1e-4};
  const double factor = 0.5 * law.stiffness;  // of f
  hold_against("R10 edge law, centrelines 2h apart: f/delta", std::log(2.0) / 15.0,
               law.pressure(0.0) / (factor * law.tolerance), 1e-12);
  const double inside = law.energy(std::nextafter(law.tolerance, 0.0)), beyond = law.energy(law.tolerance);
  hold_against("R10 edge law at 2h - delta: relative jump of energy", 4e-8, inside / beyond - 1.0, 0.05);
  EXPECT_EQ(law.energy(-law.tolerance), 0.0);
  EXPECT_LT(law.energy(std::nextafter(-law.tolerance, 0.0)), 1e-14 * beyond);
}

TEST(EdgeLaw, SlopeEnergyAndInverseBelongToThePressure) {
  const EdgeLaw law{3e6, 1e-4};
  for (const double overlap : {-9e-5, -4e-5, 0.0, 3e-5, 9e-5, 1.3e-4, 4e-4}) {
    const double step = 1e-9;
    const double p = law.pressure(overlap);
    EXPECT_NEAR(law.slope(overlap), (law.pressure(overlap + step) - law.pressure(overlap - step)) / (2 * step),
                1e-6 * law.slope(overlap));
    EXPECT_NEAR(p, (law.energy(overlap + step) - law.energy(overlap - step)) / (2 * step), 1e-6 * p);
    EXPECT_NEAR(law.overlap_at(p), overlap, 1e-10 * law.tolerance);
  }
}

// ---- closest points ---------------------------------------------------------------------------------------------

struct EdgePair {
  Vec3 p, a, q, b;
  double objective(double t, double u, double r) const {
    return 0.5 * (p + t * a - q - u * b).squaredNorm() + 0.5 * r * ((t - 0.5) * (t - 0.5) + (u - 0.5) * (u - 0.5));
  }
};

/// Smallest objective over a grid that closes in on its best point; convex, so the best point is not lost.
double brute_force(const EdgePair& pair, double r) {
  constexpr int kGrid = 20;
  double low_t = 0.0, high_t = 1.0, low_u = 0.0, high_u = 1.0, best = 1e300;
  for (int round = 0; round < 14; ++round) {
    double best_t = 0.0, best_u = 0.0;
    best = 1e300;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; j <= kGrid; ++j) {
        const double t = low_t + (high_t - low_t) * i / kGrid, u = low_u + (high_u - low_u) * j / kGrid;
        const double value = pair.objective(t, u, r);
        if (value < best) best = value, best_t = t, best_u = u;
      }
    // A narrow oblique valley may run past the neighbouring grid points: keep half of the range.
    const double dt = 0.25 * (high_t - low_t), du = 0.25 * (high_u - low_u);
    low_t = std::max(0.0, best_t - dt), high_t = std::min(1.0, best_t + dt);
    low_u = std::max(0.0, best_u - du), high_u = std::min(1.0, best_u + du);
  }
  return best;
}

TEST(ClosestPoints, AreThoseThatBruteForceFinds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  auto vector = [&] { return Vec3(place(random), place(random), place(random)); };
  int inside = 0, at_end = 0, at_both_ends = 0;
  for (int i = 0; i < 400; ++i) {
    EdgePair pair{vector(), vector(), vector(), vector()};
    if (i % 4 == 0) pair.b = place(random) * pair.a;                // parallel
    if (i % 4 == 1) pair.b = pair.a + 0.01 * vector();              // nearly so
    if (i % 8 == 2) pair.q = pair.p + 0.5 * pair.a - 0.5 * pair.b;  // crossing
    for (const double r : {0.0, 0.01}) {
      const ClosestPoints at = closest_points(pair.p, pair.a, pair.q, pair.b, r);
      EXPECT_GE(at.t, 0.0);
      EXPECT_LE(at.t, 1.0);
      EXPECT_GE(at.u, 0.0);
      EXPECT_LE(at.u, 1.0);
      EXPECT_LE(pair.objective(at.t, at.u, r), brute_force(pair, r) + 1e-12) << "pair " << i << ", r = " << r;
      if (r > 0.0) ++(at.t_free && at.u_free ? inside : at.t_free || at.u_free ? at_end : at_both_ends);
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(at_end, 20);
  EXPECT_GT(at_both_ends, 20);
}

TEST(ClosestPoints, DoNotJumpThroughParallelOnceRegularised) {
  // One edge turns over the other; without r the foot leaps from one end to the other.
  auto foot = [](double angle, double r) {
    const Vec3 b(std::cos(angle), std::sin(angle), 0.0);
    return closest_points(Vec3(-0.5, 0.0, 1.0), Vec3::UnitX(), -0.5 * b - Vec3(0.0, 0.02, 0.0), b, r).t;
  };
  double leap = 0.0, smooth = 0.0;
  const double step = 1e-4;
  for (double angle = -0.2; angle < 0.2; angle += step) {
    leap = std::max(leap, std::abs(foot(angle + step, 0.0) - foot(angle, 0.0)));
    smooth = std::max(smooth, std::abs(foot(angle + step, 0.01) - foot(angle, 0.01)));
  }
  EXPECT_GT(leap, 0.9);
  EXPECT_LT(smooth, 0.01);
}

// ---- forces and their derivative --------------------------------------------------------------------------------

/// A rod of two strands of which just one edge each comes near: strand a along x, strand b across, at `angle` from
/// it, passing the point `where` (fractions of the two edges) at the distance `gap`. All other edges lead away.
struct TwoEdges {
  RodProperties rod;
  Points start, position;

  TwoEdges(double angle, double where_a, double where_b, double gap) {
    Material material;
    material.radius = kRadius;
    material.density = 1000.0;
    const double l = 0.9 * kRadius;
    const Vec3 a(l, 0.0, 0.0), b(l * std::cos(angle), l * std::sin(angle), 0.0);
    const double away = 10.0 * kRadius;
    position.resize(3, 8);
    position.col(1) = -where_a * a;
    position.col(2) = position.col(1) + a;
    position.col(5) = Vec3(0.0, 0.0, gap) - where_b * b;
    position.col(6) = position.col(5) + b;
    position.col(0) = position.col(1) - Vec3(0.0, 0.0, away);
    position.col(3) = position.col(2) - Vec3(0.0, away, away);
    position.col(4) = position.col(5) + Vec3(0.0, -away, away);
    position.col(7) = position.col(6) + Vec3(0.0, 0.0, away);
    Eigen::VectorXd rest(7);
    for (int i = 0; i < 7; ++i) rest[i] = (position.col(i + 1) - position.col(i)).norm();
    rod = make_rod(material, rest);
    start = position;
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 0.0005 * kRadius);
    for (Eigen::Index i = 0; i < position.size(); ++i) position.data()[i] += noise(random);
  }

  Eigen::VectorXd forces(EdgeContact& contact, const Points& x, double dt) const {
    contact.begin(start);
    contact.evaluate(x, start, dt);
    return nodal_forces(contact.contacts(), x.cols());
  }

  Eigen::MatrixXd stiffness(EdgeContact& contact, const Points& x, double dt) const {
    contact.begin(start);
    contact.evaluate(x, start, dt);
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(x.size(), x.size());
    for (ContactPoint& point : contact.contacts()) point.prediction = -1.0;  // tangents at the present overlap
    std::vector<EdgeContactModel> models;
    contact.linearise({}, dt, models);
    std::size_t n = 0;
    for (const ContactPoint& point : contact.contacts()) {
      if (!point.active()) continue;
      const EdgeContactModel& model = models[n++];
      auto node = [&](int k) { return k < 3 ? point.a0 + k : point.b0 + k - 3; };
      for (int k = 0; k < 6; ++k)
        for (int l = 0; l < 6; ++l) out.block<3, 3>(3 * node(k), 3 * node(l)) += model.stiffness(k, l);
    }
    return out;
  }
};

struct Law {
  const char* name;
  Friction friction;
};
struct Place {
  const char* name;
  double angle, where_a, where_b, gap;  // gap in radii
};

class EdgeContactJacobian : public testing::TestWithParam<std::tuple<Law, Place>> {};

TEST_P(EdgeContactJacobian, IsTheDerivativeOfTheForces) {
  const auto& [law, place] = GetParam();
  TwoEdges scene(place.angle, place.where_a, place.where_b, place.gap * kRadius);
  EdgeContact contact(scene.rod, NormalLaw{1e6, 0.05 * kRadius}, law.friction, 0.5 * kRadius);
  const double dt = 0.01;
  contact.begin(scene.start);
  contact.evaluate(scene.start, scene.start, dt);
  contact.commit(scene.start);

  const Eigen::MatrixXd analytic = scene.stiffness(contact, scene.position, dt);
  ASSERT_GT(analytic.norm(), 0.0);
  const auto force = [&](const Eigen::VectorXd& x) { return scene.forces(contact, unflat(x), dt); };
  const Eigen::MatrixXd numeric = -finite_difference(force, flat(scene.position), 1e-7 * kRadius);
  EXPECT_LT((analytic - numeric).norm(), 2e-6 * numeric.norm());
}

INSTANTIATE_TEST_SUITE_P(
    Cases, EdgeContactJacobian,
    testing::Combine(testing::Values(Law{"frictionless", MemoryFriction{0.0, 1.0}},
                                     Law{"sticking", MemoryFriction{0.4, 0.5 * kRadius}},
                                     Law{"slipping", MemoryFriction{0.4, 1e-4 * kRadius}},
                                     Law{"smoothed", SmoothedFriction{0.4, 2e-3}}),
                     testing::Values(Place{"crossing", 1.2, 0.4, 0.7, 1.97},
                                     Place{"crossing_deep", 1.2, 0.4, 0.7, 1.85},
                                     Place{"nearly_parallel", 0.03, 0.5, 0.55, 1.97},
                                     Place{"end_of_a", 1.2, -0.4, 0.6, 1.93}, Place{"end_of_b", 1.2, 0.4, 1.4, 1.93},
                                     Place{"two_ends", 0.7, 1.4, -0.4, 1.7})),
    [](const auto& test) { return std::string(std::get<0>(test.param).name) + "_" + std::get<1>(test.param).name; });

/// Two strands of one rod that cross at a right angle, the first one driven along x over the second one. What joins
/// them leads far around.
struct Crossing {
  static constexpr int kStrand = 11;
  static constexpr double kEdge = 0.9 * kRadius;
  RodProperties rod;
  Points position;

  Crossing() {
    position.resize(3, 2 * kStrand + 2);
    for (int i = 0; i < kStrand; ++i) {
      position.col(i) << kEdge * (i - 6.3), 0.0, 1.99 * kRadius;
      position.col(kStrand + 2 + i) << 0.0, kEdge * (4.4 - i), 0.0;
    }
    position.col(kStrand) << 20.0 * kRadius, 0.0, 20.0 * kRadius;
    position.col(kStrand + 1) << 0.0, 20.0 * kRadius, 20.0 * kRadius;
    Material material;
    material.radius = kRadius;
    Eigen::VectorXd rest(position.cols() - 1);
    for (Eigen::Index i = 0; i < rest.size(); ++i) rest[i] = (position.col(i + 1) - position.col(i)).norm();
    rod = make_rod(material, rest);
  }

  /// Drives the first strand by `stride` along x; sum of the frictions over sum of the normal forces. (Not their
  /// components: the normal at the end of an edge leans, which is this law's ripple.)
  double drive(EdgeContact& contact, double stride, double dt) {
    const Points start = position;
    position.leftCols(kStrand).row(0).array() += stride;
    contact.begin(position);
    contact.evaluate(position, start, dt);
    double normal = 0.0, tangential = 0.0;
    for (const ContactPoint& point : contact.contacts()) {
      const double along = point.n.dot(point.force);
      normal += along;
      tangential += (point.force - along * point.n).norm();
    }
    contact.commit(position);
    return tangential / normal;
  }
};

TEST(EdgeContact, FrictionKeepsItsMemoryAsStrandsSlideOnFromEdgeToEdge) {
  Crossing scene;
  const double mu = 0.4, presliding = 1e-2 * kRadius;
  EdgeContact contact(scene.rod, NormalLaw{1e6, 0.05 * kRadius}, MemoryFriction{mu, presliding}, 0.5 * kRadius);
  const double stride = 0.25 * presliding;
  for (int i = 1; i <= 4; ++i) EXPECT_NEAR(scene.drive(contact, stride, 0.01), 0.25 * i * mu, 0.01 * mu);
  const int steps = static_cast<int>(3.0 * Crossing::kEdge / stride);
  double least = mu;
  for (int i = 0; i < steps; ++i) least = std::min(least, scene.drive(contact, stride, 0.01));
  EXPECT_GT(least, 0.999 * mu);
  // Turned back by half, and then at rest.
  const double back = scene.drive(contact, -0.5 * presliding, 0.01);
  EXPECT_NEAR(back, 0.5 * mu, 0.01 * mu);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(scene.drive(contact, 0.0, 0.01), back, 1e-9 * mu);
}

TEST(EdgeContact, PairsHoldEveryPairThatBruteForceFinds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 0.04);
  std::normal_distribution<double> turn(0.0, 1.0);
  Material material;
  material.radius = kRadius;
  const int nodes = 80;
  const double l = 2e-3;
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(nodes - 1, l));
  EdgeContact contact(rod, NormalLaw{1e6, 0.05 * kRadius}, {}, 0.5 * kRadius);
  Points x(3, nodes);
  x.col(0).setConstant(0.02);
  for (int i = 1; i < nodes; ++i)
    x.col(i) = Vec3(x.col(i - 1)) + l * Vec3(turn(random), turn(random), turn(random)).normalized();
  contact.begin(x);
  std::vector<std::pair<int, int>> missing;
  int near = 0;
  for (int a = 0; a + 1 < nodes; ++a)
    for (int b = a + 1; b + 1 < nodes; ++b) {
      if (l * (b - a - 1) < 5.0 * kRadius) continue;
      const Vec3 da = x.col(a + 1) - x.col(a), db = x.col(b + 1) - x.col(b);
      const ClosestPoints at = closest_points(x.col(a), da, x.col(b), db, 0.0);
      if ((x.col(a) + at.t * da - x.col(b) - at.u * db).norm() > 2.3 * kRadius) continue;
      ++near;
      if (std::find(contact.pairs().begin(), contact.pairs().end(), std::pair{a, b}) == contact.pairs().end())
        missing.push_back({a, b});
    }
  EXPECT_GT(near, 50);
  EXPECT_TRUE(missing.empty());
}

}  // namespace
}  // namespace knot_utm
