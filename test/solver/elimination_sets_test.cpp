#include "knot_utm/solver/elimination_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "knot_utm/solver/block_matrix.hpp"
#include "knot_utm/solver/newton.hpp"
#include "knot_utm/solver/sorting_set.hpp"
#include "solver/coupled.hpp"

namespace knot_utm {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// A rod of `nodes`, with each of the `contacts` a patch of three by three nodes.
Pairs rod(int nodes, const Pairs& contacts) {
  Pairs pairs;
  for (int i = 0; i < nodes; ++i)
    for (int j = i + 1; j < std::min(i + 3, nodes); ++j) pairs.push_back({i, j});
  for (const auto& [a, b] : contacts)
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) pairs.push_back({a + k, b + l});
  return pairs;
}

/// The set of every node.
std::vector<int> sets_of(int nodes, const Pairs& pairs) {
  EliminationSets sets;
  sets.build(coupled(nodes, pairs));
  std::vector<int> found(static_cast<std::size_t>(nodes), -1);
  for (int set = 0; set < sets.count(); ++set) {
    EXPECT_LT(sets.begin(set), sets.end(set));
    for (const int* node = sets.begin(set); node != sets.end(set); ++node) {
      EXPECT_EQ(sets.of(*node), set);
      EXPECT_EQ(found[static_cast<std::size_t>(*node)], -1);
      found[static_cast<std::size_t>(*node)] = set;
    }
  }
  return found;
}

/// `runs` of the same number, one after the other: (how many, which).
std::vector<int> numbers(const Pairs& runs) {
  std::vector<int> out;
  for (const auto& [count, number] : runs) out.insert(out.end(), static_cast<std::size_t>(count), number);
  return out;
}

TEST(EliminationSets, KnotsInARowComeOneAfterTheOtherWithTheStraightsThatLeadToThem) {
  // Knots of nodes 10 to 22, 40 to 52 and 70 to 82.
  const Pairs pairs = rod(100, {{10, 20}, {40, 50}, {70, 80}});
  EXPECT_EQ(sets_of(100, pairs), numbers({{23, 0}, {30, 1}, {47, 2}}));
}

TEST(EliminationSets, OneFreeNodePartsNothingTwoDo) {
  EXPECT_EQ(sets_of(40, rod(40, {{5, 12}, {16, 25}})), numbers({{40, 0}}));
  EXPECT_EQ(sets_of(40, rod(40, {{5, 12}, {17, 25}})), numbers({{15, 0}, {25, 1}}));
}

TEST(EliminationSets, WhatHangsTogetherInARingIsTheLastSet) {
  // Two knots, 30 to 42 and 70 to 82, that touch each other are one; a third hangs on them.
  EXPECT_EQ(sets_of(120, rod(120, {{5, 12}, {30, 40}, {70, 80}, {35, 75}})), numbers({{15, 0}, {105, 1}}));
  // Two straights lead from the knot of 30 to 42 with 100 to 102 to that of 60 to 72.
  EXPECT_EQ(sets_of(120, rod(120, {{5, 12}, {30, 40}, {35, 100}, {60, 70}})), numbers({{15, 0}, {105, 1}}));
}

/// Blocks of the pattern of overhands in a row.
int blocks_of_row(int knots) {
  Pairs contacts;
  for (int knot = 0; knot < knots; ++knot) {
    contacts.push_back({100 * knot + 40, 100 * knot + 60});
    contacts.push_back({100 * knot + 43, 100 * knot + 55});
  }
  BlockPattern pattern;
  pattern.build(coupled(100 * knots, rod(100 * knots, contacts)));
  return pattern.blocks();
}

TEST(EliminationSets, FillGrowsAsTheKnotsInARowDo) {
  // Every knot passes two blocks more through itself than it does alone; straights cost what they do at the ends.
  EXPECT_LT(blocks_of_row(16), 1.1 * 16 * blocks_of_row(1));
}

TEST(SortingSet, AppendsWhatItWasGivenInAscendingOrder) {
  std::mt19937 random(5);
  SortingSet set;
  for (const int numbers : {1, 63, 64, 65, 300}) {
    set.reset(numbers);
    const auto any = [&] { return static_cast<int>(random() % static_cast<unsigned>(numbers)); };
    for (int round = 0; round < 50; ++round) {
      std::set<int> expected;
      for (int n = 0; n < round % 4; ++n) {
        const std::vector<int> several = {any(), any(), any()};
        set.insert(several.data(), several.data() + several.size(), [&](int i) { return numbers - 1 - i; });
        for (const int i : several) expected.insert(numbers - 1 - i);
        const int a = any(), b = any();
        set.insert_run(std::min(a, b), std::max(a, b));
        for (int i = std::min(a, b); i <= std::max(a, b); ++i) expected.insert(i);
        set.erase(a);
        expected.erase(a);
      }
      std::vector<int> list = {-7};
      set.take(list);
      std::vector<int> whole = {-7};
      whole.insert(whole.end(), expected.begin(), expected.end());
      EXPECT_EQ(list, whole);
    }
  }
}

/// One equation in one unknown.
struct Equation {
  double (*f)(double);
  double (*slope)(double);
  double x, change = 0.0, still = 0.0;

  double residual() const { return std::abs(f(x)); }
  double tolerance() const { return 1e-9; }
  bool solve() {
    change = -f(x) / slope(x);
    return std::isfinite(change);
  }
  void move(double factor) { x += factor * change; }
  bool stands_still() const { return std::abs(change) < still; }
};

/// |x|^(1/2) sign x: whole changes lead from x to -x for ever.
Equation circling() {
  return {[](double x) { return std::copysign(std::sqrt(std::abs(x)), x); },
          [](double x) { return 0.5 / std::sqrt(std::abs(x)); }, 1.0};
}

TEST(Newton, GivesUpWhereTheResidualDoesNotFall) {
  Equation equation = circling();
  const NewtonSummary summary = newton(equation, {40, 1.0, true});
  EXPECT_EQ(summary.end, NewtonSummary::End::kAbandonedEarly);
  EXPECT_EQ(summary.iterations, 4);
  EXPECT_STREQ(summary.reason(), "the residual did not fall");
}

TEST(Newton, HalfTheChangeBreaksACycle) {
  Equation equation = circling();
  const NewtonSummary summary = newton(equation, {40});
  EXPECT_TRUE(summary.converged()) << summary.reason();
  EXPECT_GT(summary.iterations, 4);
}

TEST(Newton, GivesNothingUpThatConvergesHoweverSlowly) {
  // A root of third order: each change takes a third off, and the residual falls to 8/27.
  Equation equation{[](double x) { return x * x * x; }, [](double x) { return 3.0 * x * x; }, 1.0};
  const NewtonSummary summary = newton(equation, {40, 1.0, true});
  EXPECT_TRUE(summary.converged()) << summary.reason();
}

TEST(Newton, ACycleNearTheToleranceIsNotGivenUp) {
  Equation equation = circling();
  equation.x = 4e-18;  // residual 2e-9, twice the tolerance
  EXPECT_TRUE(newton(equation, {40, 1.0, true}).converged());
}

TEST(Newton, TwoSidesOfAJumpThatAreNotApartAreASolution) {
  Equation equation{[](double x) { return x + std::copysign(1e-6, x); }, [](double) { return 1.0; }, 1.0};
  EXPECT_FALSE(newton(equation, {12}).converged());
  equation.x = 1.0;
  equation.still = 1e-5;
  const NewtonSummary summary = newton(equation, {12});
  EXPECT_TRUE(summary.converged());
  EXPECT_NEAR(equation.x, 0.0, 2e-6);
  EXPECT_GT(summary.residual, summary.tolerance) << "it says what is left";
}

}  // namespace
}  // namespace knot_utm
