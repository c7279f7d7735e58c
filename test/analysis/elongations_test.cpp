#include <gtest/gtest.h>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

constexpr double kGauge = 0.5;     // [m]
constexpr double kReach = 0.01;    // [m]
constexpr double kSpring = 200.0;  // [N/m]

/// A specimen that is cycled between loads, and how much of its extension stays behind.
class Cycled {
 public:
  Cycled() { add(Phase::kBalance, 0.0); }

  void add(Phase phase, double extension) {
    Sample sample;
    sample.time = static_cast<double>(samples.size());
    sample.phase = phase;
    sample.extension = sample.displacement = extension;
    sample.end_to_end = kGauge + extension;
    sample.force_upper = sample.force_lower = sample.load = kSpring * (extension - left);
    samples.push_back(sample);
  }
  void move(Phase phase, double from, double to) {
    constexpr int kSteps = 50;
    for (int i = 1; i <= kSteps; ++i) add(phase, from + (to - from) * i / kSteps);
  }
  Results results() const { return analyse(samples, samples, EndedBy::kProgram, false); }

  double left = 0.0;  ///< [m]
  std::vector<Sample> samples;
};

/// What yields keeps a part of its extension, and is stretched the less by the same load afterwards.
TEST(Elongations, OfASpecimenThatBedsInAPartStaysAndIsNotElastic) {
  constexpr double kLeft = 0.004;
  Cycled rope;
  for (int i = 0; i < 3; ++i) {
    rope.move(Phase::kCycle, rope.left, kReach + kLeft * (i == 2));
    rope.left = kLeft * (i == 2);
    rope.move(Phase::kCycle, kReach + rope.left, rope.left);
  }
  const Results results = rope.results();
  ASSERT_TRUE(results.elongations);
  EXPECT_NEAR(results.elongations->total, (kReach + kLeft) / kGauge, 1e-15);
  EXPECT_NEAR(results.elongations->residual, kLeft / kGauge, 1e-15);
  EXPECT_NEAR(results.elongations->elastic, kReach / kGauge, 1e-15);
  EXPECT_NEAR(results.elongations->working, kReach / (kGauge + kLeft), 1e-15);
  EXPECT_NEAR(results.elongations->elastic + results.elongations->residual, results.elongations->total, 1e-15);
}

/// A reference tension stretches a specimen before anything is measured, and is not balanced.
TEST(Elongations, AreOverTheLengthThatIsFirstPulled) {
  constexpr double kBefore = 0.002;
  Cycled spring;
  spring.move(Phase::kPreload, 0.0, kBefore);
  spring.move(Phase::kCycle, kBefore, kReach);
  spring.move(Phase::kCycle, kReach, kBefore);
  spring.move(Phase::kPull, kBefore, 2.0 * kReach);
  spring.samples.back().status = BenchStatus::kBroken;
  const Results results = spring.results();
  ASSERT_TRUE(results.elongations && results.gauge_length && results.elongation_at_break);
  const double gauge = kGauge + kBefore;
  EXPECT_NEAR(*results.gauge_length, gauge, 1e-15);
  EXPECT_NEAR(results.elongations->total, (kReach - kBefore) / gauge, 1e-15);
  EXPECT_NEAR(results.elongations->residual, 0.0, 1e-15);
  EXPECT_NEAR(*results.elongation_at_break, (2.0 * kReach - kBefore) / gauge, 1e-15);
}

TEST(Elongations, AreNoneWhereNoCycleWasClosed) {
  Cycled spring;
  spring.move(Phase::kPull, 0.0, kReach);
  const Results results = spring.results();
  EXPECT_FALSE(results.elongations);
  EXPECT_FALSE(results.elongation_at_break);
  EXPECT_TRUE(results.gauge_length);
  EXPECT_FALSE(Cycled().results().gauge_length);
}

}  // namespace
}  // namespace knot_utm
