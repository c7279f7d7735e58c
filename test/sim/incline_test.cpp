#include <gtest/gtest.h>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "reference.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kGravity = 9.81;
constexpr double kMu = 0.46;
// What Newton's residual (1e-8 N a node) leaves open on the presliding spring of about 1500 N/m [m].
constexpr double kRestTolerance = 2e-10;

/// A straight rod lies on a plane that falls towards +x by `angle`.
struct Incline {
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;

  Incline(double angle, const Friction& friction) {
    const Material material = braided_rope();
    const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(24, material.radius));
    StepSettings settings = closed_form_settings(material);
    settings.gravity = kGravity * Vec3(std::sin(angle), 0.0, -std::cos(angle));
    settings.roller_friction = friction;
    settings.motion_limit = 10.0;
    settings.newton_cap = 10.0;
    // Pressed in by its own weight already, so that nothing falls.
    RodState state = straight_state(rod);
    const double weight = rod.mass.sum() / rod.length() * kGravity * std::cos(angle);
    state.position.row(2).setConstant(-settings.pressure_law.overlap_at(weight));
    stepper = TimeStep::make(rod, state, settings);
    boundary.rollers = {plane_below(material.radius)};
  }

  /// In steps of at most dt: from sticking to sliding and back Newton's method needs short ones.
  void run(double duration, double dt) {
    StepControl::Options options;
    options.longest = dt;
    options.motion = 10.0;
    StepControl control(options);
    double time = 0.0;
    const std::string gave_up = control.advance(
        *stepper, time, duration, [this](double, double) -> const Boundary& { return boundary; },
        [](double, double, const StepSummary&) {});
    ASSERT_EQ(gave_up, "");
  }
  double place() const { return stepper->state().position.row(0).mean(); }
  double speed() const { return stepper->state().velocity.row(0).mean(); }
};

Friction memory(double presliding) { return MemoryFriction{kMu, presliding}; }

TEST(R9Incline, BelowTheFrictionAngleTheRodStays) {
  // Presliding is part of what moves: 1e-4 h of it keeps the whole movement below the reference's 1e-6 m.
  Incline scene(0.95 * std::atan(kMu), memory(1e-4 * braided_rope().radius));
  scene.run(60.0, 0.05);
  EXPECT_GT(scene.place(), 0.0);
  hold_below("R9 incline of 0.95 atan mu: way in 60 s [m]", 1e-6, scene.place());
}

TEST(R9Incline, PreslidingSaturatesOnceAndDoesNotCreep) {
  Incline scene(0.95 * std::atan(kMu), memory(2e-3 * braided_rope().radius));
  scene.run(1.0, 0.05);
  const double settled = scene.place();
  EXPECT_LT(settled, 2e-3 * braided_rope().radius);
  scene.run(60.0, 0.05);
  EXPECT_NEAR(scene.place(), settled, kRestTolerance);
}

TEST(R9Incline, AboveTheFrictionAngleTheRodSlides) {
  const double angle = 1.05 * std::atan(kMu);
  Incline scene(angle, memory(1e-4 * braided_rope().radius));
  scene.run(0.5, 0.01);
  const double from = scene.speed();
  scene.run(1.0, 0.01);
  const double acceleration = kGravity * (std::sin(angle) - kMu * std::cos(angle));
  hold_against("R9 incline of 1.05 atan mu: acceleration [m/s^2]", acceleration, scene.speed() - from, 1e-5);
}

/// The coefficient with which a rod slides whose weight presses with the `part`-th of the reference pressure.
double power_coefficient(double exponent, double part, double expected) {
  const Material material = braided_rope();
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(24, material.radius));
  const double angle = std::atan(1.2 * expected);
  const double pressure = rod.mass.sum() / rod.length() * kGravity * std::cos(angle);
  Incline scene(angle, PowerFriction{kMu, 1e-4 * material.radius, exponent, pressure / part});
  scene.run(0.2, 0.01);
  const double from = scene.speed();
  scene.run(0.2, 0.01);
  return std::tan(angle) - (scene.speed() - from) / (0.2 * kGravity * std::cos(angle));
}

/// The ends of the rod bear nothing, so that it presses by 5 % more than its mean weight. The bound at small loads
/// takes 3 % of the pressure at a thirtieth of the reference pressure. Where strands hardly touch, the coefficient is
/// that at a thousandth of it.
TEST(PowerFrictionIncline, FollowsTheLawAndIsBoundedAtSmallLoads) {
  for (const double n : {0.5, 0.67, 0.8}) {
    EXPECT_NEAR(power_coefficient(n, 1.0, kMu), kMu, (1.0 - n) * 0.06 * kMu) << n;
    const double small = kMu * std::pow(30.0, 1.0 - n);
    EXPECT_NEAR(power_coefficient(n, 1.0 / 30.0, small), small, (1.0 - n) * 0.1 * small) << n;
    const double largest = kMu * std::pow(1000.0, 1.0 - n);
    EXPECT_NEAR(power_coefficient(n, 1e-6, largest), largest, 2e-3 * largest) << n;
  }
}

TEST(R11Creep, DirectionUnderALoadRatio) {
  for (const double ratio : {0.5, 0.9, 0.99}) {
    const double speed = std::log((1.0 + ratio) / (1.0 - ratio)) / 15.0;
    const double found =
        SmoothedFriction{kMu, 1.0}
            .traction(FrictionInput<Vec3>{1.0, Vec3(0.0, speed, 0.0), Vec3::Zero(), Vec3::UnitX(), 0.0, 1.0})
            .z[1];
    EXPECT_NEAR(found, ratio, 1e-14);
    hold_against(formatted("R11 friction smoothed in velocity, v/v_s = %.3f: r", speed), ratio, found, 1e-14);
    // Eq. 12 as printed.
    EXPECT_NEAR(2.0 / (1.0 + std::exp(-15.0 * speed)) - 1.0, ratio, 1e-14);
  }
  EXPECT_NEAR(std::log(1.5 / 0.5) / 15.0, 0.073, 5e-4);
  EXPECT_NEAR(std::log(1.9 / 0.1) / 15.0, 0.196, 5e-4);
  EXPECT_NEAR(std::log(1.99 / 0.01) / 15.0, 0.353, 5e-4);
}

TEST(R11Creep, SmoothedFrictionCreepsOnAnInclineOfAnySlope) {
  const double tolerance = 1e-3;
  for (const double ratio : {0.5, 0.9}) {
    Incline scene(std::atan(ratio * kMu), SmoothedFriction{kMu, tolerance});
    scene.run(1.0, 0.05);
    const double from = scene.place();
    scene.run(10.0, 0.05);
    const double expected = tolerance * std::log((1.0 + ratio) / (1.0 - ratio)) / 15.0;
    hold_against(formatted("R11 creep on an incline, r = %.1f: v/v_s", ratio), expected / tolerance,
                 (scene.place() - from) / 10.0 / tolerance, 1e-4);
  }
}

TEST(R11Creep, MemoryFrictionDoesNot) {
  Incline scene(std::atan(0.5 * kMu), memory(2e-3 * braided_rope().radius));
  scene.run(1.0, 0.05);
  const double from = scene.place();
  scene.run(10.0, 0.05);
  hold_below("R11 friction with memory at r = 0.5: way in 10 s [m]", kRestTolerance, std::abs(scene.place() - from));
}

}  // namespace
}  // namespace knot_utm
