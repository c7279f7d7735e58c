#include "knot_utm/record/per_knot.hpp"

#include <stdexcept>
#include <string>

namespace knot_utm {

PerKnot::PerKnot(std::initializer_list<double> values) : PerKnot(of(values)) {}

PerKnot PerKnot::unknown(std::size_t knots) {
  if (knots > kMost)
    throw std::length_error(std::to_string(knots) + " knots in a specimen, but it may have " + std::to_string(kMost));
  PerKnot out;
  out.size_ = knots;
  return out;
}

void PerKnot::state(Archive& archive) {
  int knots = static_cast<int>(size_);
  archive.number("knots", knots, 0, static_cast<int>(kMost));
  if (archive.loads()) *this = unknown(static_cast<std::size_t>(knots));
  for (std::size_t k = 0; k < size_; ++k) archive(values_[k]);
}

}  // namespace knot_utm
