#include "knot_utm/solver/block_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "knot_utm/solver/elimination_sets.hpp"
#include "knot_utm/solver/neighbours.hpp"
#include "knot_utm/solver/newton.hpp"
#include "knot_utm/solver/sorting_set.hpp"

namespace knot_utm {
namespace {

/// Of the coupled nodes (i, j), i != j, in any order and number.
Neighbours coupled(int nodes, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<std::set<int>> rows(static_cast<std::size_t>(nodes));
  for (const auto& [i, j] : pairs) {
    rows[static_cast<std::size_t>(i)].insert(j);
    rows[static_cast<std::size_t>(j)].insert(i);
  }
  Neighbours out;
  for (const std::set<int>& row : rows) {
    out.list.insert(out.list.end(), row.begin(), row.end());
    out.begin.push_back(static_cast<int>(out.list.size()));
  }
  return out;
}

template <typename T>
class BlockMatrixTest : public testing::Test {};
using Sizes = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(BlockMatrixTest, Sizes);

/// Band of a rod and random couplings between far nodes, unsymmetric values, dominant diagonal.
template <int D>
struct Example {
  static constexpr int kNodes = 40;
  BlockPattern pattern;
  BlockMatrix<D> matrix;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(D * kNodes, D* kNodes);

  Example() {
    std::mt19937 random(7);
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i < kNodes; ++i)
      for (int j = i + 1; j < std::min(i + 3, kNodes); ++j) pairs.push_back({i, j});
    for (int n = 0; n < 12; ++n) {
      const int i = static_cast<int>(random() % kNodes), j = static_cast<int>(random() % kNodes);
      if (i != j) pairs.push_back({i, j});
    }
    pattern.build(coupled(kNodes, pairs));
    matrix.set_pattern(pattern);
    for (int block = 0; block < pattern.blocks(); ++block) matrix.block(block).set_zero();
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    auto fill = [&](int i, int j, double diagonal) {
      Block<D>& block = matrix.block(pattern.index(i, j));
      for (int r = 0; r < D; ++r)
        for (int c = 0; c < D; ++c) {
          block.at(r, c) = value(random) + (r == c ? diagonal : 0.0);
          dense(D * i + r, D * j + c) = block(r, c);
        }
    };
    for (int i = 0; i < kNodes; ++i) fill(i, i, 20.0);
    for (const auto& [i, j] : pairs) {
      fill(i, j, 0.0);
      fill(j, i, 0.0);
    }
  }

  typename BlockMatrix<D>::Vector lanes(const Eigen::VectorXd& v) const {
    typename BlockMatrix<D>::Vector out(kNodes, Lanes{0.0, 0.0, 0.0, 0.0});
    for (int i = 0; i < kNodes; ++i)
      for (int r = 0; r < D; ++r) out[static_cast<std::size_t>(i)][r] = v[D * i + r];
    return out;
  }
  Eigen::VectorXd vector(const typename BlockMatrix<D>::Vector& v) const {
    Eigen::VectorXd out(D * kNodes);
    for (int i = 0; i < kNodes; ++i)
      for (int r = 0; r < D; ++r) out[D * i + r] = v[static_cast<std::size_t>(i)][r];
    return out;
  }
};

/// The pattern of L + U in elimination order by eliminating a full matrix of flags.
std::vector<std::vector<bool>> eliminated(const BlockPattern& pattern, const std::vector<std::pair<int, int>>& pairs) {
  const std::size_t nodes = static_cast<std::size_t>(pattern.nodes());
  std::vector<std::vector<bool>> filled(nodes, std::vector<bool>(nodes, false));
  for (const auto& [i, j] : pairs) {
    const auto p = static_cast<std::size_t>(pattern.position(i)), q = static_cast<std::size_t>(pattern.position(j));
    filled[p][q] = filled[q][p] = true;
  }
  for (std::size_t k = 0; k < nodes; ++k)
    for (std::size_t i = k + 1; i < nodes; ++i)
      for (std::size_t j = k + 1; j < nodes; ++j)
        if (i != j && filled[i][k] && filled[k][j]) filled[i][j] = true;
  return filled;
}

/// Every list of the pattern against flags of what elimination fills. Stored indices run along the pivots: the diagonal
/// block, then the lower and upper one of every row.
void expect_pattern_of(const std::vector<std::vector<bool>>& filled, const BlockPattern& pattern) {
  const int nodes = pattern.nodes();
  std::vector<std::vector<int>> stored(filled.size(), std::vector<int>(filled.size(), -1));
  std::vector<std::vector<int>> rows(filled.size()), lower(filled.size());
  int blocks = 0;
  for (std::size_t k = 0; k < filled.size(); ++k) {
    stored[k][k] = blocks++;
    for (std::size_t row = k + 1; row < filled.size(); ++row) {
      if (!filled[row][k]) continue;
      rows[k].push_back(static_cast<int>(row));
      lower[row].push_back(blocks);
      stored[row][k] = blocks++;
      stored[k][row] = blocks++;
    }
  }
  EXPECT_EQ(pattern.blocks(), blocks);
  for (int k = 0; k < nodes; ++k) {
    const std::vector<int>& expected = rows[static_cast<std::size_t>(k)];
    ASSERT_EQ(std::vector<int>(pattern.rows(k), pattern.rows(k) + pattern.below(k)), expected);
    std::vector<int> found(pattern.lower_begin(k), pattern.lower_end(k));
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, lower[static_cast<std::size_t>(k)]);
    const int* target = pattern.targets(k);
    for (const int row : expected)
      for (const int column : expected)
        EXPECT_EQ(*target++, stored[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]);
  }
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j) {
      const auto p = static_cast<std::size_t>(pattern.position(i)), q = static_cast<std::size_t>(pattern.position(j));
      EXPECT_EQ(pattern.indices(i, j), std::make_pair(stored[p][q], stored[q][p]));
    }
}

TEST(BlockPattern, IsThatOfEliminatingAFullMatrix) {
  std::mt19937 random(3);
  BlockPattern pattern;
  for (const int nodes : {1, 2, 3, 17, 60, 35}) {
    for (const int couplings : {0, 5, 40}) {
      std::vector<std::pair<int, int>> pairs;
      for (int i = 0; i < nodes; ++i)
        for (int j = i + 1; j < std::min(i + 3, nodes); ++j) pairs.push_back({i, j});
      // Contacts come as patches, and with them many pairs more than once.
      for (int n = 0; n < couplings; ++n) {
        const int i = static_cast<int>(random() % 1000) % nodes, j = static_cast<int>(random() % 1000) % nodes;
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) {
            const int a = (i + k) % nodes, b = (j + l) % nodes;
            if (a != b) pairs.push_back({a, b});
          }
      }
      std::shuffle(pairs.begin(), pairs.end(), random);
      pattern.build(coupled(nodes, pairs));
      expect_pattern_of(eliminated(pattern, pairs), pattern);
    }
  }
}

TYPED_TEST(BlockMatrixTest, MultipliesAsDenseDoes) {
  constexpr int D = TypeParam::value;
  Example<D> example;
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(D * Example<D>::kNodes, -1.0, 2.0);
  typename BlockMatrix<D>::Vector y;
  example.matrix.multiply(example.lanes(x), y);
  EXPECT_LT((example.vector(y) - example.dense * x).norm(), 1e-12);
}

/// All rows of a node, or some of them.
TYPED_TEST(BlockMatrixTest, AnIdentityRowPrescribesItsUnknown) {
  constexpr int D = TypeParam::value;
  Example<D> example;
  const Lanes none = {0.0, 0.0, 0.0, 0.0}, some = {0.0, 1.0, 0.0, 1.0};
  for (const auto& [node, keep] : {std::pair(0, none), std::pair(17, some), std::pair(39, some)}) {
    if (keep[1] > 0.0)
      example.matrix.set_identity_row(node, keep);
    else
      example.matrix.set_identity_row(node);
    for (int row = 0; row < D; ++row) {
      if (keep[row] > 0.0) continue;
      example.dense.row(D * node + row).setZero();
      example.dense(D * node + row, D * node + row) = 1.0;
    }
  }
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(D * Example<D>::kNodes, -1.0, 2.0);
  auto x = example.lanes(b);
  ASSERT_TRUE(example.matrix.solve(x));
  EXPECT_LT((example.vector(x) - example.dense.partialPivLu().solve(b)).norm(), 1e-13);
}

TYPED_TEST(BlockMatrixTest, ASingularPivotIsReported) {
  constexpr int D = TypeParam::value;
  BlockPattern pattern;
  pattern.build(coupled(3, {{0, 1}}));
  BlockMatrix<D> matrix;
  matrix.set_pattern(pattern);
  for (int block = 0; block < pattern.blocks(); ++block) matrix.block(block).set_zero();
  typename BlockMatrix<D>::Vector b(3, Lanes{1.0, 1.0, 1.0, 0.0});
  EXPECT_FALSE(matrix.solve(b));
}

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
