// Rods that are curved or twisted at rest, against what they need to be held straight and what they become when free.

#include "knot_utm/specimen/rest_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/specimen/options.hpp"
#include "sim/balance.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 20;
constexpr double kTurn = 1.5;  // of the whole rod at rest [rad]

struct Filament {
  Material material = braided_rope();
  RodProperties rod;
  StepSettings settings;
  RodState state;
  SpecimenOptions specimen;
  double edge = material.radius;

  Filament() {
    material.twisting_stiffness = 0.8 * material.bending_stiffness;
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, edge));
    settings = closed_form_settings(material);
    settings.drag = 5.0;
    state = straight_state(rod);
  }
  double curvature() const { return kTurn / (kEdges * edge); }
  std::unique_ptr<TimeStep> stepper() {
    give_rest_shape(specimen, &rod, &state);
    return TimeStep::make(rod, state, settings);
  }
  Boundary held() const {
    Boundary out;
    for (int i = 0; i <= kEdges; ++i) out.fixed_nodes.push_back({i, state.position.col(i)});
    out.fixed_twists = {{0, 0.0}, {kEdges - 1, 0.0}};
    return out;
  }
};

/// Its ends would move to the side towards which it turns. A clamp bears the couple k_b kappa_0 by two forces, an edge
/// apart; between the clamps nothing pushes it aside.
TEST(RestShape, ARodHeldStraightNeedsTheCoupleOfItsNaturalCurvature) {
  for (const auto& [towards, side] : {std::pair{Axis::kY, Vec3(Vec3::UnitY())}, {Axis::kZ, Vec3(Vec3::UnitZ())}}) {
    Filament scene;
    scene.specimen.natural_curvature = scene.curvature();
    scene.specimen.natural_towards = towards;
    const std::unique_ptr<TimeStep> stepper = scene.stepper();
    ASSERT_TRUE(stepper->step(scene.held(), 0.01).accepted());
    const Vec3 force = scene.material.bending_stiffness * scene.curvature() / scene.edge * side;
    const double rounding = 1e-9 * force.norm();
    const auto reaction = [&](int node) { return stepper->readings().reaction(node); };
    EXPECT_LT((reaction(0) + force).norm(), rounding);
    EXPECT_LT((reaction(1) - force).norm(), rounding);
    EXPECT_LT((reaction(kEdges - 1) - force).norm(), rounding);
    EXPECT_LT((reaction(kEdges) + force).norm(), rounding);
    for (int i = 2; i < kEdges - 1; ++i) EXPECT_LT(reaction(i).norm(), rounding) << i;
  }
}

void expect_turns(const Points& x, double turn, double error) {
  const Points t = tangents(x);
  for (int i = 1; i < kEdges; ++i) EXPECT_NEAR(turning_angle(t.col(i - 1), t.col(i)), turn, error) << i;
}

TEST(RestShape, AFreeRodSpringsIntoItsCircle) {
  Filament scene;
  scene.specimen.natural_curvature = -scene.curvature();
  scene.specimen.natural_towards = Axis::kY;
  Balance balance(scene.stepper(), scene.settings, 0.02);
  const Boundary free;
  balance.run(20.0, [&](double) -> const Boundary& { return free; });
  const Points& x = balance.stepper().state().position;
  expect_turns(x, kTurn / kEdges, 1e-5);
  EXPECT_GT(x(1, kEdges / 2), x(1, 0)) << "a negative curvature turns it to the other side";
  EXPECT_LT(x.row(2).cwiseAbs().maxCoeff(), 1e-9 * scene.edge) << "in the plane of that side";
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
}

/// A grip bears 2 pi rho k_t, positive at the far end of a rod that was turned to the right.
TEST(RestShape, APreTwistedRodHeldStraightKeepsItsTorque) {
  Filament scene;
  scene.specimen.pre_twist = 1.3;
  const std::unique_ptr<TimeStep> stepper = scene.stepper();
  EXPECT_FALSE(stepper->state().curved_at_rest()) << "a straight rod needs no natural curvature";
  ASSERT_TRUE(stepper->step(scene.held(), 0.01).accepted());
  const double torque = 2.0 * M_PI * 1.3 * scene.material.twisting_stiffness;
  EXPECT_NEAR(stepper->readings().reaction_torque(kEdges - 1), torque, 1e-9 * torque);
  EXPECT_NEAR(stepper->readings().reaction_torque(0), -torque, 1e-9 * torque);
}

/// Let go, a filament that was curved before it was twisted turns back and lies in its plane circle again. The
/// curvature of a node is the mean of its edges, an error of second order in the twist between them.
TEST(RestShape, ATwistedFilamentThatIsFreeIsAPlaneCircleAgain) {
  Filament scene;
  scene.specimen.natural_curvature = scene.curvature();
  scene.specimen.natural_towards = Axis::kY;
  scene.specimen.pre_twist = 3.0;
  const double between = 2.0 * M_PI * 3.0 * scene.edge;  // of two edges [rad]
  Balance balance(scene.stepper(), scene.settings, 0.02);
  const Boundary free;
  balance.run(20.0, [&](double) -> const Boundary& { return free; });
  const RodState& state = balance.stepper().state();
  expect_turns(state.position, kTurn / kEdges, between * between / 8.0 * kTurn / kEdges + 1e-5);
  EXPECT_NEAR((state.twist[kEdges - 1] - state.twist[0] + state.reference_twist.sum()) / (kEdges - 1), -between,
              1e-3 * between);
  const Points t = tangents(state.position);
  const Vec3 normal = Vec3(t.col(0)).cross(Vec3(t.col(kEdges - 1))).normalized();
  EXPECT_LT((normal.transpose() * t).cwiseAbs().maxCoeff(), 0.5 * between * kTurn / kEdges + 1e-5) << "plane";
}

}  // namespace
}  // namespace knot_utm
