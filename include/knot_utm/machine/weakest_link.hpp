#pragma once

#include <cmath>
#include <limits>

namespace knot_utm {

/// Scatter of strength by the length that is stressed. The probability that a rod has parted is
///
///   P = 1 - exp(-int (f/f_0)^m dl/l_t)
///
///   f    fraction of what parts a straight rod of length l_t in the mean [-]
///   f_0  1/Gamma(1 + 1/m), so that this mean is 1 [-]
///   m    `weibull_modulus` [-]; l_t  `tested_length` [m]
///
/// A specimen has its u = `weaker_share`, the share of all specimens that are weaker, and parts where P reaches u. It
/// is as near to that as says the fraction, which is of first degree in f,
///
///   F = Gamma(1 + 1/m) (sum_j f_j^m l_j/(l_t E))^(1/m),   E = -ln(1 - u)
///
/// The place is the edge of the largest f. With m = infinity, F is that f, and all specimens are alike. Source: Weibull
/// 1951.
class WeakestLink {
 public:
  WeakestLink() = default;
  WeakestLink(double modulus, double tested_length, double weaker_share)
      : modulus_(modulus),
        bears_(-std::log1p(-weaker_share) * tested_length),
        mean_(std::tgamma(1.0 + 1.0 / modulus)) {}

  /// Sums over the edges of a rod.
  class Sum {
   public:
    explicit Sum(const WeakestLink& link) : link_(link) {}
    /// f_j [-], l_j [m]
    void add(double fraction, double length) {
      if (fraction <= 0.0) return;
      if (fraction > largest_) {
        sum_ *= std::pow(largest_ / fraction, link_.modulus_);
        largest_ = fraction;
      }
      sum_ += std::pow(fraction / largest_, link_.modulus_) * length;
    }
    /// F [-]
    double fraction() const { return largest_ * link_.mean_ * std::pow(sum_ / link_.bears_, 1.0 / link_.modulus_); }

   private:
    const WeakestLink& link_;
    double largest_ = 0.0;  // f
    double sum_ = 0.0;      // of (f_j/largest)^m l_j, which does not overflow [m]
  };

 private:
  double modulus_ = std::numeric_limits<double>::infinity();
  double bears_ = 1.0;  // l_t E [m]
  double mean_ = 1.0;   // Gamma(1 + 1/m)
};

}  // namespace knot_utm
