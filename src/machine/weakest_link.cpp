#include "knot_utm/machine/weakest_link.hpp"

#include <cmath>

namespace knot_utm {

WeakestLink::WeakestLink(double modulus, double tested_length, double weaker_share)
    : modulus_(modulus), bears_(-std::log1p(-weaker_share) * tested_length), mean_(std::tgamma(1.0 + 1.0 / modulus)) {}

void WeakestLink::Sum::add(double fraction, double length) {
  if (fraction <= 0.0) return;
  if (fraction > largest_) {
    sum_ *= std::pow(largest_ / fraction, link_.modulus_);
    largest_ = fraction;
  }
  sum_ += std::pow(fraction / largest_, link_.modulus_) * length;
}

double WeakestLink::Sum::fraction() const {
  return largest_ * link_.mean_ * std::pow(sum_ / link_.bears_, 1.0 / link_.modulus_);
}

}  // namespace knot_utm
