#include "knot_utm/tying/tying_rig.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "knot_utm/specimen/fisherman.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPreload = 0.05;  // small: the grips slip soon [N]

Material soft() {
  Material out = pink_vps();
  out.friction_coefficient = 0.3;
  return out;
}

/// A short, coarse loop in the tying rig, without a machine around it.
struct Loop {
  Centreline centreline;
  RodProperties rod;
  std::unique_ptr<TimeStep> stepper;
  std::unique_ptr<TyingRig> rig;
  Boundary boundary;
  double time = 0.0;
  double largest_tail_force = 0.0, farthest_clamp = 0.0;

  explicit Loop(TyingRig::Options options) {
    const Material material = soft();
    const double h = material.radius, bend = material.bending_stiffness / (h * h);
    FishermanShape shape;
    shape.edge_length = 0.006;
    centreline = fisherman_loop(shape);
    rod = make_rod(material, (centreline.points.rightCols(centreline.points.cols() - 1) -
                              centreline.points.leftCols(centreline.points.cols() - 1))
                                 .colwise()
                                 .norm());
    RodState state;
    state.position = centreline.points;
    state.velocity = Points::Zero(3, state.position.cols());
    StepSettings settings;
    settings.pressure_law = NormalLaw{300.0 * bend / (h * h), 0.1 * h, 0.02 * h};
    settings.friction = MemoryFriction{material.friction_coefficient, 4e-3 * h};
    settings.drag = 0.1;
    settings.residual = 1e-4 * bend;
    settings.newton_cap = 0.1 * h;
    settings.motion_limit = 0.8 * h;
    settings.overlap_limit = 0.5 * h;
    settings.candidate_margin = 0.5 * h;
    stepper = TimeStep::make(rod, state, settings);
    options.preload = kPreload;
    rig = std::make_unique<TyingRig>(centreline, rod, options);
  }

  void run(double until) {
    StepControl::Options options;
    options.motion = 0.4 * rod.material.radius;
    StepControl control(options);
    const std::string gave_up = control.advance(
        *stepper, time, until,
        [&](double from, double to) -> const Boundary& {
          boundary = Boundary{};
          rig->hold(boundary, from, to);
          return boundary;
        },
        [&](double to, double dt, const StepSummary&) {
          for (const FixedNode& clamp : boundary.fixed_nodes) {
            const Vec3 place = stepper->state().position.col(clamp.node);
            farthest_clamp = std::max(
                {farthest_clamp, (place - clamp.position).norm(), (place - centreline.points.col(clamp.node)).norm()});
          }
          rig->follow(*stepper, to, dt);
          for (const int k : {0, 1}) largest_tail_force = std::max(largest_tail_force, rig->tail_force(k));
        });
    ASSERT_EQ(gave_up, "");
  }
};

TEST(TyingRig, ClampsHoldAndGripsNeverPullHarderThanThePreload) {
  Loop loop(TyingRig::Options{});
  loop.rig->tie(0.02, 0.0, loop.stepper->state().position);
  EXPECT_EQ(loop.rig->stage(), TyingRig::Stage::kSettling);
  loop.run(1.5);
  const std::size_t far_side = static_cast<std::size_t>(loop.centreline.nearest_node(loop.centreline.loop.far_end) -
                                                        loop.centreline.nearest_node(loop.centreline.loop.far_begin)) +
                               1;
  EXPECT_EQ(loop.boundary.fixed_nodes.size(), far_side + 2u * (1u + 3u));
  EXPECT_LT(loop.farthest_clamp, 1e-12);
  EXPECT_GT(loop.largest_tail_force, 0.0);
  EXPECT_LE(loop.largest_tail_force, kPreload);
  EXPECT_GE(loop.rig->stage(), TyingRig::Stage::kPulling);
  EXPECT_EQ(loop.rig->not_equilibrated(), "");
}

TEST(TyingRig, GoesOnWhereNothingComesToRestInTimeAndSaysSo) {
  TyingRig::Options options;
  options.rest.patience = 0.01;
  options.rest.speed = 0.0;  // never
  Loop loop(options);
  loop.rig->tie(0.1, 0.0, loop.stepper->state().position);
  loop.rig->release(0.03, 0.0);
  loop.run(0.5);
  EXPECT_THAT(loop.rig->not_equilibrated(), testing::HasSubstr("after the clamps were released"));
  EXPECT_TRUE(loop.rig->released());
}

TEST(TyingRig, SetsKnotsToTheirMarksByWhatLiesBetweenAndBeyondThem) {
  const Loop loop(TyingRig::Options{});
  const RodState& state = loop.stepper->state();
  const double apart = -0.01, beyond = 0.03;
  const TyingRig::Laid laid = loop.rig->longer(apart, beyond, loop.rod, state);
  const Eigen::VectorXd change = laid.rest_length - loop.rod.rest_length;
  EXPECT_NEAR(change.sum(), 2.0 * apart + beyond, 1e-12);
  EXPECT_NEAR(change.cwiseMax(0.0).sum(), beyond, 1e-12);
  const int up = loop.rig->knot_middle(0, loop.rod, state).z() > loop.rig->knot_middle(1, loop.rod, state).z() ? 0 : 1;
  for (const int k : {0, 1}) {
    const Vec3 middle = loop.rig->knot_middle(k, loop.rod, state);
    for (Eigen::Index j = 0; j < change.size(); ++j) {
      const Vec3 away = state.position.col(j) - middle;
      const bool in_knot = std::abs(away.z()) < 3.0 * loop.rod.material.radius && state.position(0, j) > 0.0;
      EXPECT_TRUE(!in_knot || change[j] == 0.0) << j;
      const Vec3 moved = laid.position.col(j) - state.position.col(j);
      const Vec3 with_it(0.0, 0.0, k == up ? 0.5 * apart : -0.5 * apart);
      EXPECT_TRUE(!in_knot || (moved - with_it).norm() < 1e-12) << j;
    }
  }
}

/// However often they are asked to: no edge vanishes, and the knots come no nearer than their strands can become short.
TEST(TyingRig, ShortensStrandsByNoMoreThanTheyHave) {
  const Loop loop(TyingRig::Options{});
  const RodState& state = loop.stepper->state();
  RodProperties rod = loop.rod;
  const auto apart = [&](const Points& x) {
    RodState laid = state;
    laid.position = x;
    return std::abs((loop.rig->knot_middle(0, loop.rod, laid) - loop.rig->knot_middle(1, loop.rod, laid)).z());
  };
  const double before = apart(state.position);
  double nearer = 0.0;
  for (int i = 0; i < 20; ++i) {
    const TyingRig::Laid laid = loop.rig->longer(-0.02, 0.0, rod, state);
    nearer += before - apart(laid.position);
    rod.rest_length = laid.rest_length;
  }
  EXPECT_NEAR(rod.rest_length.cwiseQuotient(loop.rod.rest_length).minCoeff(), 0.2, 0.05);
  EXPECT_GT(nearer, 0.01);
  EXPECT_NEAR(loop.rod.length() - rod.length(), 2.0 * nearer, 1e-12);
}

struct LoopToTie {
  SpecimenOptions specimen;
  Material material = nylon();
  PhysicsOptions physics;

  LoopToTie() {
    specimen.to_be_tied = true;
    specimen.preload = 150.0;
  }
  std::vector<std::string> warnings() const { return tying_warnings(specimen, material, physics); }
  /// The key that is refused; empty: none is.
  std::string refused() const {
    try {
      check_tying(specimen, material);
    } catch (const InvalidInput& invalid) {
      return invalid.key;
    }
    return "";
  }
};

/// In units of k_b/h^2 [N].
double bending_force(const Material& material) {
  return material.bending_stiffness / (material.radius * material.radius);
}

TEST(BeforeTying, APreloadThatStretchesTheRodToMoreThanSixTimesItsLengthIsRefused) {
  for (const auto& [law, largest] : {std::pair(0, 5.0), std::pair(1, (6.0 - 1.0 / 36.0) / 3.0)}) {
    LoopToTie loop;
    loop.material = pink_vps();
    loop.material.stretching.law = static_cast<StretchingLaw>(law);
    loop.specimen.preload = 0.999 * largest * loop.material.stretching_stiffness;
    EXPECT_EQ(loop.refused(), "") << law;
    loop.specimen.preload = 1.001 * largest * loop.material.stretching_stiffness;
    EXPECT_EQ(loop.refused(), "specimen.preload") << law;
  }
}

TEST(BeforeTying, WithoutFrictionACoilClosesAtAnEighthOfTheBendingForce) {
  LoopToTie loop;
  loop.material.friction_coefficient = 0.0;
  EXPECT_DOUBLE_EQ(closing_preload(loop.material), bending_force(loop.material) / 8.0);
  EXPECT_DOUBLE_EQ(coil_radius(loop.material, closing_preload(loop.material)), 2.0 * loop.material.radius);
  EXPECT_NEAR(coil_radius(loop.material, 0.5 * bending_force(loop.material)), loop.material.radius, 1e-12);
}

TEST(BeforeTying, APreloadThatMovesNoCoilIsRefused) {
  LoopToTie loop;
  loop.specimen.preload = 0.02 * bending_force(loop.material);
  EXPECT_EQ(loop.refused(), "specimen.preload");
  // Friction alone may hold such strands until the pull closes them.
  loop.material.friction_coefficient = 1.5;
  loop.specimen.preload = 0.13 * bending_force(loop.material);
  EXPECT_EQ(loop.refused(), "");
}

TEST(BeforeTying, AStrainThatTheLooseCoilHasAlreadyIsRefusedAndThatOfATiedOneIsAWarning) {
  LoopToTie loop;
  loop.material.breaking.law = static_cast<BreakingLaw>(1);
  loop.material.breaking.set("bending_share", 1.0);
  const auto parts_at = [&](double strain) {
    loop.material.breaking_force = strain * loop.material.stretching_stiffness;
  };
  parts_at(0.2);
  EXPECT_EQ(loop.refused(), "material.breaking.bending_share");
  parts_at(0.3);
  EXPECT_EQ(loop.refused(), "");
  EXPECT_THAT(loop.warnings(), ElementsAre(HasSubstr("up to 1.67 times what parts them (material.breaking)")));
  parts_at(0.6);
  EXPECT_THAT(loop.warnings(), IsEmpty());
}

}  // namespace
}  // namespace knot_utm
