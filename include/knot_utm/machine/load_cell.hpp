#pragma once

#include <optional>
#include <random>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/specimen/machine_options.hpp"

namespace knot_utm {

/// The load cell in the upper grip: its reading of the true force F, tension positive [N].
///
///     reading = round([(1 + g)(F - F_balance) + noise] / r) r
///
/// g, |g| <= accuracy, is the error of its gain, and r the resolution [N]. With default options the reading is F -
/// F_balance.
///
/// An accuracy class is a bound on the gain's error, so a cell draws g once, uniformly between the bounds. g and the
/// normally distributed noise follow from the seed and do not depend on each other; the noise also follows from the
/// number of the run. The n-th readings of two cells with the same seed and run have the same noise.
class LoadCell {
 public:
  explicit LoadCell(const LoadCellOptions& options);

  void balance(double true_force) { balanced_ = true_force; }  ///< from now on this force reads zero

  double offset() const { return balanced_; }  ///< F_balance [N]

  double balanced(double true_force) const { return true_force - balanced_; }  ///< the reading of a cell without errors

  double read(double true_force);  ///< one reading; the next one has other noise

  void state(Archive& archive);

 private:
  LoadCellOptions options_;
  double gain_ = 1.0;  ///< 1 + g
  double balanced_ = 0.0;
  std::mt19937_64 random_;
};

/// Largest error of a reading of the true force F by the cell's class [N]: accuracy |F|. Below the floor, where a class
/// only says that F is below it, it is floor * capacity. Nothing where the cell has neither.
std::optional<double> class_error(const LoadCellOptions& cell, double true_force);

/// F is below the cell's floor.
bool is_below_floor(const LoadCellOptions& cell, double true_force);

}  // namespace knot_utm
