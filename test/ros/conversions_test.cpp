#include "knot_utm/ros/conversions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample_fields.hpp"

namespace knot_utm {
namespace {

/// A number with all its bits in use, different for each `i`.
double odd_number(int i) { return std::sqrt(2.0 + i) * std::pow(10.0, i % 7 - 3); }

/// A value of its own in each field, none of which is the one that a sample begins with.
Sample full_sample() {
  Sample s;
  int i = 0;
  visit_sample_fields([&](const auto& field) {
    auto& value = field.of(s);
    using Value = ValueOf<std::decay_t<decltype(field)>>;
    ++i;
    if constexpr (std::is_enum_v<Value>) {
      value = last_of(value);
    } else if constexpr (std::is_same_v<Value, PerKnot>) {
      value = {odd_number(i), odd_number(i + 1)};
      i += 2;
    } else if constexpr (std::is_same_v<Value, std::string>) {
      value = "not at rest " + std::to_string(i);
    } else if constexpr (std::is_same_v<Value, std::uint64_t>) {
      value = (1ull << 60) + static_cast<std::uint64_t>(i);
    } else {
      value = static_cast<Value>(31.0 * odd_number(i));
    }
  });
  s.phase = Phase::kDone;  // the highest number of a phase that archives take is none of a phase
  return s;
}

TEST(Conversions, SampleSurvivesBitForBit) {
  const Sample in = full_sample();
  const Sample out = from_message(to_message(in, 3, ros::Time(1.5)));
  visit_sample_fields([&](const auto& field) {
    if constexpr (std::is_same_v<ValueOf<std::decay_t<decltype(field)>>, PerKnot>) {
      const PerKnot &found = field.of(out), &sent = field.of(in);
      EXPECT_TRUE(std::equal(found.begin(), found.end(), sent.begin(), sent.end())) << field.name;
    } else {
      EXPECT_EQ(field.of(out), field.of(in)) << field.name;
    }
  });
}

TEST(Conversions, RefusesWhatNoSampleIs) {
  const auto refuses = [](std::uint8_t KnotState::*field, std::uint8_t highest) {
    KnotState bad = to_message(Sample(), 1, ros::Time(1.0));
    bad.*field = static_cast<std::uint8_t>(highest + 1);
    EXPECT_THROW(from_message(bad), std::invalid_argument);
  };
  refuses(&KnotState::status, KnotState::FAILED);
  refuses(&KnotState::knot_type, KnotState::KNOT_CROSSED);
  refuses(&KnotState::break_place, KnotState::BREAK_GRIP);
  KnotState bad;
  bad.phase = "pulling";
  EXPECT_THROW(from_message(bad), std::invalid_argument);
}

TEST(Conversions, WhatIsNotThereStaysNotANumber) {
  Sample in;
  in.tail_force = {70.0, Sample::kNone};
  const Sample out = from_message(to_message(in, 1, ros::Time(1.0)));
  EXPECT_TRUE(std::isnan(out.knot_distance));
  ASSERT_EQ(out.tail_force.size(), 2u);
  EXPECT_EQ(out.tail_force[0], 70.0);
  EXPECT_TRUE(std::isnan(out.tail_force[1]));
  EXPECT_EQ(out.excess_length.size(), 0u);
}

TEST(Conversions, CommandOfEachPhaseSurvivesBitForBit) {
  const auto fields = [](const Command& c) {
    return std::tie(c.sequence, c.time, c.displacement, c.velocity, c.turn, c.step, c.phase, c.speed, c.duration,
                    c.balance, c.read_cell);
  };
  for (const Phase phase : all_phases()) {
    const Command in{123456789012345ull, odd_number(1), odd_number(2), odd_number(3), odd_number(4), -1, phase,
                     odd_number(5),      odd_number(6), true,          true};
    const Command out = from_message(to_message(in, 1, ros::Time(1.0)));
    EXPECT_EQ(fields(out), fields(in)) << phase_name(phase);
  }
}

TEST(Conversions, StampIsNeverZero) {
  EXPECT_EQ(test_stamp(0.0, 0.0), ros::TIME_MIN);
  EXPECT_EQ(test_stamp(10.0, 0.25), ros::Time(10.25));
  EXPECT_EQ(test_stamp(0.333333333 - 1.0 / 3.0, 0.0), ros::TIME_MIN);
}

TEST(Conversions, ShapeSurvives) {
  const Points in = Points::Random(3, 7);
  EXPECT_EQ(points_from_message(to_message(in, Eigen::VectorXd::Zero(6), 0.001, Crosshead())), in);
}

}  // namespace
}  // namespace knot_utm
