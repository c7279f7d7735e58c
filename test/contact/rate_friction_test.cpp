#include "knot_utm/contact/rate_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/contact/memory_friction.hpp"
#include "reference.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kMu = 0.46, kPresliding = 1e-6, kRate = 0.05, kSpeed = 1e-4, kStep = 0.1;

FrictionInput<Vec3> input(double slip, double remembered = 0.0, double dt = kStep) {
  return {100.0, slip * Vec3::UnitX(), remembered * Vec3::UnitX(), Vec3::UnitX(), 0.0, dt};
}

/// A contact that is dragged on at a speed comes to bear mu_0 (1 + a ln(1 + v/v_0)), whatever the length of the steps.
TEST(RateFriction, GrowsWithTheLogarithmOfTheSpeed) {
  const RateFriction law{kMu, kPresliding, kRate, kSpeed};
  for (const double dt : {1e-3, 0.1, 10.0})
    for (const double speed : {0.1 * kSpeed, kSpeed, 30.0 * kSpeed, 1e5 * kSpeed}) {
      FrictionMemory memory;
      double coefficient = 0.0;
      for (int step = 0; step < 4000; ++step) {
        const FrictionInput<Vec3> in = input(memory.slip.x() + speed * dt, memory.slip.x(), dt);
        const FrictionTraction<Vec3> t = law.traction(in);
        coefficient = t.coefficient * t.z.norm();
        memory = law.remember(in, t.z);
      }
      const double expected = kMu * (1.0 + kRate * std::log1p(speed / kSpeed));
      EXPECT_NEAR(coefficient, expected, 1e-12 * expected) << dt << " " << speed;
    }
}

/// A contact that stops after sliding gives up what it bears beyond mu_0: de/dt = -(v_0/xi_s) (exp((e - 1)/a) - 1).
/// With x = exp(-(e - 1)/a), that is dx/dt = (v_0/(a xi_s)) (1 - x).
TEST(RateFriction, RelaxesOnceItStops) {
  const RateFriction law{kMu, kPresliding, kRate, kSpeed};
  const double beyond = 0.2, duration = 2.0 * kRate * kPresliding / kSpeed, dt = duration / 20000;
  FrictionMemory memory;
  memory.slip = (1.0 + beyond) * kPresliding * Vec3::UnitX();
  for (int step = 0; step < 20000; ++step) {
    const FrictionInput<Vec3> in = input(memory.slip.x(), memory.slip.x(), dt);
    memory = law.remember(in, law.traction(in).z);
  }
  const double left = 1.0 - (1.0 - std::exp(-beyond / kRate)) * std::exp(-duration * kSpeed / (kRate * kPresliding));
  EXPECT_NEAR(memory.slip.norm() / kPresliding, 1.0 - kRate * std::log(left), 1e-4 * beyond);
}

/// A rod on an incline that bears less than mu_0 stays. Steeper, it creeps at v_0 (exp((tan alpha/mu_0 - 1)/a) - 1).
TEST(RateFriction, CreepsOnAnIncline) {
  const double presliding = 1e-4 * braided_rope().radius;
  for (const double load : {0.95, 1.05, 1.2}) {
    OnAnIncline scene(std::atan(load * kMu), Vec3::UnitX(), 24, RateFriction{kMu, presliding, kRate, kSpeed});
    const std::unique_ptr<TimeStep> stepper = TimeStep::make(scene.rod, scene.state, scene.settings);
    const auto place = [&] { return stepper->state().position.row(0).mean(); };
    StepControl::Options options;
    options.longest = 0.05;
    options.motion = 10.0;
    double time = 0.0;
    const auto boundary = [&](double) -> const Boundary& { return scene.boundary; };
    run_to(5.0, *stepper, time, options, boundary);
    const double from = place();
    run_to(15.0, *stepper, time, options, boundary);
    const double expected = load > 1.0 ? kSpeed * std::expm1((load - 1.0) / kRate) : 0.0,
                 speed = (place() - from) / 10.0;
    if (load > 1.0)
      hold_against(formatted("creep by friction of rate, tan alpha/mu_0 = %.2f: speed/v_0", load), expected / kSpeed,
                   speed / kSpeed, 1e-4);
    else
      EXPECT_LT(std::abs(speed), 1e-11);
  }
}

}  // namespace
}  // namespace knot_utm
