#include "knot_utm/sim/step_control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_matrix.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// Accepts every step that is no longer than `longest_good`, and says of each what it is told to.
class ScriptedStep : public TimeStep {
 public:
  ScriptedStep() : TimeStep(make_rod(braided_rope(), Eigen::VectorXd::Constant(4, 0.01)), RodState{}) {}

  StepSummary step(const Boundary& /*boundary*/, double dt, SolveStrategy strategy) override {
    StepSummary out;
    (strategy == SolveStrategy::kSecants ? by_secants : by_tangents).push_back(dt);
    if (strategy != SolveStrategy::kSecants && only_secants) out.reason = "it ran in circles";
    out.newton.iterations = iterations;
    out.largest_motion = speed * dt;
    out.largest_slip = slip_speed * dt;
    if (dt > longest_good) out.reason = "it was too long";
    tried.push_back(dt);
    out.diagnosis = diagnosis();
    return out;
  }
  static StepDiagnosis diagnosis() {
    StepDiagnosis out;
    out.node = 3;
    return out;
  }
  static std::string text() { return diagnosis().text(); }
  Vec3 tried_reaction(int) const override { return Vec3::Zero(); }
  Vec3 tried_roller_force(int) const override { return Vec3::Zero(); }
  const StepReadings& readings() const override { throw std::logic_error("nothing is read of it"); }

  double longest_good = 1.0;  // [s]
  double speed = 0.0;         // [m/s]
  double slip_speed = 0.0;    // [m/s]
  int iterations = 3;
  bool only_secants = false;
  std::vector<double> tried, by_tangents, by_secants;
  void take_lengths() override {}
};

struct Outcome {
  std::string gave_up;
  double time = 0.0;
  std::vector<double> taken;
};

Outcome advance(StepControl& control, ScriptedStep& step, double end) {
  Outcome out;
  const Boundary boundary;
  out.gave_up = control.advance(
      step, out.time, end, [&](double, double) -> const Boundary& { return boundary; },
      [&](double, double dt, const StepSummary&) { out.taken.push_back(dt); });
  return out;
}

StepControl::Options options() {
  StepControl::Options out;
  out.longest = 0.1;
  out.motion = 1.0;
  return out;
}

TEST(StepControl, AimsAtASlipOfStrandsAndALongerWayOfNodes) {
  StepControl::Options from = options();
  from.first = 1e-3;
  from.slip = 0.5;
  for (const bool together : {true, false}) {
    StepControl control(from);
    ScriptedStep step;
    step.speed = 20.0;
    step.slip_speed = together ? 0.0 : 20.0;
    const Outcome run = advance(control, step, 1.0);
    EXPECT_EQ(run.gave_up, "");
    const double longest = *std::max_element(run.taken.begin(), run.taken.end());
    EXPECT_NEAR(longest, (together ? from.motion : from.slip) / step.speed, 1e-3);
  }
}

TEST(StepControl, TriesSecantsWhereStepsHaveFailedInARow) {
  StepControl control(options());
  ScriptedStep step;
  step.only_secants = true;
  const Outcome run = advance(control, step, 0.1);
  EXPECT_EQ(run.gave_up, "");
  ASSERT_GE(step.by_tangents.size(), 7u);
  // Six have failed before: the seventh, a 64th as long as the first, is solved.
  EXPECT_NEAR(run.taken.front(), 0.1 / 64.0, 1e-15);
  EXPECT_EQ(step.by_secants.front(), run.taken.front());
  EXPECT_EQ(step.by_secants.size(), run.taken.size());
}

TEST(StepControl, GivesUpWhatManyIterationsLeadNowhere) {
  StepControl control(options());
  ScriptedStep step;
  step.longest_good = 2e-6;
  step.iterations = 6;  // at most 3e-7 s an iteration; a hundred-thousandth of the longest step is 1e-6 s
  const Outcome run = advance(control, step, 1.0);
  EXPECT_THAT(run.gave_up, testing::HasSubstr("no headway: the last 500"));
  EXPECT_GT(run.time, 0.0);
  EXPECT_LT(run.time, 0.1);
}

TEST(StepControl, LabouringOnIsNotGivenUp) {
  StepControl control(options());
  ScriptedStep step;
  step.longest_good = 4e-5;
  step.iterations = 6;
  const Outcome run = advance(control, step, 1.0);
  EXPECT_EQ(run.gave_up, "");
  EXPECT_GT(control.counters().iterations, 50'000u);
}

TEST(StepControl, EndsExactlyAtTheEndWithoutASliver) {
  StepControl control(options());
  ScriptedStep step;
  const Outcome run = advance(control, step, 0.25);
  EXPECT_EQ(run.gave_up, "");
  EXPECT_EQ(run.time, 0.25);
  ASSERT_EQ(run.taken.size(), 3u);
  for (const double dt : run.taken) EXPECT_NEAR(dt, 0.25 / 3.0, 1e-15);
}

TEST(StepControl, BeginsWithTheFirstStepAndGrowsFromIt) {
  StepControl::Options from = options();
  from.first = 0.001;
  StepControl control(from);
  ScriptedStep step;
  const Outcome run = advance(control, step, 1.0);
  EXPECT_NEAR(run.taken.front(), 0.001, 1e-6);
  EXPECT_GT(run.taken[1], run.taken[0]);
  EXPECT_NEAR(*std::max_element(run.taken.begin(), run.taken.end()), 0.1, 0.01);
  EXPECT_EQ(control.counters().rejected, 0u);
}

TEST(StepControl, HalvesAStepThatWasNotAccepted) {
  StepControl control(options());
  ScriptedStep step;
  step.longest_good = 0.03;
  const Outcome run = advance(control, step, 0.1);
  EXPECT_EQ(run.gave_up, "");
  EXPECT_EQ(run.time, 0.1);
  ASSERT_GE(step.tried.size(), 3u);
  EXPECT_DOUBLE_EQ(step.tried[0], 0.1);
  EXPECT_DOUBLE_EQ(step.tried[1], 0.05);
  EXPECT_DOUBLE_EQ(step.tried[2], 0.025);
  EXPECT_EQ(control.counters().steps, run.taken.size());
  EXPECT_EQ(control.counters().rejected, step.tried.size() - run.taken.size());
  EXPECT_EQ(control.counters().iterations, 3 * step.tried.size());
  EXPECT_NEAR(std::accumulate(run.taken.begin(), run.taken.end(), 0.0), 0.1, 1e-15);
}

TEST(StepControl, GivesUpWithTheReasonOfTheLastStep) {
  StepControl control(options());
  ScriptedStep step;
  step.longest_good = 0.0;
  const Outcome run = advance(control, step, 0.1);
  EXPECT_THAT(run.gave_up, testing::HasSubstr("it was too long"));
  EXPECT_THAT(run.gave_up, testing::HasSubstr("time step fell below 1e-07 s"));
  EXPECT_EQ(run.time, 0.0);
  EXPECT_TRUE(run.taken.empty());
  EXPECT_EQ(control.counters().steps, 0u);
  EXPECT_GE(step.tried.back(), 1e-7);
}

TEST(StepControl, AimsAtAMovementAndIsShorterWhereNewtonFindsItHard) {
  StepControl moving(options());
  ScriptedStep fast;
  fast.speed = 20.0;  // a movement of 1 takes 0.05 s
  EXPECT_NEAR(advance(moving, fast, 1.0).taken.back(), 0.05, 1e-9);

  StepControl labouring(options());
  ScriptedStep hard;
  hard.iterations = 10;
  const Outcome run = advance(labouring, hard, 0.3);
  ASSERT_GE(run.taken.size(), 2u);
  EXPECT_LT(run.taken[1], 0.75 * run.taken[0]);
}

/// Else a run would give up in which every step is accepted.
TEST(StepControl, DoesNotShortenStepsThatAreHardHoweverShort) {
  StepControl::Options from = options();
  StepControl control(from);
  ScriptedStep hard;
  hard.iterations = 10;
  const Outcome run = advance(control, hard, 0.7);
  EXPECT_EQ(run.gave_up, "");
  EXPECT_LT(run.taken.back(), 1e-3 * from.longest);
  EXPECT_GT(*std::min_element(run.taken.begin(), run.taken.end()), 0.5e-3 * from.longest);
}

constexpr int kNodes = 30;

/// A contact of point a on nodes a0.. with its foot on b0.., nearer to the end of its segment.
ContactPoint pressed(int a0, int b0) {
  ContactPoint contact;
  contact.a0 = a0;
  contact.b0 = b0;
  contact.overlap = 1e-6;
  contact.c[3] = -0.1;
  contact.c[5] = -0.3;
  return contact;
}

void expect_blocks_of(const std::vector<ContactPoint>& contacts, StepMatrix<3>& matrix) {
  std::size_t n = 0;
  for (const ContactPoint& contact : contacts) {
    if (!contact.active()) continue;
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        EXPECT_EQ(matrix.contact_blocks(n)[static_cast<std::size_t>(3 * k + l)],
                  matrix.values().pattern().indices(contact.a0 + k, contact.b0 + l));
    ++n;
  }
}

TEST(StepMatrix, FindsTheBlocksOfContactsThatComeSlideAndGo) {
  StepMatrix<3> matrix(kNodes);
  std::vector<ContactPoint> contacts = {pressed(2, 20), pressed(2, 21), pressed(5, 17), pressed(20, 2)};
  matrix.locate(contacts);
  expect_blocks_of(contacts, matrix);
  contacts[1].overlap = -1e-6;                        // lets go
  contacts[2] = pressed(5, 18);                       // slides on, within the room it was given
  contacts.insert(contacts.begin(), pressed(1, 20));  // and a new one
  matrix.locate(contacts);
  expect_blocks_of(contacts, matrix);
  contacts[0] = pressed(1, 9);  // far from anything the pattern had
  matrix.locate(contacts);
  expect_blocks_of(contacts, matrix);
}

TEST(StepMatrix, ForgetsWhatARejectedStepMadeOfThePattern) {
  StepMatrix<3> matrix(kNodes);
  const std::vector<ContactPoint> accepted = {pressed(2, 20), pressed(5, 17)};
  matrix.locate(accepted);
  matrix.commit();
  const int blocks = matrix.values().pattern().blocks();
  for (const int b0 : {12, 24}) {
    matrix.begin();
    const std::vector<ContactPoint> tried = {pressed(2, 20), pressed(5, b0), pressed(5, b0)};
    matrix.locate(tried);
    expect_blocks_of(tried, matrix);
    EXPECT_EQ(matrix.values().pattern().index(5, 16), -1);
    matrix.locate({pressed(2, 21), pressed(9, 26)});  // and once more in the same step
    expect_blocks_of({pressed(2, 21), pressed(9, 26)}, matrix);
  }
  matrix.begin();
  EXPECT_EQ(matrix.values().pattern().blocks(), blocks);
  EXPECT_EQ(matrix.values().pattern().index(5, 12), -1);
  EXPECT_EQ(matrix.values().pattern().index(9, 26), -1);
  matrix.locate(accepted);
  expect_blocks_of(accepted, matrix);
}

TEST(StepMatrix, HasRoomForContactsAboutToComeAndNotForThoseFarAway) {
  StepMatrix<3> matrix(kNodes);
  // Room is looked for where a contact has none.
  ContactPoint near = pressed(2, 20), far = pressed(5, 14), touches = pressed(7, 17);
  for (ContactPoint* contact : {&near, &far}) contact->begins = -1e-4;
  near.overlap = -1.9e-4;
  far.overlap = -2.1e-4;
  matrix.locate({near, far, touches});
  EXPECT_GE(matrix.values().pattern().index(near.a0, near.b0), 0);
  EXPECT_EQ(matrix.values().pattern().index(far.a0, far.b0), -1);
  near.overlap = far.overlap = 0.0;
  matrix.locate({near, far, touches});
  expect_blocks_of({near, far, touches}, matrix);
}

}  // namespace
}  // namespace knot_utm
