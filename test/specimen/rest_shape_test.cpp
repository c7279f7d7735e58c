// Rods that are curved at rest, against what they need to be held straight and what they become when free.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/specimen/centreline.hpp"
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
    give_rest_shape(specimen, rod, &state);
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
  for (const auto& [along, side] : {std::pair{0, Vec3(Vec3::UnitY())}, {2, Vec3(Vec3::UnitX())}}) {
    Filament scene;
    if (along != 0) scene.state.position.row(0).swap(scene.state.position.row(along));
    scene.specimen.natural_curvature = scene.curvature();
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
  Balance balance(scene.stepper(), scene.settings, 0.02);
  const Boundary free;
  balance.run(20.0, [&](double) -> const Boundary& { return free; });
  const Points& x = balance.stepper().state().position;
  expect_turns(x, kTurn / kEdges, 1e-5);
  EXPECT_GT(x(1, kEdges / 2), x(1, 0)) << "a negative curvature turns it to the other side";
  EXPECT_LT(x.row(2).cwiseAbs().maxCoeff(), 1e-9 * scene.edge) << "in the plane of that side";
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
}

TEST(RestShape, WithoutACurvatureThereAreNoFrames) {
  Filament scene;
  give_rest_shape(scene.specimen, scene.rod, &scene.state);
  EXPECT_EQ(scene.state.twist.size(), 0);
}

}  // namespace
}  // namespace knot_utm
