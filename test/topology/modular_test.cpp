#include "knot_utm/topology/modular.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace knot_utm::modular {
namespace {

std::vector<Row> sparse(const std::vector<std::vector<std::uint64_t>>& matrix) {
  std::vector<Row> rows(matrix.size());
  for (std::size_t i = 0; i < matrix.size(); ++i)
    for (std::size_t j = 0; j < matrix.size(); ++j)
      if (matrix[i][j] != 0) rows[i].push_back({j, matrix[i][j]});
  return rows;
}

/// The sum over all permutations.
std::uint64_t leibniz(const std::vector<std::vector<std::uint64_t>>& matrix) {
  std::vector<std::size_t> columns(matrix.size());
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  std::uint64_t sum = 0;
  do {
    std::uint64_t product = 1;
    bool odd = false;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      product = multiply(product, matrix[i][columns[i]]);
      for (std::size_t j = 0; j < i; ++j) odd ^= columns[j] > columns[i];
    }
    sum = odd ? subtract(sum, product) : add(sum, product);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return sum;
}

TEST(ModularDeterminant, IsTheSumOverAllPermutations) {
  std::mt19937_64 random(5);
  for (int n = 0; n < 200; ++n) {
    const std::size_t size = 1 + random() % 7;
    // From mostly zeros, many of them singular, to full; small entries, so that differences vanish now and then.
    const std::uint64_t percent = 10 + random() % 91, largest = n % 2 == 0 ? 2 : kPrime - 1;
    std::vector<std::vector<std::uint64_t>> matrix(size, std::vector<std::uint64_t>(size, 0));
    for (auto& row : matrix)
      for (auto& value : row)
        if (random() % 100 < percent) value = 1 + random() % largest;
    EXPECT_EQ(determinant(sparse(matrix)), leibniz(matrix));
  }
}

TEST(ModularDeterminant, OfAThousandRowsInABandIsThatOfItsRecurrence) {
  // d_n = 3 d_{n-1} - 2 d_{n-2} of the tridiagonal matrix with 1, 3, 2 in its rows, in reversed order of rows.
  constexpr std::size_t kSize = 1000;
  std::vector<Row> rows;
  std::uint64_t before = 0, here = 1;
  for (std::size_t i = 0; i < kSize; ++i) {
    Row row;
    if (i > 0) row.push_back({i - 1, 1});
    row.push_back({i, 3});
    if (i + 1 < kSize) row.push_back({i + 1, 2});
    rows.insert(rows.begin(), row);
    const std::uint64_t next = subtract(multiply(3, here), multiply(2, before));
    before = here;
    here = next;
  }
  // Reversing 1000 rows takes 500 exchanges.
  EXPECT_EQ(determinant(rows), here);
}

TEST(ModularInterpolation, FindsThePolynomialOfItsValues) {
  const std::vector<std::uint64_t> coefficients = {7, kPrime - 3, 0, 11, 5};
  std::vector<std::uint64_t> values;
  for (std::uint64_t t = 1; t <= coefficients.size(); ++t) {
    std::uint64_t value = 0;
    for (std::size_t k = coefficients.size(); k-- > 0;) value = add(multiply(value, t), coefficients[k]);
    values.push_back(value);
  }
  EXPECT_EQ(interpolate(values), coefficients);
}

}  // namespace
}  // namespace knot_utm::modular
