#include "knot_utm/numeric/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "knot_utm/numeric/pieces.hpp"

namespace knot_utm {
namespace {

constexpr int kDraws = 100000;

/// Moments of the normal distribution are 0, 1, 0 and 3. The mean of n draws of z^k has the standard error
/// sqrt(var(z^k)/n), var being 1, 2, 15 and 96; five of them are exceeded once in a million.
TEST(Random, NormalNumbersHaveTheMomentsOfTheNormalDistribution) {
  std::mt19937_64 random(7);
  double sums[4] = {};
  for (int i = 0; i < kDraws; ++i) {
    const double z = standard_normal(random);
    for (int k = 0; k < 4; ++k) sums[k] += std::pow(z, k + 1);
  }
  const double moments[4] = {0.0, 1.0, 0.0, 3.0}, variances[4] = {1.0, 2.0, 15.0, 96.0};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(sums[k] / kDraws, moments[k], 5.0 * std::sqrt(variances[k] / kDraws)) << k;
}

/// Neighbouring seeds, numbers and names are no neighbours in what they give.
TEST(Random, SequencesOfDifferentSeedNumberOrNameAreUncorrelated) {
  const auto first = [](std::uint64_t seed, std::uint64_t number, const std::string& name) {
    std::mt19937_64 random = sequence_of(seed, number, name);
    return uniform(random) - 0.5;
  };
  double by_seed = 0.0, by_number = 0.0, by_name = 0.0, mean = 0.0;
  constexpr int kSequences = 20000;
  for (std::uint64_t i = 0; i < kSequences; ++i) {
    const double here = first(i, 1, "specimen.tail");
    mean += here;
    by_seed += here * first(i + 1, 1, "specimen.tail");
    by_number += here * first(i, 2, "specimen.tail");
    by_name += here * first(i, 1, "specimen.tai");
  }
  // A product of two independent numbers has the variance 1/144.
  const double five_errors = 5.0 / std::sqrt(144.0 * kSequences);
  for (const double product : {by_seed, by_number, by_name}) EXPECT_NEAR(product / kSequences, 0.0, five_errors);
  EXPECT_NEAR(mean / kSequences, 0.0, 5.0 / std::sqrt(12.0 * kSequences));
}

TEST(Pieces, LieBetweenTheMissingEdges) {
  const std::vector<Piece> pieces = pieces_between(10, {3, 4, 8});
  ASSERT_EQ(pieces.size(), 4u);
  const Eigen::Index begins[] = {0, 4, 5, 9}, ends[] = {4, 5, 9, 10};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i].begin, begins[i]);
    EXPECT_EQ(pieces[i].end, ends[i]);
  }
  EXPECT_EQ(pieces_between(10, {}).size(), 1u);
  EXPECT_EQ(pieces_between(10, {9, 12}).size(), 1u);
}

TEST(Pieces, AreAsLongAsTheirEdges) {
  Points points = Points::Zero(3, 5);
  points.row(1) << 0.0, 1.0, 3.0, 10.0, 10.5;
  EXPECT_EQ(length_of_pieces(points, {}), 10.5);
  EXPECT_EQ(length_of_pieces(points, {2}), 3.5);
  EXPECT_EQ(length_of_pieces(points, {0, 2}), 2.5);
}

}  // namespace
}  // namespace knot_utm
