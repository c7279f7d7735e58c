#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <limits>

#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {

/// A number for each knot of a specimen, or for each of its free ends, in the order from the rod's first node, or for
/// each reading that a knot's file asks for, in its order; none where there is none. The numbers are stored in place,
/// because a sample is made after every time step and must not allocate.
class PerKnot {
 public:
  static constexpr std::size_t kMost = 4;  ///< knots, free ends or readings of a specimen
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  PerKnot() = default;
  /// Throws std::length_error where there are more than kMost.
  PerKnot(std::initializer_list<double> values);

  /// As many numbers as there are `knots`, each kUnknown. Throws as above.
  static PerKnot unknown(std::size_t knots);
  /// A copy of any list of doubles. Throws as above.
  template <typename List>
  static PerKnot of(const List& values) {
    PerKnot out = unknown(values.size());
    std::size_t k = 0;
    for (const double value : values) out[k++] = value;
    return out;
  }

  std::size_t size() const { return size_; }
  /// k below size().
  double& operator[](std::size_t k) {
    assert(k < size_);
    return values_[k];
  }
  double operator[](std::size_t k) const { return at(k); }
  /// k below kMost: kUnknown where there is no such knot.
  double at(std::size_t k) const { return values_[k]; }
  const double* begin() const { return values_.data(); }
  const double* end() const { return values_.data() + size_; }

  void state(Archive& archive);

 private:
  std::size_t size_ = 0;
  std::array<double, kMost> values_{kUnknown, kUnknown, kUnknown, kUnknown};
};

}  // namespace knot_utm
