#include "knot_utm/ros/validate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/gate.hpp"

namespace knot_utm {
namespace {

using testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const CrossheadLimits kLimits{1.0, 0.05};

Crosshead command(std::uint64_t sequence) {
  Command c;
  c.sequence = sequence;
  c.time = 0.05 * static_cast<double>(sequence);
  c.phase = sequence == 0 ? Phase::kIdle : Phase::kPull;
  c.step = sequence == 0 ? -1 : 0;
  c.velocity = c.speed = sequence == 0 ? 0.0 : 0.0033;
  c.displacement = c.velocity * c.time;
  return to_message(c, 1, test_stamp(10.0, c.time));
}

KnotState state(std::uint64_t sequence) {
  Sample s;
  s.sequence = sequence;
  s.time = 0.05 * static_cast<double>(sequence);
  s.phase = Phase::kPull;
  return to_message(s, 1, test_stamp(10.0, s.time));
}

KnotRecord record(std::uint64_t sequence) {
  KnotRecord r;
  r.command = command(sequence);
  r.answer = state(sequence);
  r.steps = {state(sequence), state(sequence)};
  r.shape = to_message(Points::Zero(3, 4), Eigen::VectorXd::Zero(3), 0.001);
  return r;
}

/// The fault of a message after one change.
template <class Message, class Change>
std::string fault_with(Message message, Change change) {
  change(message);
  return fault_of(message);
}
template <class Change>
std::string fault_with(Crosshead message, Change change) {
  change(message);
  return fault_of(message, kLimits);
}

TEST(Validate, WhatTheNodesSayPasses) {
  EXPECT_EQ(fault_of(command(0), kLimits), "");
  EXPECT_EQ(fault_of(command(3), kLimits), "");
  EXPECT_EQ(fault_after(command(3), command(4), kLimits), "");
  EXPECT_EQ(fault_of(state(3)), "");
  EXPECT_EQ(fault_of(record(3)), "");
  KnotRecord failure = record(3);
  failure.answer.status = KnotState::FAILED;
  failure.failed_step.resize(9);
  EXPECT_EQ(fault_of(failure), "");
  TestStatus status;
  status.phase = "idle";
  status.time_left = status.real_time_factor = kNan;
  EXPECT_EQ(fault_of(status), "");
  SpecimenInfo specimen;
  specimen.longest_step = 0.05;
  EXPECT_EQ(fault_of(specimen), "");
}

TEST(Validate, CommandNamesFieldValueAndWhatIsAllowed) {
  EXPECT_EQ(fault_with(command(3), [](Crosshead& m) { m.velocity = 1.0; }), "velocity is 1, but must be -0.5 to 0.5");
}

TEST(Validate, CommandThatNoProgramCanMean) {
  const auto fault = [](auto change) { return fault_with(command(3), change); };
  EXPECT_THAT(fault([](Crosshead& m) { m.time = kNan; }), StartsWith("time is nan"));
  EXPECT_THAT(fault([](Crosshead& m) { m.time = -1.0; }), StartsWith("time is -1"));
  EXPECT_THAT(fault([](Crosshead& m) { m.displacement = kInf; }), StartsWith("displacement is inf"));
  EXPECT_THAT(fault([](Crosshead& m) { m.displacement = -1.1; }), StartsWith("displacement is -1.1"));
  EXPECT_THAT(fault([](Crosshead& m) { m.speed = -0.001; }), StartsWith("speed is -0.001"));
  EXPECT_THAT(fault([](Crosshead& m) { m.speed = kNan; }), StartsWith("speed is nan"));
  EXPECT_THAT(fault([](Crosshead& m) { m.duration = 1e7; }), StartsWith("duration is 1"));
  EXPECT_THAT(fault([](Crosshead& m) { m.phase = "pulling"; }), StartsWith("phase is \"pulling\""));
  EXPECT_THAT(fault([](Crosshead& m) { m.step = -2; }), StartsWith("step is -2"));
  EXPECT_THAT(fault([](Crosshead& m) { m.run = 0; }), StartsWith("run is 0"));
  EXPECT_THAT(fault([](Crosshead& m) { m.header.stamp = ros::Time(0.1); }), StartsWith("header.stamp is 0.1"));
  EXPECT_THAT(fault([](Crosshead& m) { m.header.frame_id = std::string(1000000, 'x'); }),
              StartsWith("header.frame_id is 1000000 characters"));
  EXPECT_THAT(fault_with(command(0), [](Crosshead& m) { m.time = 0.05; }), StartsWith("time is 0.05"));
}

TEST(Validate, CommandThatDoesNotFollowTheLast) {
  EXPECT_THAT(fault_after(command(3), command(3), kLimits), StartsWith("time is "));
  EXPECT_THAT(fault_after(command(3), command(2), kLimits), StartsWith("time is "));
  EXPECT_THAT(fault_after(command(3), command(5), kLimits), StartsWith("time is 0.25"));
  Crosshead jump = command(4);
  jump.displacement += 0.1;
  EXPECT_THAT(fault_after(command(3), jump, kLimits), StartsWith("displacement is "));
}

TEST(Validate, StateOfNoSpecimen) {
  const auto fault = [](auto change) { return fault_with(state(3), change); };
  EXPECT_THAT(fault([](KnotState& m) { m.load = kNan; }), StartsWith("load is nan"));
  EXPECT_THAT(fault([](KnotState& m) { m.force_lower = kInf; }), StartsWith("force_lower is inf"));
  EXPECT_THAT(fault([](KnotState& m) { m.dissipation = kNan; }), StartsWith("dissipation is nan"));
  EXPECT_THAT(fault([](KnotState& m) { m.tail_force = {0.0, kInf}; }), StartsWith("tail_force[1] is inf"));
  EXPECT_THAT(fault([](KnotState& m) { m.excess_length.assign(1000, 0.0); }),
              StartsWith("excess_length is of 1000 knots, but must be of at most"));
  EXPECT_THAT(fault([](KnotState& m) { m.contacts = -1; }), StartsWith("contacts is -1"));
  EXPECT_THAT(fault([](KnotState& m) { m.status = 5; }), StartsWith("status is 5"));
  EXPECT_THAT(fault([](KnotState& m) { m.knot_type = 3; }), StartsWith("knot_type is 3"));
  EXPECT_THAT(fault([](KnotState& m) { m.break_place = 4; }), StartsWith("break_place is 4"));
  EXPECT_THAT(fault([](KnotState& m) { m.break_arclength = -1.0; }), StartsWith("break_arclength is -1"));
  EXPECT_THAT(fault([](KnotState& m) { m.message = std::string(1000000, 'x'); }), StartsWith("message is 1000000"));
  // Nothing that is written or logged gets a second line.
  EXPECT_EQ(fault([](KnotState& m) { m.message = "x\nended_by: break"; }),
            "message is \"x ended_by: break\", but must be one line of text");
}

TEST(Validate, RecordThatDoesNotHoldTogether) {
  const auto fault = [](auto change) { return fault_with(record(3), change); };
  EXPECT_THAT(fault([](KnotRecord& m) { m.command.displacement = kNan; }), StartsWith("command.displacement is nan"));
  EXPECT_THAT(fault([](KnotRecord& m) { m.answer.load = kNan; }), StartsWith("answer.load is nan"));
  EXPECT_THAT(fault([](KnotRecord& m) { m.answer.sequence = 4; }), StartsWith("answer.sequence is 4"));
  EXPECT_THAT(fault([](KnotRecord& m) { m.steps[1].phase = "?"; }), StartsWith("steps[1].phase is "));
  EXPECT_THAT(fault([](KnotRecord& m) { m.steps.resize(1000001); }), StartsWith("steps is 1000001"));
  EXPECT_THAT(fault([](KnotRecord& m) { m.shape.tension.resize(2); }), StartsWith("shape.tension is 2 edges"));
  EXPECT_THAT(fault([](KnotRecord& m) { m.shape.points[2].y = kNan; }),
              StartsWith("shape.points is not finite at point 2"));
  EXPECT_THAT(fault([](KnotRecord& m) { m.shape.tension[2] = kInf; }),
              StartsWith("shape.tension is not finite at edge 2"));
  EXPECT_THAT(fault([](KnotRecord& m) { m.shape.tension[2] = kNan; }),
              StartsWith("shape.tension is not finite at edge 2"));
  // Of a rod that has parted none is known.
  EXPECT_EQ(fault([](KnotRecord& m) {
              m.answer.status = KnotState::BROKEN;
              m.shape.tension[2] = kNan;
            }),
            "");
  EXPECT_THAT(fault([](KnotRecord& m) { m.failed_step.resize(9); }), StartsWith("failed_step is 9 bytes"));
}

TEST(Validate, SpecimenAndStatus) {
  SpecimenInfo specimen;
  EXPECT_THAT(fault_of(specimen), StartsWith("longest_step is 0"));
  specimen.longest_step = kNan;
  EXPECT_THAT(fault_of(specimen), StartsWith("longest_step is nan"));
  TestStatus status;
  status.phase = "pull";
  EXPECT_THAT(fault_with(status, [](TestStatus& m) { m.state = 4; }), StartsWith("state is 4"));
  EXPECT_THAT(fault_with(status, [](TestStatus& m) { m.reason = "a\nb"; }), StartsWith("reason is \"a b\""));
  EXPECT_THAT(fault_with(status, [](TestStatus& m) { m.progress = kNan; }), StartsWith("progress is nan"));
}

TEST(Validate, OneLineIsOneShortLine) {
  EXPECT_EQ(one_line("a\nb\r\tc\x1b[0m\x7f"), "a b  c [0m ");
  EXPECT_EQ(one_line(std::string(1000000, 'x')).size(), 203u);
}

TEST(Gate, AdmitsItsPublisherOnly) {
  Gate gate("topic", "/a/knot_node", 100);
  EXPECT_TRUE(gate.admits("/a/knot_node", 100));
  EXPECT_FALSE(gate.admits("/a/knot_node", 101));
  EXPECT_FALSE(gate.admits("/knot_node", 10));
  EXPECT_FALSE(gate.admits("", 10));
}

}  // namespace
}  // namespace knot_utm
