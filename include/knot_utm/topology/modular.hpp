#pragma once

#include <cstdint>
#include <vector>

/// Integers modulo the Mersenne prime 2^61 - 1.
namespace knot_utm::modular {

constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;

std::uint64_t add(std::uint64_t a, std::uint64_t b);
std::uint64_t subtract(std::uint64_t a, std::uint64_t b);
std::uint64_t multiply(std::uint64_t a, std::uint64_t b);
std::uint64_t inverse(std::uint64_t a);

/// A nonzero element of a sparse row.
struct Entry {
  std::size_t column;
  std::uint64_t value;
};
using Row = std::vector<Entry>;  ///< columns ascend; no value is zero

/// Determinant of a square matrix given by sparse rows. Fast where the entries lie near a diagonal; the order of the
/// rows does not matter.
std::uint64_t determinant(std::vector<Row> rows);

/// Coefficients of the polynomial of degree below values.size() with value values[i] at t = i + 1.
std::vector<std::uint64_t> interpolate(std::vector<std::uint64_t> values);

}  // namespace knot_utm::modular
