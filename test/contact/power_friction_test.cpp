#include "knot_utm/contact/power_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference.hpp"
#include "sim/capstan.hpp"

namespace knot_utm {
namespace {

constexpr double kMu = 0.4, kPresliding = 1e-6, kReference = 50.0;

FrictionInput<Vec3> sliding(double pressure) {
  return {pressure, 10.0 * kPresliding * Vec3::UnitX(), Vec3::Zero(), Vec3::UnitX(), 0.0, 0.1};
}

double traction(const PowerFriction& law, double pressure) {
  const FrictionTraction<Vec3> t = law.traction(sliding(pressure));
  return pressure * t.coefficient * t.z.norm();
}

TEST(PowerFriction, GrowsWithAPowerOfThePressure) {
  for (const double n : {0.6, 0.8, 1.0}) {
    const PowerFriction law{kMu, kPresliding, n, kReference};
    for (const double pressure : {kReference, 10.0 * kReference, 1e3 * kReference}) {
      // p_0 is a thousandth of p_r: it changes t by less than (1 - n)/1000 of it.
      const double expected = kMu * kReference * std::pow(pressure / kReference, n);
      EXPECT_NEAR(traction(law, pressure), expected, (1.0 - n + 1e-9) * 1e-3 * expected) << n << " " << pressure;
    }
  }
}

/// As Newton's method has it where strands were drawn apart (ContactModel): a straight line from zero on.
TEST(PowerFriction, GoesOnInAStraightLineBelowZero) {
  const PowerFriction law{kMu, kPresliding, 0.8, kReference};
  const FrictionTangent<Vec3> at_zero = law.tangent(sliding(0.0), Linearisation::kTangent);
  for (const double pressure : {-1e-9, -0.04, -1.0, -1e4})
    for (const Linearisation how : {Linearisation::kTangent, Linearisation::kSecant}) {
      const FrictionTangent<Vec3> below = law.tangent(sliding(pressure), how);
      EXPECT_EQ(below.coefficient, at_zero.coefficient);
      EXPECT_EQ(below.by_pressure, at_zero.by_pressure);
      EXPECT_EQ(law.traction(sliding(pressure)).coefficient, at_zero.coefficient);
    }
  constexpr double kStep = 1e-7;
  const double slope = (traction(law, kStep) - traction(law, -kStep)) / (2.0 * kStep);
  EXPECT_NEAR(slope, at_zero.by_pressure.norm(), 1e-5 * slope);
}

/// With dT/dphi = mu p_r rho (T/(p_r rho))^n around a shaft of radius rho,
///     T2^(1-n) = T1^(1-n) + (1 - n) mu (p_r rho)^(1-n) phi.
TEST(PowerFriction, HowellsCapstan) {
  constexpr double kTension = 1000.0, kExponent = 0.8;  // of a rod that the tension bends as if it were a thread
  Capstan::Options options;
  options.roller_friction = PowerFriction{Capstan::kMu, options.presliding, kExponent, kTension};
  Capstan scene(kTension, options);
  const double expected = std::pow(1.0 + (1.0 - kExponent) * Capstan::kMu * 2.0 * M_PI, 1.0 / (1.0 - kExponent));
  EXPECT_LT(expected, 0.8 * std::exp(Capstan::kMu * 2.0 * M_PI)) << "Coulomb's law must be told from it";
  hold_against("Howell's capstan, n = 0.8: T2/T1", expected, scene.ratio(), 0.01);
}

}  // namespace
}  // namespace knot_utm
