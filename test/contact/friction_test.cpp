#include "knot_utm/contact/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/memory_friction.hpp"
#include "knot_utm/contact/power_friction.hpp"
#include "knot_utm/contact/rate_friction.hpp"
#include "reference.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kMu = 0.4, kPresliding = 1e-5, kStep = 0.1;

/// Of every law, with its keys in the middle of their ranges.
std::vector<Friction> laws() {
  std::vector<Friction> out;
  for (std::size_t number = 0; number < FrictionRegistry::kCount; ++number) {
    FrictionOptions options;
    options.law = static_cast<FrictionLaw>(number);
    for (const LawKey& key : FrictionRegistry::keys())
      if (FrictionRegistry::entry(options.law).has(key.name))
        options.set(key.name, key.min > 0.0 ? std::sqrt(key.min * key.max) : 0.5 * (key.min + key.max));
    out.push_back(Friction::of(options, {kMu, 100.0 * kPresliding, 0.01}));
  }
  return out;
}

/// Slips from far below what a law resolves to far beyond where it saturates, none at a kink.
std::vector<Vec3> slips() {
  std::vector<Vec3> out;
  for (const double size : {1e-8, 3e-7, 5e-6, 1.5e-5, 3e-4, 2e-3})
    for (const Vec3& direction : {Vec3(1.0, 0.0, 0.0), Vec3(0.6, -0.8, 0.0)}) out.push_back(size * direction);
  return out;
}

FrictionInput<Vec3> input(const Vec3& slip, double pressure = 100.0, double own = 0.3 * kPresliding) {
  return {pressure, slip, 0.5 * slip, Vec3::UnitX(), own, kStep};
}

/// -t
template <typename Law>
Vec3 traction(const Law& law, const FrictionInput<Vec3>& in) {
  const FrictionTraction<Vec3> t = law.traction(in);
  return in.pressure * t.coefficient * t.z;
}

/// Calls test(law) for every law, by its own type.
template <typename Test>
void for_each_law(Test test) {
  for (const Friction& friction : laws()) {
    SCOPED_TRACE(friction.name());
    friction.visit([&](const auto& law) {
      test(law);
      return 0;
    });
  }
}

TEST(FrictionLaws, TheTangentIsTheDerivativeOfTheTraction) {
  for_each_law([](const auto& law) {
    for (const Vec3& slip : slips()) {
      const FrictionTangent<Vec3> tangent = law.tangent(input(slip), Linearisation::kTangent);
      const double step = 1e-4 * slip.norm();
      for (const Vec3& way : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0)}) {
        const Vec3 numeric =
            (traction(law, input(slip + step * way)) - traction(law, input(slip - step * way))) / (2.0 * step);
        const Vec3 analytic = 100.0 * tangent.stiffness * tangent.slope_times(way);
        // Of central differences over 1e-4 of the slip: their curvature 1e-8, rounding 1e-12, of the stiffest way.
        const double stiffest = 100.0 * kMu * law.tangent(input(slip), Linearisation::kSecant).stiffness / kMu *
                                law.tangent(input(slip), Linearisation::kSecant).across;
        EXPECT_LT((analytic - numeric).norm(), 1e-6 * stiffest) << "slip " << slip.norm();
      }
      const Vec3 by_pressure = traction(law, input(slip, 101.0)) - traction(law, input(slip, 99.0));
      EXPECT_LT((2.0 * tangent.by_pressure - by_pressure).norm(), 1e-4 * by_pressure.norm());
    }
  });
}

TEST(FrictionLaws, TangentAndSecantMeetTheTraction) {
  for_each_law([](const auto& law) {
    for (const Vec3& slip : slips()) {
      const FrictionTraction<Vec3> t = law.traction(input(slip));
      for (const Linearisation how : {Linearisation::kTangent, Linearisation::kSecant}) {
        const FrictionTangent<Vec3> l = law.tangent(input(slip), how);
        EXPECT_LT((l.coefficient * l.z - t.coefficient * t.z).norm(), 1e-14);
      }
      const FrictionTangent<Vec3> secant = law.tangent(input(slip), Linearisation::kSecant);
      const FrictionTangent<Vec3> tangent = law.tangent(input(slip), Linearisation::kTangent);
      EXPECT_LT((secant.stiffness * secant.slope_times(slip) - t.coefficient * t.z).norm(), 1e-12);
      const double rounding = 1e-12 * secant.across;
      EXPECT_LE(tangent.across, secant.across + rounding);
      EXPECT_LE(tangent.across + tangent.along, secant.across + rounding) << "a secant bounds the law from above";
    }
  });
}

TEST(FrictionLaws, TheTractionOpposesTheSlipWithinItsCone) {
  for_each_law([](const auto& law) {
    for (const Vec3& slip : slips()) {
      const FrictionTraction<Vec3> t = law.traction(input(slip, 1e9));
      EXPECT_LE(t.z.norm(), 1.0 + 1e-15);
      EXPECT_GT(t.z.dot(slip), 0.0);
      EXPECT_GT(t.coefficient, 0.0);
    }
  });
}

TEST(FrictionLaws, FourContactsAreFourTimesOne) {
  const std::vector<Vec3> all = slips();
  for_each_law([&](const auto& law) {
    for (std::size_t i = 0; i + 4 <= all.size(); i += 4) {
      const auto four = [&](auto vector) {
        return FourVectors::of(to_lanes(vector(all[i])), to_lanes(vector(all[i + 1])), to_lanes(vector(all[i + 2])),
                               to_lanes(vector(all[i + 3])));
      };
      const FrictionInput<FourVectors> in{constant<Lanes>(100.0),
                                          four([](const Vec3& slip) { return slip; }),
                                          four([](const Vec3& slip) { return Vec3(0.5 * slip); }),
                                          four([](const Vec3&) { return Vec3(Vec3::UnitX()); }),
                                          constant<Lanes>(0.3 * kPresliding),
                                          kStep};
      const FrictionTraction<FourVectors> t = law.traction(in);
      const FrictionTangent<FourVectors> l = law.tangent(in, Linearisation::kTangent);
      for (std::size_t k = 0; k < 4; ++k) {
        const int lane = static_cast<int>(k);
        const FrictionTraction<Vec3> alone = law.traction(input(all[i + k]));
        const FrictionTangent<Vec3> own = law.tangent(input(all[i + k]), Linearisation::kTangent);
        EXPECT_NEAR(t.coefficient[lane], alone.coefficient, 1e-15);
        EXPECT_LT((Vec3(t.z.x[lane], t.z.y[lane], t.z.z[lane]) - alone.z).norm(), 1e-14);
        EXPECT_NEAR(l.across[lane], own.across, 1e-12 * std::abs(own.across));
        EXPECT_NEAR(l.along[lane], own.along, 1e-12 * std::abs(own.across));
      }
    }
  });
}

TEST(MemoryFriction, RemembersWhatItsSpringHolds) {
  const MemoryFriction friction{kMu, kPresliding};
  const Vec3 half = 0.5 * kPresliding * Vec3::UnitY(), far = 3.0 * kPresliding * Vec3::UnitY();
  const double rounding = 1e-15 * kPresliding;
  EXPECT_LT((friction.remember(input(half), friction.traction(input(half)).z).slip - half).norm(), rounding);
  EXPECT_LT((friction.remember(input(far), friction.traction(input(far)).z).slip - far / 3.0).norm(), rounding);
}

constexpr double kShortPresliding = 1e-6, kReference = 50.0;

FrictionInput<Vec3> sliding(double pressure) {
  return {pressure, 10.0 * kShortPresliding * Vec3::UnitX(), Vec3::Zero(), Vec3::UnitX(), 0.0, 0.1};
}

double traction(const PowerFriction& law, double pressure) {
  const FrictionTraction<Vec3> t = law.traction(sliding(pressure));
  return pressure * t.coefficient * t.z.norm();
}

TEST(PowerFriction, GrowsWithAPowerOfThePressure) {
  for (const double n : {0.6, 0.8, 1.0}) {
    const PowerFriction law{kMu, kShortPresliding, n, kReference};
    for (const double pressure : {kReference, 10.0 * kReference, 1e3 * kReference}) {
      // p_0 is a thousandth of p_r: it changes t by less than (1 - n)/1000 of it.
      const double expected = kMu * kReference * std::pow(pressure / kReference, n);
      EXPECT_NEAR(traction(law, pressure), expected, (1.0 - n + 1e-9) * 1e-3 * expected) << n << " " << pressure;
    }
  }
}

/// As Newton's method has it where strands were drawn apart (ContactModel): a straight line from zero on.
TEST(PowerFriction, GoesOnInAStraightLineBelowZero) {
  const PowerFriction law{kMu, kShortPresliding, 0.8, kReference};
  const FrictionTangent<Vec3> at_zero = law.tangent(sliding(0.0), Linearisation::kTangent);
  for (const double pressure : {-1e-9, -0.04, -1.0, -1e4})
    for (const Linearisation how : {Linearisation::kTangent, Linearisation::kSecant}) {
      const FrictionTangent<Vec3> below = law.tangent(sliding(pressure), how);
      EXPECT_EQ(below.coefficient, at_zero.coefficient);
      EXPECT_EQ(below.by_pressure, at_zero.by_pressure);
      EXPECT_EQ(law.traction(sliding(pressure)).coefficient, at_zero.coefficient);
    }
  constexpr double kChange = 1e-7;
  const double slope = (traction(law, kChange) - traction(law, -kChange)) / (2.0 * kChange);
  EXPECT_NEAR(slope, at_zero.by_pressure.norm(), 1e-5 * slope);
}

constexpr double kRopeMu = 0.46, kRate = 0.05, kSpeed = 1e-4;

FrictionInput<Vec3> dragged(double slip, double remembered = 0.0, double dt = kStep) {
  return {100.0, slip * Vec3::UnitX(), remembered * Vec3::UnitX(), Vec3::UnitX(), 0.0, dt};
}

/// A contact that is dragged on at a speed comes to bear mu_0 (1 + a ln(1 + v/v_0)), whatever the length of the steps.
TEST(RateFriction, GrowsWithTheLogarithmOfTheSpeed) {
  const RateFriction law{kRopeMu, kShortPresliding, kRate, kSpeed};
  for (const double dt : {1e-3, 0.1, 10.0})
    for (const double speed : {0.1 * kSpeed, kSpeed, 30.0 * kSpeed, 1e5 * kSpeed}) {
      FrictionMemory memory;
      double coefficient = 0.0;
      for (int step = 0; step < 4000; ++step) {
        const FrictionInput<Vec3> in = dragged(memory.slip.x() + speed * dt, memory.slip.x(), dt);
        const FrictionTraction<Vec3> t = law.traction(in);
        coefficient = t.coefficient * t.z.norm();
        memory = law.remember(in, t.z);
      }
      const double expected = kRopeMu * (1.0 + kRate * std::log1p(speed / kSpeed));
      EXPECT_NEAR(coefficient, expected, 1e-12 * expected) << dt << " " << speed;
    }
}

/// A contact that stops after sliding gives up what it bears beyond mu_0: de/dt = -(v_0/xi_s) (exp((e - 1)/a) - 1).
/// With x = exp(-(e - 1)/a), that is dx/dt = (v_0/(a xi_s)) (1 - x).
TEST(RateFriction, RelaxesOnceItStops) {
  const RateFriction law{kRopeMu, kShortPresliding, kRate, kSpeed};
  const double beyond = 0.2, duration = 2.0 * kRate * kShortPresliding / kSpeed, dt = duration / 20000;
  FrictionMemory memory;
  memory.slip = (1.0 + beyond) * kShortPresliding * Vec3::UnitX();
  for (int step = 0; step < 20000; ++step) {
    const FrictionInput<Vec3> in = dragged(memory.slip.x(), memory.slip.x(), dt);
    memory = law.remember(in, law.traction(in).z);
  }
  const double left =
      1.0 - (1.0 - std::exp(-beyond / kRate)) * std::exp(-duration * kSpeed / (kRate * kShortPresliding));
  EXPECT_NEAR(memory.slip.norm() / kShortPresliding, 1.0 - kRate * std::log(left), 1e-4 * beyond);
}

/// A rod on an incline that bears less than mu_0 stays. Steeper, it creeps at v_0 (exp((tan alpha/mu_0 - 1)/a) - 1).
TEST(RateFriction, CreepsOnAnIncline) {
  const double presliding = 1e-4 * braided_rope().radius;
  for (const double load : {0.95, 1.05, 1.2}) {
    OnAnIncline scene(std::atan(load * kRopeMu), Vec3::UnitX(), 24, RateFriction{kRopeMu, presliding, kRate, kSpeed});
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
