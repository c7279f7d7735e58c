#include "knot_utm/analysis/curve_readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

/// Of a loop on rollers.
CurveReadings curve_readings(const Pull& pull, const HiddenRod& hidden = {}) {
  return curve_readings(pull, true, hidden);
}

Pull pull(const std::function<double(double)>& force, double end = 0.12, int points = 1200) {
  Pull out;
  for (int i = 0; i <= points; ++i) {
    const double s = end * i / points;
    out.push_back({s / 3.3e-3, s, Sample::kNone, force(s)});
  }
  return out;
}

/// 6 N that slide, and 2e5 N/m behind s = 0.08 m.
double sliding(double s) { return 6.0 * std::min(1.0, s / 1e-3) + 2e5 * std::max(0.0, s - 0.08); }

TEST(CurveReadings, ASlidingKnotHasAPlateauALockAndAStiffness) {
  const CurveReadings readings = curve_readings(pull(sliding));
  EXPECT_NEAR(*readings.plateau_force, 6.0, 1e-12);
  EXPECT_NEAR(*readings.plateau_force_sd, 0.0, 1e-6);  // the root of a rounding of 36 N^2
  // Twice the plateau is reached 6 N / (2e5 N/m) behind the corner.
  EXPECT_NEAR(*readings.lock_extension_by_load, 0.08 + 6.0 / 2e5, 1e-9);
  EXPECT_NEAR(*readings.locked_stiffness, 2e5, 1e-4);
  EXPECT_DOUBLE_EQ(*readings.peak_force, 6.0 + 2e5 * 0.04);
  EXPECT_DOUBLE_EQ(*readings.breakaway_force, 6.0);
}

/// F = k s^2/2: the slope is k s.
TEST(CurveReadings, TellsHowTheStiffnessChangesOverThePartThatItIsReadFrom) {
  const CurveReadings readings = curve_readings(pull([](double s) { return 0.5 * 1e4 * s * s; }, 0.1, 20000));
  ASSERT_TRUE(readings.locked);
  const double from = 0.1 / std::sqrt(2.0), width = 0.1 - from;
  EXPECT_NEAR(readings.locked->width, width, 1e-5);
  EXPECT_NEAR(readings.locked->stiffness, 1e4 * (from + 0.5 * width), 0.1);
  EXPECT_NEAR(readings.locked->change, 1e4 * width, 0.1);
  EXPECT_DOUBLE_EQ(*readings.locked_stiffness, readings.locked->stiffness);
}

TEST(CurveReadings, BesideTheMeanStandWhatItIsTheMeanOf) {
  const CurveReadings readings = curve_readings(pull([](double s) { return sliding(s) + 50.0 * s; }));
  const double lock = *readings.lock_extension_by_load;
  EXPECT_NEAR(*readings.plateau_force_low, 6.0 + 50.0 * 0.3 * lock, 1e-9);
  EXPECT_NEAR(*readings.plateau_force_high, 6.0 + 50.0 * 0.8 * lock, 1e-9);
  EXPECT_NEAR(*readings.plateau_force_slope, 50.0, 1e-6);
  EXPECT_EQ(readings.no_plateau, "");
  EXPECT_EQ(*readings.largest_drop, 0.0);
  EXPECT_FALSE(readings.largest_drop_at || readings.jump_force);
}

TEST(CurveReadings, AForceThatFallsAllTheWayHasNoPlateau) {
  const CurveReadings readings = curve_readings(pull([](double s) { return sliding(s) - 70.0 * std::min(s, 0.08); }));
  EXPECT_FALSE(readings.lock_extension_by_load) << "a lock is where F doubles, and there is nothing to be doubled";
  EXPECT_EQ(readings.no_lock_by_load, "there is no plateau");
  EXPECT_FALSE(readings.plateau_force || readings.plateau_force_low || readings.breakaway_force);
  EXPECT_NE(readings.no_plateau.find("not level"), std::string::npos) << readings.no_plateau;
}

TEST(CurveReadings, ALevelThatIsLostAtOnceIsNone) {
  const auto dropping = [](double share) {
    return pull([share](double s) { return sliding(s) - (s > 0.05 && s < 0.08 ? share * 6.0 : 0.0); });
  };
  EXPECT_TRUE(curve_readings(dropping(0.3)).plateau_force);
  const CurveReadings readings = curve_readings(dropping(0.6));
  EXPECT_FALSE(readings.plateau_force);
  EXPECT_NE(readings.no_plateau.find("falls at once by 76 % of its mean"), std::string::npos) << readings.no_plateau;
  EXPECT_NEAR(*readings.largest_drop, 3.6, 1e-9);
  EXPECT_NEAR(*readings.largest_drop_at, 0.05, 1e-3 + 4e-3);
}

/// e of knots that slide up to s = 0.08 m, less what a knot lets out at s = 0.03 m.
Pull with_knots(Pull pull, double let_out, double rate = -2.0) {
  for (PullPoint& point : pull) {
    point.knot_distance = 0.2 + rate * std::min(point.extension, 0.08);
    if (point.extension > 0.03) {
      point.knot_distance -= let_out;
      if (let_out > 0.0) point.force *= 0.1;
    }
  }
  return pull;
}

TEST(CurveReadings, AKnotThatJumpsOpenHasTheForceAtWhichItDidAndNoPlateau) {
  const CurveReadings kept = curve_readings(with_knots(pull(sliding), 0.0));
  EXPECT_TRUE(kept.plateau_force);
  EXPECT_FALSE(kept.jump_force);
  const CurveReadings jumped = curve_readings(with_knots(pull(sliding), 0.02));
  ASSERT_TRUE(jumped.jump_force);
  EXPECT_NEAR(*jumped.jump_force, 6.0, 1e-9);
  EXPECT_NEAR(*jumped.force_after_jump, 0.6, 1e-9);
  EXPECT_NEAR(*jumped.jump_extension, 0.03, 5e-3);
  EXPECT_NEAR(*jumped.largest_drop, 5.4, 1e-9);
  EXPECT_FALSE(jumped.plateau_force || jumped.lock_extension_by_load || jumped.locked_stiffness);
  EXPECT_NE(jumped.no_plateau.find("jumped open"), std::string::npos);
  // Ten times the size, a thousand times the force.
  Pull large = with_knots(pull(sliding), 0.02);
  for (PullPoint& point : large) {
    point.extension *= 10.0;
    point.knot_distance *= 10.0;
    point.force *= 1e3;
  }
  EXPECT_NEAR(*curve_readings(large).jump_force, 1e3 * *jumped.jump_force, 1e-6);
}

/// What the coils take in tells a jump from knots that slip as strands shorten: as much, or a third of it.
TEST(CurveReadings, AKnotThatTakesInRodAtOnceJumpedOpen) {
  const auto slips = [](double takes_in, double force_left) {
    Pull out = with_knots(pull(sliding), 0.0);
    HiddenRod hidden;
    for (PullPoint& point : out) {
      const bool behind = point.extension > 0.03;
      if (behind) point.knot_distance -= 0.02;
      if (behind) point.force *= force_left;
      if (std::isfinite(takes_in)) hidden.push_back({0.08, 0.08 + (behind ? takes_in : 0.0)});
    }
    return curve_readings(out, hidden);
  };
  EXPECT_TRUE(slips(0.0225, 0.88).jump_force) << "28 % of what it held";
  EXPECT_FALSE(slips(0.0225, 0.95).jump_force) << "the load hardly falls";
  EXPECT_FALSE(slips(0.0225, 1.1).jump_force) << "the load rises";
  EXPECT_FALSE(slips(0.0225, 2.0).jump_force) << "it locks";
  EXPECT_FALSE(slips(0.0048, 0.5).jump_force) << "6 %";
  EXPECT_FALSE(slips(0.0, 0.1).jump_force);
  EXPECT_TRUE(slips(Sample::kNone, 0.4).jump_force);
  EXPECT_FALSE(slips(Sample::kNone, 0.95).jump_force)
      << "green VPS that slips as it is stretched to 1.25 of its length";
}

TEST(CurveReadings, AreJudgedByTheForceThatTheRodBears) {
  const Pull borne = with_knots(pull(sliding), 0.0);
  const CurveReadings a = curve_readings(borne);
  Pull balanced = borne;
  for (PullPoint& point : balanced) {
    point.borne = point.force;
    point.force -= 3.6;
  }
  const CurveReadings b = curve_readings(balanced);
  ASSERT_TRUE(a.plateau_force && b.plateau_force);
  EXPECT_NEAR(*b.plateau_force, *a.plateau_force - 3.6, 1e-9);
  EXPECT_NEAR(*b.lock_extension_by_load, *a.lock_extension_by_load, 1e-9);
  EXPECT_NEAR(*b.locked_stiffness, *a.locked_stiffness, 1e-6 * *a.locked_stiffness);
}

/// Noise of a cell of 50 kN: a third of the load.
TEST(CurveReadings, ACellsNoiseIsNothingThatTheKnotsDid) {
  Pull noisy = with_knots(pull(sliding), 0.0);
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    noisy[i].borne = noisy[i].force;
    noisy[i].force += i % 2 == 0 ? 2.0 : -2.0;
  }
  const CurveReadings readings = curve_readings(noisy);
  EXPECT_NEAR(*readings.plateau_force, 6.0, 1e-3);
  EXPECT_NEAR(*readings.plateau_force_high, 8.0, 1e-9);
  EXPECT_EQ(*readings.largest_drop, 0.0);
  EXPECT_NEAR(*readings.lock_extension_by_load, 0.08 + 6.0 / 2e5, 1e-9);
}

TEST(CurveReadings, ALockBetweenReadingsFarApartIsNone) {
  const CurveReadings near = curve_readings(pull(sliding, 0.12, 30));  // 4 mm
  EXPECT_TRUE(near.lock_extension_by_load) << near.no_lock_by_load;
  EXPECT_TRUE(near.largest_drop);
  const CurveReadings far = curve_readings(pull(sliding, 0.12, 24));  // 5 mm
  EXPECT_FALSE(far.lock_extension_by_load);
  EXPECT_EQ(far.no_lock_by_load, "the readings around it are 0.062 of the way apart, where 0.05 is close enough");
  EXPECT_FALSE(far.largest_drop || far.largest_drop_at);
  EXPECT_TRUE(far.plateau_force && far.locked_stiffness);
}

TEST(CurveReadings, AMeanOverKnotsThatHoldIsNone) {
  const CurveReadings readings = curve_readings(with_knots(pull(sliding), 0.0, -1.0));
  EXPECT_NEAR(*readings.rises_at, 0.08 + 6.0 / 2e5, 1e-9);
  EXPECT_FALSE(readings.lock_extension_by_load) << "what did not slide does not lock";
  EXPECT_FALSE(readings.plateau_force);
  EXPECT_NE(readings.no_plateau.find("de/ds is -1.00"), std::string::npos) << readings.no_plateau;
}

TEST(CurveReadings, ALoopBetweenHeldNodesHasNoPlateauHoweverItsKnotsMove) {
  for (const double rate : {-0.97, 0.04, -2.0})
    EXPECT_EQ(curve_readings(with_knots(pull(sliding), 0.0, rate), false).no_plateau,
              "two nodes of the loop are held: the load is also that of the side without knots, which is stretched");
  EXPECT_EQ(curve_readings(pull(sliding), false).no_plateau, "") << "a strand without two knots has no such side";
}

TEST(CurveReadings, TheSameLinesByMorePointsAreTheSame) {
  const auto bent = [](double s) { return sliding(s) + 50.0 * std::max(0.0, s - 0.04); };
  Pull few;
  for (const double s : {0.0, 1e-3, 0.03, 0.04, 0.05, 0.08, 0.081, 0.12}) few.push_back({s, s, Sample::kNone, bent(s)});
  const CurveReadings a = curve_readings(few), b = curve_readings(pull(bent));
  EXPECT_NEAR(*a.lock_extension_by_load, *b.lock_extension_by_load, 1e-9);
  EXPECT_NEAR(*a.plateau_force, *b.plateau_force, 1e-9);
  EXPECT_NEAR(*a.plateau_force_sd, *b.plateau_force_sd, 1e-6);
  const CurveReadings line = curve_readings({{0.0, 0.0, Sample::kNone, 0.0}, {1.0, 0.1, Sample::kNone, 10.0}});
  EXPECT_FALSE(line.plateau_force || line.lock_extension_by_load);
}

/// Also where falls are equal, and where points are further apart than a fall may be.
TEST(CurveReadings, TheLargestDropIsThatOfAllPairs) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    Pull pull;
    double s = 0.0;
    for (int i = 0; i < 60; ++i) {
      PullPoint point;
      point.extension = s += 1e-4 * static_cast<double>(1 + random() % 40 * (random() % 4 == 0 ? 5 : 1));
      point.force = static_cast<double>(random() % 6);
      pull.push_back(point);
    }
    const double end = pull[55].extension, way = 0.05 * (end - pull.front().extension);
    std::optional<Drop> expected;
    for (std::size_t i = 0; i <= 55; ++i)
      for (std::size_t j = i + 1; j <= 55 && (j == i + 1 || pull[j].extension - pull[i].extension <= way); ++j) {
        const double fall = pull[i].force - pull[j].force, largest = expected ? expected->force(pull) : 0.0;
        if (fall > largest || (fall == largest && expected && i > expected->from)) expected = Drop{i, j};
      }
    const std::optional<Drop> found = largest_drop(pull, end);
    ASSERT_EQ(found.has_value(), expected.has_value()) << trial;
    if (!found) continue;
    EXPECT_EQ(found->from, expected->from) << trial;
    EXPECT_EQ(found->to, expected->to) << trial;
  }
}

TEST(CurveReadings, OfNothingThereAreNone) {
  EXPECT_FALSE(curve_readings({}).peak_force);
  const CurveReadings one = curve_readings({{0.0, 0.0, Sample::kNone, 1.0}});
  EXPECT_EQ(one.peak_force, 1.0);
  EXPECT_FALSE(one.plateau_force || one.lock_extension_by_load || one.locked_stiffness);
}

}  // namespace
}  // namespace knot_utm
