#pragma once

namespace knot_utm {

/// Four numbers in two registers of two each, for processors whose registers are no wider (SSE2, NEON). Left to itself,
/// the compiler would send a vector of four through memory, number by number. Every lane gets the same operations in
/// the same order as it does in one register of four. A half is a pair of doubles, or of masks.
template <typename Half, typename Number>
class InTwo {
 public:
  using Bits = long long __attribute__((vector_size(16)));
  using Mask = InTwo<Bits, long long>;

  InTwo() = default;
  constexpr InTwo(Number a, Number b, Number c, Number d) : low_{a, b}, high_{c, d} {}
  constexpr InTwo(const Half& low, const Half& high) : low_(low), high_(high) {}
  // A single number stands for four equal ones, as it does for the compiler's own vectors.
  constexpr InTwo(Number all) : low_{all, all}, high_{all, all} {}  // NOLINT(google-explicit-constructor)

  const Half& low() const { return low_; }
  const Half& high() const { return high_; }

  template <typename Index>
  Number operator[](Index i) const {
    return i < Index{2} ? low_[i] : high_[i - Index{2}];
  }
  template <typename Index>
  Number& operator[](Index i) {
    return reinterpret_cast<Number*>(this)[i];
  }

  InTwo operator-() const { return {-low_, -high_}; }
  InTwo operator~() const { return {~low_, ~high_}; }

  friend InTwo operator+(const InTwo& a, const InTwo& b) { return {a.low_ + b.low_, a.high_ + b.high_}; }
  friend InTwo operator-(const InTwo& a, const InTwo& b) { return {a.low_ - b.low_, a.high_ - b.high_}; }
  friend InTwo operator*(const InTwo& a, const InTwo& b) { return {a.low_ * b.low_, a.high_ * b.high_}; }
  friend InTwo operator/(const InTwo& a, const InTwo& b) { return {a.low_ / b.low_, a.high_ / b.high_}; }
  friend InTwo operator&(const InTwo& a, const InTwo& b) { return {a.low_ & b.low_, a.high_ & b.high_}; }
  friend InTwo operator|(const InTwo& a, const InTwo& b) { return {a.low_ | b.low_, a.high_ | b.high_}; }
  friend Mask operator<(const InTwo& a, const InTwo& b) { return {a.low_ < b.low_, a.high_ < b.high_}; }
  friend Mask operator>(const InTwo& a, const InTwo& b) { return {a.low_ > b.low_, a.high_ > b.high_}; }
  friend Mask operator<=(const InTwo& a, const InTwo& b) { return {a.low_ <= b.low_, a.high_ <= b.high_}; }
  friend Mask operator>=(const InTwo& a, const InTwo& b) { return {a.low_ >= b.low_, a.high_ >= b.high_}; }

  InTwo& operator+=(const InTwo& o) { return *this = *this + o; }
  InTwo& operator-=(const InTwo& o) { return *this = *this - o; }
  InTwo& operator*=(const InTwo& o) { return *this = *this * o; }
  InTwo& operator&=(const InTwo& o) { return *this = *this & o; }
  InTwo& operator|=(const InTwo& o) { return *this = *this | o; }

 private:
  Half low_, high_;
};

using TwoDoubles = double __attribute__((vector_size(16)));
using LanesInTwo = InTwo<TwoDoubles, double>;
using LanesInTwoMask = LanesInTwo::Mask;

inline LanesInTwo select(const LanesInTwoMask& where, const LanesInTwo& a, const LanesInTwo& b) {
  using Bits = LanesInTwo::Bits;
  // By bits, because SSE2 has no instruction that selects.
  const auto half = [](const Bits& mask, const TwoDoubles& yes, const TwoDoubles& no) {
    return reinterpret_cast<TwoDoubles>((mask & reinterpret_cast<Bits>(yes)) | (~mask & reinterpret_cast<Bits>(no)));
  };
  return {half(where.low(), a.low(), b.low()), half(where.high(), a.high(), b.high())};
}

inline bool any(const LanesInTwoMask& where) {
  const LanesInTwo::Bits either = where.low() | where.high();
  return (either[0] | either[1]) != 0;
}

/// Rows of a 4 x 4 matrix become its columns.
inline void transpose(LanesInTwo& a, LanesInTwo& b, LanesInTwo& c, LanesInTwo& d) {
  const auto first = [](const TwoDoubles& p, const TwoDoubles& q) { return __builtin_shufflevector(p, q, 0, 2); };
  const auto second = [](const TwoDoubles& p, const TwoDoubles& q) { return __builtin_shufflevector(p, q, 1, 3); };
  const LanesInTwo a0 = a, b0 = b, c0 = c, d0 = d;
  a = {first(a0.low(), b0.low()), first(c0.low(), d0.low())};
  b = {second(a0.low(), b0.low()), second(c0.low(), d0.low())};
  c = {first(a0.high(), b0.high()), first(c0.high(), d0.high())};
  d = {second(a0.high(), b0.high()), second(c0.high(), d0.high())};
}

/// The last lane of `before`, then the first three lanes of `now`.
inline LanesInTwo one_later(const LanesInTwo& before, const LanesInTwo& now) {
  return {__builtin_shufflevector(before.high(), now.low(), 1, 2),
          __builtin_shufflevector(now.low(), now.high(), 1, 2)};
}

/// The last three lanes of `now`, then the first lane of `after`.
inline LanesInTwo one_earlier(const LanesInTwo& now, const LanesInTwo& after) {
  return {__builtin_shufflevector(now.low(), now.high(), 1, 2), __builtin_shufflevector(now.high(), after.low(), 1, 2)};
}

}  // namespace knot_utm
