#include "knot_utm/topology/modular.hpp"

#include <algorithm>
#include <utility>

namespace knot_utm::modular {

namespace {

__extension__ using Wide = unsigned __int128;

/// a + factor b, of rows
void add_multiple(const Row& a, std::uint64_t factor, const Row& b, Row& sum) {
  sum.clear();
  auto p = a.begin(), q = b.begin();
  while (p != a.end() || q != b.end()) {
    if (q == b.end() || (p != a.end() && p->column < q->column)) {
      sum.push_back(*p++);
    } else if (p == a.end() || q->column < p->column) {
      sum.push_back({q->column, multiply(factor, q->value)});
      ++q;
    } else {
      const std::uint64_t value = add(p->value, multiply(factor, q->value));
      if (value != 0) sum.push_back({p->column, value});
      ++p;
      ++q;
    }
  }
}

/// Whether the permutation that puts these numbers, 0 to n - 1, in order is odd.
bool odd(std::vector<std::size_t> numbers) {
  bool result = false;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (; numbers[i] != i; result = !result) std::swap(numbers[i], numbers[numbers[i]]);
  return result;
}

}  // namespace

std::uint64_t add(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t sum = a + b;
  return sum >= kPrime ? sum - kPrime : sum;
}

std::uint64_t subtract(std::uint64_t a, std::uint64_t b) { return a >= b ? a - b : a + kPrime - b; }

std::uint64_t multiply(std::uint64_t a, std::uint64_t b) {
  const Wide product = static_cast<Wide>(a) * b;
  return add(static_cast<std::uint64_t>(product & kPrime), static_cast<std::uint64_t>(product >> 61));
}

std::uint64_t inverse(std::uint64_t a) {
  std::uint64_t result = 1;
  for (std::uint64_t exponent = kPrime - 2; exponent > 0; exponent >>= 1) {
    if (exponent & 1) result = multiply(result, a);
    a = multiply(a, a);
  }
  return result;
}

std::uint64_t determinant(std::vector<Row> rows) {
  const std::size_t n = rows.size();
  std::vector<std::vector<std::size_t>> led_by(n);  // rows that begin in a column
  for (std::size_t i = 0; i < n; ++i) {
    if (rows[i].empty()) return 0;
    led_by[rows[i].front().column].push_back(i);
  }
  std::uint64_t result = 1;
  std::vector<std::size_t> pivots;
  Row sum;
  for (std::size_t column = 0; column < n; ++column) {
    const std::vector<std::size_t>& led = led_by[column];
    if (led.empty()) return 0;
    // The shortest row causes the least fill-in.
    const std::size_t pivot = *std::min_element(
        led.begin(), led.end(), [&](std::size_t a, std::size_t b) { return rows[a].size() < rows[b].size(); });
    pivots.push_back(pivot);
    const std::uint64_t value = rows[pivot].front().value;
    result = multiply(result, value);
    if (led.size() == 1) continue;
    const std::uint64_t scale = subtract(0, inverse(value));
    for (const std::size_t row : led) {
      if (row == pivot) continue;
      add_multiple(rows[row], multiply(rows[row].front().value, scale), rows[pivot], sum);
      if (sum.empty()) return 0;
      rows[row].swap(sum);
      led_by[rows[row].front().column].push_back(row);
    }
  }
  return odd(std::move(pivots)) ? subtract(0, result) : result;
}

std::vector<std::uint64_t> interpolate(std::vector<std::uint64_t> values) {
  const std::size_t n = values.size();
  for (std::size_t order = 1; order < n; ++order) {
    const std::uint64_t scale = inverse(order);  // the places are `order` apart
    for (std::size_t i = n - 1; i >= order; --i) values[i] = multiply(subtract(values[i], values[i - 1]), scale);
  }
  std::vector<std::uint64_t> result(n, 0);
  for (std::size_t i = n; i-- > 0;) {
    // result = result * (t - (i + 1)) + values[i]
    for (std::size_t k = n - 1; k > 0; --k)
      result[k] = subtract(result[k - 1], multiply(result[k], static_cast<std::uint64_t>(i + 1)));
    result[0] = subtract(values[i], multiply(result[0], static_cast<std::uint64_t>(i + 1)));
  }
  return result;
}

}  // namespace knot_utm::modular
