#include <gtest/gtest.h>

#include "knot_utm/analysis/sample_readings.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

constexpr double kForce = 5.0, kDrag = 0.1, kHolder = 0.01, kNumerical = 0.2, kSpeed = 2e-3;  // [N], [m/s]

/// A steady pull for ten seconds, after a mount that drags more. What moves gains and loses an energy by turns.
std::vector<Sample> pulled(double gained) {
  std::vector<Sample> out;
  for (int k = 0; k <= 120; ++k) {
    Sample sample;
    sample.time = 0.1 * k;
    const double since = sample.time - 2.0;
    sample.phase = since > 1e-9 ? Phase::kPull : Phase::kMount;
    sample.extension = kSpeed * since;
    sample.force_upper = kForce;
    sample.force_lower = kForce - kDrag - kHolder * k;
    sample.kinetic_energy = k % 2 == 0 ? 0.0 : gained;
    sample.numerical_dissipation = -kNumerical * kSpeed * sample.time;
    sample.grip_work = kForce * kSpeed * sample.time;
    const double drag = since > 0.0 ? kDrag : 40.0 * kDrag;
    sample.friction_loss = 3.0 * sample.time;
    sample.plastic_loss = 2.0 * sample.time;  // is no drag
    sample.dissipation = sample.friction_loss + sample.plastic_loss + drag * kSpeed * since;
    out.push_back(sample);
  }
  return out;
}

TEST(RateShares, ADragThatIsSteadyIsItsShareOfTheForce) {
  const RateShares shares = rate_shares(pulled(0.0), {}, {});
  EXPECT_NEAR(*shares.drag, kDrag / kForce, 1e-9);
  EXPECT_NEAR(*shares.inertia, 0.0, 1e-9);  // what holds the loop elsewhere is none
  EXPECT_NEAR(*shares.numerical, kNumerical / kForce, 1e-9);
}

TEST(RateShares, MassThatGainsAndLosesSpeedIsInertia) {
  constexpr double kWay = 0.1 * kSpeed;
  EXPECT_NEAR(*rate_shares(pulled(1e-4), {}, {}).inertia, 1e-4 / kWay / kForce, 1e-9);
}

TEST(RateShares, EndWhereTheKnotsLockAndWhereTheyComeUndoneOrTheRodParts) {
  std::vector<Sample> samples = pulled(0.0);
  for (std::size_t k = 40; k < samples.size(); ++k) {
    samples[k].kinetic_energy = 1e3 * static_cast<double>(k);
    samples[k].dissipation += 1e3 * static_cast<double>(k);
  }
  EXPECT_GT(*rate_shares(samples, {}, {}).drag, 1.0);
  const double lock = 0.5 * (samples[38].extension + samples[39].extension);
  EXPECT_NEAR(*rate_shares(samples, lock, {}).drag, kDrag / kForce, 1e-9);
  EXPECT_NEAR(*rate_shares(samples, {}, samples[40].time).drag, kDrag / kForce, 1e-9);
  EXPECT_NEAR(*rate_shares(samples, {}, samples[40].time).inertia, 0.0, 1e-9);
  samples[40].status = BenchStatus::kBroken;
  EXPECT_NEAR(*rate_shares(samples, {}, {}).drag, kDrag / kForce, 1e-9);
}

}  // namespace
}  // namespace knot_utm
