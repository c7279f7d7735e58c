// knot: capstan.

#include "sim/capstan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/contact/friction.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "reference.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

constexpr double kMu = 0.3;

/// As a method has it that sets no more than these.
SpecimenOptions strand(double wrap, double tail_load) {
  const KnotKind kind = knot_named("capstan");
  SpecimenOptions out = knot_of(kind).defaults(nylon().radius);
  out.knot = kind;
  out.wrap = wrap;
  out.tail_load = tail_load;
  return out;
}

Centreline sketched(const SpecimenOptions& specimen) { return knot_of(specimen).centreline(specimen, nylon(), {}); }
Roller post(const SpecimenOptions& specimen) { return knot_of(specimen).supports(specimen, nylon()).posts.at(0); }

double bend_radius(const SpecimenOptions& specimen) { return 0.5 * specimen.post_diameter + nylon().radius; }

class CapstanSpecimenOf : public testing::TestWithParam<double> {};

TEST_P(CapstanSpecimenOf, LiesAroundThePostByItsAngle) {
  SpecimenOptions specimen = strand(GetParam(), 1.0);
  specimen.edge_length /= 40.0;
  const Points points = sketched(specimen).points;
  const Vec3 axis = post(specimen).axis;
  const double rho = bend_radius(specimen);
  double turned = 0.0, nearest = rho;
  for (Eigen::Index i = 0; i + 1 < points.cols(); ++i) {
    const Vec3 from = points.col(i + 1) - points.col(i);
    nearest = std::min(nearest, points.col(i).cross(axis).norm());
    if (i + 2 == points.cols()) break;
    const Vec3 to = points.col(i + 2) - points.col(i + 1);
    turned += std::atan2(from.cross(to).norm(), from.dot(to));
  }
  EXPECT_NEAR(turned, GetParam(), 1e-6 * GetParam());
  EXPECT_NEAR(nearest, rho, 1e-9 * rho);
  EXPECT_NO_THROW(check_no_overlap(sketched(specimen), nylon().radius, "specimen.wrap", "this"));
}

TEST_P(CapstanSpecimenOf, IsPulledAlongBothItsEnds) {
  const SpecimenOptions specimen = strand(GetParam(), 2.0);
  const Points points = sketched(specimen).points;
  const Eigen::Index last = points.cols() - 1;
  EXPECT_NEAR((points.col(last) - points.col(last - 1)).normalized()[2], 1.0, 1e-12);
  EXPECT_NEAR(points(2, last), specimen.end_to_end, 1e-12);
  const NodeForce load = knot_of(specimen).supports(specimen, nylon()).loads.at(0);
  EXPECT_EQ(load.node, 0);
  EXPECT_LT((load.force - 2.0 * (points.col(0) - points.col(1)).normalized()).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Angles, CapstanSpecimenOf, testing::Values(0.5, M_PI, 4.0 * M_PI));

/// T2/T1 as the upper grip feels it, the mean over the last third of a pull by one and a half bend radii; and the force
/// on post and load over that.
struct Ratios {
  double upper = 0.0, lower = 0.0;
};

Ratios pulled(const SpecimenOptions& specimen, double friction_couple = 0.0, const FrictionOptions& friction = {}) {
  constexpr int kCommands = 100;
  MachineOptions machine;
  machine.grips = GripKind::kNodes;
  machine.roller_friction = kMu;
  Material material = nylon();
  material.friction_couple = friction_couple;
  PhysicsOptions physics;
  physics.friction = friction;
  TestingMachine bench(specimen, material, machine, physics);
  Command command;
  command.phase = Phase::kHold;
  command.time = 2.0;
  EXPECT_NE(bench.respond(command).status, BenchStatus::kFailed);
  command.phase = Phase::kPull;
  command.step = 1;
  const double way = knot_of(specimen).pull(specimen, nylon().radius), t1 = *specimen.tail_load;
  Ratios out;
  int counted = 0;
  for (int k = 1; k <= kCommands; ++k) {
    command.sequence = static_cast<std::uint64_t>(k);
    command.time = 2.0 + 10.0 * k / kCommands;
    command.displacement = way * k / kCommands;
    const Sample sample = bench.respond(command);
    if (sample.status == BenchStatus::kFailed) {
      ADD_FAILURE() << sample.message;
      break;
    }
    EXPECT_NEAR(sample.extension, command.displacement, 1e-12);
    if (3 * k <= 2 * kCommands) continue;
    out.upper += sample.force_upper / t1;
    out.lower += sample.force_lower / t1;
    ++counted;
  }
  out.upper /= counted;
  out.lower /= counted;
  return out;
}

class R8OnTheMachine : public testing::TestWithParam<std::pair<double, double>> {};

/// The law of the elastic capstan, by the angle and the tail load in k_b/rho^2. Points of integration stand on the arc
/// of the rod's own length, so that edges of nearly a quarter of a radian leave no lever-arm error; points on the
/// spline itself would be 2 % off.
TEST_P(R8OnTheMachine, SlidesAtTheElasticRatio) {
  const auto [wrap, t1] = GetParam();
  const double rho = bend_radius(strand(wrap, 1.0));
  const Ratios ratios = pulled(strand(wrap, t1 * nylon().bending_stiffness / (rho * rho)));
  hold_against(formatted("R8 on the machine, wrap %.4g, T1 rho^2/B = %.3g: T2/T1", wrap, t1),
               elastic_capstan(t1, kMu, wrap), ratios.upper, t1 < 10.0 ? 0.01 : 0.005);
  EXPECT_NEAR(ratios.lower, ratios.upper, 1e-3 * ratios.upper);
}

constexpr double kTurn = 2.0 * M_PI;
INSTANTIATE_TEST_SUITE_P(Loads, R8OnTheMachine,
                         testing::Values(std::pair{M_PI / 2.0, 50.0}, std::pair{M_PI, 50.0}, std::pair{kTurn, 2.0},
                                         std::pair{kTurn, 10.0}, std::pair{kTurn, 50.0}, std::pair{kTurn, 1000.0}));

/// The numbers of doc/references.md.
TEST(R8ElasticLaw, IsSolvedAsItIsListed) {
  for (const auto& [t1, ratio] : {std::pair{2.0, 5.319}, {10.0, 6.305}, {50.0, 6.527}, {1000.0, 6.583}})
    EXPECT_NEAR(elastic_capstan(t1, kMu, kTurn), ratio, 5e-4);
}

/// With dT/dphi = mu p_r rho (T/(p_r rho))^n around a post,
///     T2^(1-n) = T1^(1-n) + (1 - n) mu (p_r rho)^(1-n) phi.
TEST(PowerFriction, HowellsCapstan) {
  constexpr double kExponent = 0.8, kThread = 1000.0;  // of a rod that its tension bends as if it were a thread
  const double rho = bend_radius(strand(kTurn, 1.0)), t1 = kThread * nylon().bending_stiffness / (rho * rho);
  FrictionOptions friction;
  friction.law = static_cast<FrictionLaw>(FrictionLaws(PowerFriction()).index());
  friction.values = {{"exponent", kExponent}, {"reference_pressure", t1 / rho}};
  const double expected = std::pow(1.0 + (1.0 - kExponent) * kMu * kTurn, 1.0 / (1.0 - kExponent));
  EXPECT_LT(expected, 0.8 * std::exp(kMu * kTurn)) << "Coulomb's law must be told from it";
  hold_against("Howell's capstan, n = 0.8: T2/T1", expected, pulled(strand(kTurn, t1), 0.0, friction).upper, 0.01);
}

TEST(R15OnTheMachine, SlidesAtTheRatioOfFrictionAtTheSurface) {
  const double wrap = 2.0 * M_PI;
  const SpecimenOptions specimen = strand(wrap, specimen_scales(nylon()).force);
  const double eta = nylon().radius / bend_radius(specimen);
  hold_against("R15 on the machine, h/rho = 1/7: T2/T1", std::exp(wrap * surface_exponent(kMu, eta)),
               pulled(specimen, 1.0).upper, 0.02);
}

}  // namespace
}  // namespace knot_utm
