#include "knot_utm/ros/conversions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace knot_utm {
namespace {

/// A number with all its bits in use, different for each `i`.
double odd_number(int i) { return std::sqrt(2.0 + i) * std::pow(10.0, i % 7 - 3); }

Sample full_sample() {
  Sample s;
  s.sequence = (1ull << 60) + 7;
  s.time = odd_number(0);
  s.phase = Phase::kRelease;
  double* const fields[] = {
      &s.displacement,     &s.extension,       &s.end_to_end,     &s.knot_distance,         &s.load,
      &s.force_upper,      &s.force_lower,     &s.tail_force[0],  &s.tail_force[1],         &s.excess_length[0],
      &s.excess_length[1], &s.max_penetration, &s.normal_force,   &s.fastest_node,          &s.stretching_energy,
      &s.bending_energy,   &s.twisting_energy, &s.contact_energy, &s.kinetic_energy,        &s.grip_work,
      &s.dissipation,      &s.balance_offset,  &s.friction_loss,  &s.numerical_dissipation, &s.reweighting_loss,
      &s.moment_imbalance, &s.highest_load,    &s.lowest_load,    &s.break_arclength,       &s.knots_force,
      &s.knot_on_roller,   &s.raw_extension};
  int i = 1;
  for (double* field : fields) *field = odd_number(i++);
  s.contacts = 31;
  s.steps = 1001;
  s.rejected_steps = 12;
  s.newton_iterations = 5003;
  s.break_place = BreakPlace::kKnot;
  s.knot_type = KnotType::kCrossed;
  s.status = BenchStatus::kNotEquilibrated;
  s.message = "not at rest";
  return s;
}

TEST(Conversions, SampleSurvivesBitForBit) {
  const Sample in = full_sample();
  const Sample out = from_message(to_message(in, 3, ros::Time(1.5)));
  EXPECT_EQ(out.sequence, in.sequence);
  EXPECT_EQ(out.time, in.time);
  EXPECT_EQ(out.phase, in.phase);
  EXPECT_EQ(out.displacement, in.displacement);
  EXPECT_EQ(out.extension, in.extension);
  EXPECT_EQ(out.end_to_end, in.end_to_end);
  EXPECT_EQ(out.knot_distance, in.knot_distance);
  EXPECT_EQ(out.load, in.load);
  EXPECT_EQ(out.balance_offset, in.balance_offset);
  EXPECT_EQ(out.highest_load, in.highest_load);
  EXPECT_EQ(out.lowest_load, in.lowest_load);
  EXPECT_EQ(out.break_arclength, in.break_arclength);
  EXPECT_EQ(out.break_place, in.break_place);
  EXPECT_EQ(out.force_upper, in.force_upper);
  EXPECT_EQ(out.force_lower, in.force_lower);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(out.tail_force[i], in.tail_force[i]);
    EXPECT_EQ(out.excess_length[i], in.excess_length[i]);
  }
  EXPECT_EQ(out.max_penetration, in.max_penetration);
  EXPECT_EQ(out.normal_force, in.normal_force);
  EXPECT_EQ(out.contacts, in.contacts);
  EXPECT_EQ(out.fastest_node, in.fastest_node);
  EXPECT_EQ(out.stretching_energy, in.stretching_energy);
  EXPECT_EQ(out.bending_energy, in.bending_energy);
  EXPECT_EQ(out.twisting_energy, in.twisting_energy);
  EXPECT_EQ(out.contact_energy, in.contact_energy);
  EXPECT_EQ(out.kinetic_energy, in.kinetic_energy);
  EXPECT_EQ(out.grip_work, in.grip_work);
  EXPECT_EQ(out.dissipation, in.dissipation);
  EXPECT_EQ(out.friction_loss, in.friction_loss);
  EXPECT_EQ(out.numerical_dissipation, in.numerical_dissipation);
  EXPECT_EQ(out.reweighting_loss, in.reweighting_loss);
  EXPECT_EQ(out.moment_imbalance, in.moment_imbalance);
  EXPECT_EQ(out.steps, in.steps);
  EXPECT_EQ(out.rejected_steps, in.rejected_steps);
  EXPECT_EQ(out.newton_iterations, in.newton_iterations);
  EXPECT_EQ(out.knot_type, in.knot_type);
  EXPECT_EQ(out.status, in.status);
  EXPECT_EQ(out.message, in.message);
  EXPECT_EQ(out.knots_force, in.knots_force);
  EXPECT_EQ(out.knot_on_roller, in.knot_on_roller);
  EXPECT_EQ(out.raw_extension, in.raw_extension);
}

TEST(Conversions, WhatIsNotThereStaysNotANumber) {
  const Sample out = from_message(to_message(Sample(), 1, ros::Time(1.0)));
  EXPECT_TRUE(std::isnan(out.knot_distance));
  EXPECT_TRUE(std::isnan(out.tail_force[1]));
}

TEST(Conversions, CommandSurvivesBitForBit) {
  Command in;
  in.sequence = 123456789012345ull;
  in.time = odd_number(1);
  in.displacement = odd_number(2);
  in.velocity = odd_number(3);
  in.step = -1;
  in.phase = Phase::kPull;
  in.speed = odd_number(4);
  in.duration = odd_number(5);
  in.balance = true;
  in.read_cell = true;
  const Command out = from_message(to_message(in, 1, ros::Time(1.0)));
  EXPECT_EQ(out.sequence, in.sequence);
  EXPECT_EQ(out.time, in.time);
  EXPECT_EQ(out.displacement, in.displacement);
  EXPECT_EQ(out.velocity, in.velocity);
  EXPECT_EQ(out.step, in.step);
  EXPECT_EQ(out.phase, in.phase);
  EXPECT_EQ(out.speed, in.speed);
  EXPECT_EQ(out.duration, in.duration);
  EXPECT_EQ(out.balance, in.balance);
  EXPECT_EQ(out.read_cell, in.read_cell);
}

TEST(Conversions, EveryPhaseIsFoundByItsName) {
  for (int i = 0; i <= static_cast<int>(Phase::kDone); ++i) {
    const Phase phase = static_cast<Phase>(i);
    EXPECT_EQ(phase_from_name(phase_name(phase)), phase);
  }
  EXPECT_THROW(phase_from_name("pulling"), std::invalid_argument);
}

TEST(Conversions, StampIsNeverZero) {
  EXPECT_EQ(test_stamp(0.0, 0.0), ros::TIME_MIN);
  EXPECT_EQ(test_stamp(10.0, 0.25), ros::Time(10.25));
  EXPECT_EQ(test_stamp(0.333333333 - 1.0 / 3.0, 0.0), ros::TIME_MIN);
}

TEST(Conversions, ShapeSurvives) {
  const Points in = Points::Random(3, 7);
  EXPECT_EQ(points_from_message(to_message(in, Eigen::VectorXd::Zero(6), 0.001)), in);
}

}  // namespace
}  // namespace knot_utm
