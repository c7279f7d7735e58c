#include "knot_utm/analysis/rate_shares.hpp"

#include <gtest/gtest.h>

namespace knot_utm {
namespace {

constexpr double kForce = 5.0, kDrag = 0.1, kWeight = 0.3, kSpeed = 2e-3;  // [N], [m/s]

/// A steady pull for ten seconds, after a mount that drags more; the lower force swings.
std::vector<Sample> pulled(double swing) {
  std::vector<Sample> out;
  for (int k = 0; k <= 120; ++k) {
    Sample sample;
    sample.time = 0.1 * k;
    const double since = sample.time - 2.0;
    sample.phase = since > 1e-9 ? Phase::kPull : Phase::kMount;
    sample.extension = kSpeed * since;
    sample.force_upper = kForce;
    sample.force_lower = kForce - kDrag - kWeight + (k % 2 == 0 ? swing : -swing);
    sample.grip_work = kForce * kSpeed * sample.time;
    const double drag = since > 0.0 ? kDrag : 40.0 * kDrag;
    sample.friction_loss = 3.0 * sample.time;
    sample.dissipation = sample.friction_loss + drag * kSpeed * since;
    out.push_back(sample);
  }
  return out;
}

TEST(RateShares, ADragThatIsSteadyIsItsShareOfTheForce) {
  const RateShares shares = rate_shares(pulled(0.0), {});
  EXPECT_NEAR(*shares.drag, kDrag / kForce, 1e-9);
  EXPECT_NEAR(*shares.inertia, 0.0, 1e-9);  // neither weight nor drag
}

TEST(RateShares, AForceThatSwingsIsInertia) { EXPECT_NEAR(*rate_shares(pulled(0.2), {}).inertia, 0.2 / kForce, 1e-9); }

TEST(RateShares, EndWhereTheKnotsLockAndWhereTheRodParts) {
  std::vector<Sample> samples = pulled(0.0);
  for (std::size_t k = 80; k < samples.size(); ++k) {
    samples[k].force_lower = 0.0;
    samples[k].dissipation += 1e3;
  }
  const double lock = 0.5 * (samples[78].extension + samples[79].extension);
  EXPECT_NEAR(*rate_shares(samples, lock).drag, kDrag / kForce, 1e-9);
  EXPECT_GT(*rate_shares(samples, {}).drag, 1.0);
  samples[80].status = BenchStatus::kBroken;
  EXPECT_NEAR(*rate_shares(samples, {}).drag, kDrag / kForce, 1e-9);
}

TEST(RateShares, NothingWasPulled) {
  EXPECT_FALSE(rate_shares({}, {}).drag);
  std::vector<Sample> samples = pulled(0.0);
  samples.resize(10);
  EXPECT_FALSE(rate_shares(samples, {}).drag);
  EXPECT_FALSE(rate_shares(samples, {}).inertia);
}

}  // namespace
}  // namespace knot_utm
