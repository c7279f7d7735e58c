#pragma once

#include <random>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/rod/archive.hpp"

namespace knot_utm {

/// The load cell in the upper grip: what it makes of the true force on it. Tension is positive, forces in N.
///
/// reading = round((true force - balanced force + noise) / resolution) * resolution
///
/// The noise is normally distributed and follows from the seed alone: the n-th reading of two cells with the same
/// options has the same noise.
class LoadCell {
 public:
  /// Throws InvalidInput where a number is out of range.
  explicit LoadCell(const LoadCellOptions& options);

  void balance(double true_force) { balanced_ = true_force; }  ///< from now on this force reads zero

  double offset() const { return balanced_; }  ///< the true force that reads zero [N]

  double balanced(double true_force) const { return true_force - balanced_; }  ///< without noise and resolution

  double read(double true_force);  ///< one reading; the next one has other noise

  void state(Archive& archive);

 private:
  double normal();  ///< mean 0, standard deviation 1

  LoadCellOptions options_;
  double balanced_ = 0.0;
  std::mt19937_64 random_;
};

}  // namespace knot_utm
