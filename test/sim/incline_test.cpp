#include <gtest/gtest.h>

#include "reference.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kGravity = OnAnIncline::kGravity;
constexpr double kMu = 0.46;
// What Newton's residual (1e-8 N a node) leaves open on the presliding spring of about 1500 N/m [m].
constexpr double kRestTolerance = 2e-10;

/// A straight rod lies on a plane that falls towards +x by `angle`.
struct Incline : OnAnIncline {
  std::unique_ptr<TimeStep> stepper;

  Incline(double angle, const Friction& friction)
      : OnAnIncline(angle, Vec3::UnitX(), 24, friction), stepper(TimeStep::make(rod, state, settings)) {}

  /// In steps of at most dt: from sticking to sliding and back Newton's method needs short ones.
  void run(double duration, double dt) {
    StepControl::Options options;
    options.longest = dt;
    options.motion = 10.0;
    double time = 0.0;
    run_to(duration, *stepper, time, options, [this](double) -> const Boundary& { return boundary; });
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

TEST(R9Incline, AboveTheFrictionAngleTheRodSlides) {
  const double angle = 1.05 * std::atan(kMu);
  Incline scene(angle, memory(1e-4 * braided_rope().radius));
  scene.run(0.5, 0.01);
  const double from = scene.speed();
  scene.run(1.0, 0.01);
  const double acceleration = kGravity * (std::sin(angle) - kMu * std::cos(angle));
  hold_against("R9 incline of 1.05 atan mu: acceleration [m/s^2]", acceleration, scene.speed() - from, 1e-5);
}

TEST(R11Creep, DirectionUnderALoadRatio) {
  for (const double ratio : {0.5, 0.9, 0.99}) {
    const double speed = std::log((1.0 + ratio) / (1.0 - ratio)) / 15.0;
    const double found =
        SmoothedFriction{kMu, 1.0}
            .traction(FrictionInput<Vec3>{1.0, Vec3(0.0, speed, 0.0), Vec3::Zero(), Vec3::UnitX(), 0.0, 1.0})
            .z[1];
    hold_against(formatted("R11 friction smoothed in velocity, v/v_s = %.3f: r", speed), ratio, found, 1e-14);
    // Eq. 12 as printed.
    EXPECT_NEAR(2.0 / (1.0 + std::exp(-15.0 * speed)) - 1.0, ratio, 1e-14);
  }
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
