// A knot from a file on the machine: its free ends tie it, are let go, and are read while it is pulled.

#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

/// The shipped method at draft, with a knot whose ends may be pulled with different loads.
struct Bench {
  Method method;
  TestingMachine machine;
  ProgramRunner program;
  Sample last;

  explicit Bench(const Method& method_)
      : method(method_),
        machine(method.specimen, method.material, method.machine, method.physics),
        program(method.program, method.machine.load_cell.sampling_rate, machine.longest_step(), {}) {}

  /// Runs on until a step of the program has ended, or to the end.
  void run_past(Phase phase) {
    bool in_it = false;
    while (!program.ended()) {
      const Command command = program.last();
      if (in_it && command.phase != phase) return;
      in_it = command.phase == phase;
      last = machine.respond(command);
      program.next(last);
    }
  }
};

Method knot_method(const std::string& knot, std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(),
                  {"specimen.knot=" + knot, "physics.accuracy=draft", "program.pull.until.extension=0.02"});
  return load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/knot.yaml", settings);
}

std::vector<PulledEnd> pulled_ends(const Method& method) {
  const Centreline rod = specimen_centreline(method.specimen, method.material, method.machine, method.physics);
  std::vector<PulledEnd> out;
  for (const std::vector<PulledEnd>& together : rod.pull_groups)
    out.insert(out.end(), together.begin(), together.end());
  return out;
}

/// A reef knot whose upper end is pulled, too, and whose lower tail is pulled twice.
Method dressed_reef() {
  Method method = knot_method("reef");
  KnotDrawing drawing = *method.specimen.drawing;
  drawing.tie = {{{"lower_tail", 1.0}, {"upper_tail", 0.6}}, {{"upper", 0.8}, {"lower_tail", 0.5}}};
  method.specimen.drawing = std::make_shared<const KnotDrawing>(drawing);
  return method;
}

/// Tension of the edge at a free end.
double tension_at(const TestingMachine& machine, int node) {
  const Eigen::VectorXd tension = machine.tension();
  const auto edge = [&](int j) { return machine.rod().is_cut(j) ? 0.0 : tension[j]; };
  return std::max(node > 0 ? edge(node - 1) : 0.0, node < tension.size() ? edge(node) : 0.0);
}

TEST(TiedByEnds, EachFreeEndIsPulledToItsPartOfThePreload) {
  Method method = knot_method("reef");
  KnotDrawing drawing = *method.specimen.drawing;
  drawing.tie = {{{"lower_tail", 1.0}}, {{"upper_tail", 0.5}}};
  method.specimen.drawing = std::make_shared<const KnotDrawing>(drawing);
  Bench bench(method);
  bench.run_past(Phase::kTie);
  for (const PulledEnd& end : pulled_ends(method)) {
    const double load = end.fraction * *method.specimen.preload;
    // A grip slips at 0.999 of its load; at rest the drag holds less than a thousandth back.
    EXPECT_NEAR(tension_at(bench.machine, end.node), load, 3e-3 * load);
  }
  bench.run_past(Phase::kRelease);
  for (const PulledEnd& end : pulled_ends(method))
    EXPECT_NEAR(tension_at(bench.machine, end.node), 0.0, 1e-3 * *method.specimen.preload);
}

TEST(TiedByEnds, AnEndOfTheUpperGripSlipsAtItsPartAndIsHeldWhereItIsOnceItIsLetGo) {
  const Method method = dressed_reef();
  Bench bench(method);
  const double drawn = bench.machine.upper_grip()[2], preload = *method.specimen.preload;
  bench.run_past(Phase::kTie);
  const double tied = bench.machine.upper_grip()[2];
  EXPECT_GT(tied, drawn);
  EXPECT_EQ(bench.last.extension, 0.0);
  EXPECT_NEAR(bench.last.end_to_end, (bench.machine.upper_grip() - bench.machine.lower_grip()).norm(), 1e-12);
  // A grip slips at 0.999 of its load; at rest the drag holds less than a thousandth back.
  EXPECT_NEAR(bench.last.force_upper, 0.8 * preload, 3e-3 * preload);
  const std::vector<PulledEnd> ends = pulled_ends(method);
  EXPECT_NEAR(tension_at(bench.machine, ends[0].node), 0.5 * preload, 3e-3 * preload);
  EXPECT_NEAR(tension_at(bench.machine, ends[1].node), 0.6 * preload, 3e-3 * preload);
  EXPECT_NEAR(tension_at(bench.machine, ends[2].node), 0.8 * preload, 3e-3 * preload);
  bench.run_past(Phase::kRelease);
  EXPECT_LT(bench.machine.upper_grip()[2], tied);
  EXPECT_EQ(bench.last.extension, 0.0);
  // What is left is what the rod's guides and its creep to rest bear.
  EXPECT_NEAR(bench.last.force_upper, 0.0, 1e-3 * preload);
  const double held = bench.machine.upper_grip()[2];
  bench.run_past(Phase::kPull);
  EXPECT_NEAR(bench.machine.upper_grip()[2] - held, bench.last.displacement, 1e-12);
  EXPECT_GT(bench.last.force_upper, 0.0);
}

TEST(TiedByEnds, ReadsHowMuchOfEachFreeEndIsLeft) {
  const Method method = knot_method("grief");
  Bench bench(method);
  bench.run_past(Phase::kRelease);
  const PerKnot tied = bench.last.tail_length;
  ASSERT_EQ(tied.size(), 2u);
  for (const double length : tied) EXPECT_GT(length, 0.8 * method.specimen.tail);
  bench.run_past(Phase::kPull);
  // Both ropes run through a knot that slips: the crosshead's way comes out of the tails, but for what the knot still
  // takes up.
  const double slipped = tied[0] - bench.last.tail_length[0] + tied[1] - bench.last.tail_length[1];
  EXPECT_GT(slipped, 0.25 * 0.02);
  EXPECT_LT(slipped, 2.0 * 0.02);
  EXPECT_EQ(bench.last.excess_length.size(), 0u) << "two ropes";
}

/// How far from its free end a rope of one strand first comes near to itself, whatever lies between it and a post.
double tail_by_places(const TestingMachine& machine, double radius) {
  const Points& position = machine.state().position;
  const Eigen::VectorXd at = machine.rod().arclength();
  const Eigen::Index last = at.size() - 1;
  for (Eigen::Index i = last; i >= 0; --i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (at[i] - at[j] > 1.5 * M_PI * radius && (position.col(i) - position.col(j)).norm() < 2.2 * radius)
        return at[last] - at[i];
  return PerKnot::kUnknown;
}

/// The post bears most where the load comes in: of a round turn, a twentieth with its force is 20 radii further on.
TEST(TiedByEnds, TheTailOfAHitchEndsWhereTheRopeComesUponItself) {
  for (const char* knot : {"clove_hitch", "round_turn"}) {
    Bench bench(knot_method(knot));
    const double h = bench.method.material.radius;
    bench.run_past(Phase::kRelease);
    // It presses a few radii further on than where it comes near.
    EXPECT_NEAR(bench.last.tail_length[0], tail_by_places(bench.machine, h), 5.0 * h) << knot;
    bench.run_past(Phase::kPull);
    EXPECT_NEAR(bench.last.tail_length[0], tail_by_places(bench.machine, h), 5.0 * h) << knot;
  }
}

/// Contacts that roll have less memory of how a knot was tied.
void roll_freely(Method* method) {
  method->material.rolling_resistance = 0.0;
  method->material.twisting_stiffness = method->material.bending_stiffness;
}

/// Of the rod between the first touches from either end of an overhand, as much is lost as the ends gain beyond how
/// much they stretch, but for how much shorter the knot becomes along the load axis as it tightens. That is little
/// where strands roll freely.
TEST(TiedByEnds, ARopeIsReadToLoseInTheKnotWhatItsEndsGain) {
  Method method = knot_method("overhand_tied");
  roll_freely(&method);
  KnotDrawing drawing = *method.specimen.drawing;
  drawing.landmarks = {{"lower", 0, 0}, {"upper", 0, drawing.strands[0].points.size() - 1}};
  drawing.readings = {{"knot", KnotReading::Kind::kBetween, 0, 1}, {"ends", KnotReading::Kind::kDistance, 0, 1}};
  method.specimen.drawing = std::make_shared<const KnotDrawing>(drawing);
  Bench bench(method);
  bench.run_past(Phase::kRelease);
  const Sample first = bench.last;
  bench.run_past(Phase::kPull);
  ASSERT_EQ(first.knot_readings.size(), 2u);
  const Sample& last = bench.last;
  const double stretch = last.force_upper / method.material.stretching_stiffness * last.end_to_end,
               gained = last.end_to_end - first.end_to_end - stretch,
               lost = first.knot_readings[0] - last.knot_readings[0];
  EXPECT_GT(gained, 0.015);
  EXPECT_NEAR(lost, gained, 0.2 * method.material.radius);
  // An answer is read, and no time step before it.
  const std::vector<Sample>& steps = bench.machine.substeps();
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) EXPECT_EQ(steps[i].knot_readings.size(), 0u);
}

/// Tight knots are alike in all ropes that are hardly flattened: an overhand takes 10.1 diameters, a figure-eight 13.7.
TEST(KnotInLine, TakesUpTheRopeBeyondTheDistanceOfTheGrips) {
  for (const auto& [knot, diameters] : {std::pair("overhand_tied", 10.1), std::pair("figure_eight", 13.7)}) {
    Bench bench(knot_method(knot, {"program.pull.until.extension=0.03"}));
    bench.run_past(Phase::kPull);
    const Points& x = bench.machine.state().position;
    double length = 0.0;
    for (Eigen::Index i = 1; i < x.cols(); ++i) length += (x.col(i) - x.col(i - 1)).norm();
    ASSERT_EQ(bench.last.excess_length.size(), 1u) << knot;
    const double found = bench.last.excess_length[0], diameter = 2.0 * bench.method.material.radius;
    EXPECT_NEAR(found, length - (x.rightCols(1) - x.leftCols(1)).norm(), 1e-9) << knot;
    EXPECT_NEAR(found, diameters * diameter, 0.1 * diameter) << knot;
  }
}

void expect_the_same_bits_from_a_saved_state(const Method& method, int commands) {
  Bench bench(method);
  for (int i = 0; i < commands; ++i)
    bench.last = bench.machine.respond(bench.program.last()), bench.program.next(bench.last);
  Archive saved("test");
  saved(bench.machine);
  Bench other(method);
  Archive loaded("test", saved.bytes(), "here");
  loaded(other.machine);
  other.program = bench.program;
  for (int i = 0; i < 20 && !bench.program.ended(); ++i) {
    const Command command = bench.program.last();
    bench.last = bench.machine.respond(command);
    EXPECT_EQ(other.machine.respond(command).grip_work, bench.last.grip_work);
    bench.program.next(bench.last);
  }
  EXPECT_EQ(other.machine.state().position, bench.machine.state().position);
}

TEST(TiedByEnds, GoesOnToTheSameBitsFromASavedState) {
  expect_the_same_bits_from_a_saved_state(knot_method("grief"), 20);
  // While the upper end slips, and once it is held again.
  const Method method = dressed_reef();
  Bench bench(method);
  bench.run_past(Phase::kTie);
  const int tied = static_cast<int>(bench.program.last().sequence);
  bench.run_past(Phase::kRelease);
  const int released = static_cast<int>(bench.program.last().sequence);
  for (const int commands : {tied - 10, tied + 1, released + 1})
    expect_the_same_bits_from_a_saved_state(method, commands);
}

/// The same knot upside down, whose posts are those of the other grip.
Method upside_down(const Method& method) {
  KnotDrawing drawing = *method.specimen.drawing;
  for (KnotDrawing::Strand& strand : drawing.strands)
    for (Vec3& point : strand.points) point.tail<2>() *= -1.0;
  for (KnotDrawing::Post& post : drawing.posts) {
    post.through.tail<2>() *= -1.0;
    post.upper = !post.upper;
  }
  std::swap(drawing.lower, drawing.upper);
  Method out = method;
  out.specimen.drawing = std::make_shared<const KnotDrawing>(drawing);
  return out;
}

TEST(TiedByEnds, APinThatMovesPullsAsAPostThatStandsStill) {
  Method bowline = knot_method("bowline");
  roll_freely(&bowline);
  Bench still(bowline), moves(upside_down(bowline));
  for (Bench* bench : {&still, &moves}) bench->run_past(Phase::kPull);
  ASSERT_EQ(moves.last.status, BenchStatus::kRunning) << moves.last.message;
  const double load = still.last.force_upper;
  ASSERT_GT(load, 0.0);
  // The forces of both grips may differ by the drag and the inertia of what moves, as they do in either test.
  const double apart = 2.0 * std::max(std::abs(load - still.last.force_lower), 1e-3 * load);
  EXPECT_NEAR(moves.last.force_upper, load, apart);
  EXPECT_NEAR(moves.last.force_lower, load, apart);
  EXPECT_NEAR(moves.last.end_to_end, still.last.end_to_end, 1e-12);
  EXPECT_NEAR(moves.last.extension, still.last.extension, 1e-12);
}

/// A strand that lies half around a post, in the plane across its axis.
Method around(const KnotDrawing::Post& post) {
  Method method = knot_method("bowline");
  KnotDrawing drawing = *method.specimen.drawing;
  drawing.strands.front().points = {{-6.6, 0.0, 14.0}, {-6.6, 0.0, 11.0}, {-6.6, 0.0, 0.0}, {-4.7, 0.0, -4.7},
                                    {0.0, 0.0, -6.6},  {4.7, 0.0, -4.7},  {6.6, 0.0, 0.0},  {6.6, 0.0, 9.0}};
  drawing.posts = {post};
  drawing.landmarks.clear();
  drawing.readings.clear();
  method.specimen.drawing = std::make_shared<const KnotDrawing>(drawing);
  return method;
}

TEST(Ring, BearsAStrandInAPlaneThroughItsAxisAsAPost) {
  KnotDrawing::Post post, ring;
  post.radius = ring.radius = 5.0;
  ring.ring = 20.0;
  ring.through = Vec3(-ring.ring, 0.0, 0.0);
  ring.along = Vec3::UnitZ();
  Bench on_post(around(post)), on_ring(around(ring));
  for (Bench* bench : {&on_post, &on_ring}) bench->run_past(Phase::kTie);
  const double load = on_post.last.force_upper;
  ASSERT_GT(on_post.last.force_lower, 1.2 * *on_post.method.specimen.preload) << "it bears both of its ends";
  // Both take the same steps, which differ by rounding; Newton's method leaves as much as its tolerance allows.
  EXPECT_NEAR(on_ring.last.force_upper, load, 1e-6 * load);
  EXPECT_NEAR(on_ring.last.force_lower, on_post.last.force_lower, 1e-6 * load);
}

/// The tail of an overhand whose contacts roll slides out of its knot in nylon, before a hole that holds a figure-eight
/// knot.
TEST(Stopper, OfAFigureEightHoldsMoreThanThatOfAnOverhand) {
  const auto load = [](const std::string& knot) {
    Bench bench(load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/knot.yaml",
                            {"specimen.knot=" + knot, "physics.accuracy=draft", "program.pull.until.extension=0.04",
                             "material.rolling_resistance=0", "material.twisting_stiffness=4.31e-5"}));
    bench.run_past(Phase::kPull);
    const Sample& last = bench.last;
    EXPECT_EQ(last.status, BenchStatus::kRunning) << last.message;
    EXPECT_NEAR(last.force_lower, last.force_upper, 0.05 * last.force_upper) << "the ring bears all of it";
    return last.force_upper;
  };
  EXPECT_GT(load("figure_eight_stopper"), 5.0 * load("overhand_stopper"));
}

TEST(TiedByEnds, AWeightHangsOnAnEndFromItsReleaseOn) {
  Method method = knot_method("bowline");
  KnotDrawing drawing = *method.specimen.drawing;
  drawing.landmarks = {{"loop", 0, 5}};
  drawing.weights = {{"tail", 0.05}, {"loop", 0.02}};
  method.specimen.drawing = std::make_shared<const KnotDrawing>(drawing);
  Bench bench(method);
  const Centreline rod = specimen_centreline(method.specimen, method.material, method.machine, method.physics);
  ASSERT_EQ(rod.weights.size(), 2u);
  EXPECT_GT(rod.weights[1].node, 0);
  const int tail = rod.weights.front().node;
  const double preload = *method.specimen.preload, weight = 0.05 * preload;
  bench.run_past(Phase::kTie);
  EXPECT_NEAR(tension_at(bench.machine, tail), preload, 3e-3 * preload) << "it does not help to tie";
  bench.run_past(Phase::kRelease);
  // At rest, by as much as the drag holds back.
  EXPECT_NEAR(tension_at(bench.machine, tail), weight, 1e-3 * preload);
  EXPECT_NEAR(bench.last.force_lower, bench.last.force_upper, 1e-3 * preload) << "the lower grip's includes it";
}

}  // namespace
}  // namespace knot_utm
