// A spring that holds a node, softer in one direction than in another.

#include <gtest/gtest.h>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// At rest under a force F the node stands at X + K^-1 F, of each direction its own; nothing else holds the rod, which
/// moves as a whole. Off by what the residual leaves.
TEST(SpringHold, GivesWayByForceOverStiffness) {
  const Material material = braided_rope();
  const double h = material.radius;
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(8, h));
  const RodState state = straight_state(rod);
  StepSettings settings = closed_form_settings(material);
  settings.drag = 100.0;  // rests at once
  const auto stepper = TimeStep::make(rod, state, settings);
  Boundary boundary;
  SpringHold hold;
  hold.node = 4;
  hold.place = state.position.col(4);
  hold.stiffness = Vec3(10.0, 20.0, 40.0).asDiagonal();
  boundary.holds = {hold};
  const Vec3 force(1e-3, -2e-3, 8e-3);
  boundary.forces = {{4, force}};
  double work = 0.0;
  for (int k = 0; k < 400; ++k) {
    ASSERT_TRUE(stepper->step(boundary, 0.05).accepted());
    work += stepper->readings().work().boundary;
  }
  const Vec3 moved = stepper->state().position.col(4) - hold.place;
  const Vec3 expected(1e-4, -1e-4, 2e-4);
  EXPECT_LT((moved - expected).norm(), settings.residual / 10.0 + 1e-9);
  EXPECT_GT(work, 0.0);
}

}  // namespace
}  // namespace knot_utm
