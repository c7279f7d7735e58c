#pragma once

#include <optional>
#include <random>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {

/// The load cell in the upper grip: what it makes of the true force F on it, tension positive, in N.
///
///     reading = round([(1 + g)(F_s - F_balance) + d (t - t_balance) + noise] / r) r
///
/// F_s is F, but no further from zero than the cell's stop, overload * capacity; g, |g| <= accuracy, the error of its
/// gain; d the drift of its zero, t - t_balance [s] the time since it was balanced, or since the test began; r the
/// resolution. With the options as they are by default the reading is F - F_balance.
///
/// A class promises no more than a bound on the gain's error: a cell draws g once, uniformly between the bounds. g and
/// the normally distributed noise follow from the seed alone, neither depends on the other: the n-th reading of two
/// cells with the same seed has the same noise.
class LoadCell {
 public:
  /// Throws InvalidInput where a number is out of range.
  explicit LoadCell(const LoadCellOptions& options);

  void balance(double true_force, double time);  ///< from now on this force reads zero

  double offset() const { return balanced_; }  ///< F_balance [N]

  double balanced(double true_force) const { return true_force - balanced_; }  ///< as a cell without errors reads it

  double read(double true_force, double time);  ///< one reading; the next one has other noise

  void state(Archive& archive);

 private:

  LoadCellOptions options_;
  double gain_ = 1.0;  ///< 1 + g
  double balanced_ = 0.0;
  double balanced_at_ = 0.0;  ///< [s]
  std::mt19937_64 random_;
};

/// How far a reading of a true force F may lie from it by the cell's class [N]: accuracy |F|, but below the floor,
/// where a class says no more than that F is below it, floor * capacity. Nothing where the cell has neither.
std::optional<double> class_error(const LoadCellOptions& cell, double true_force);

/// F is below the cell's floor.
bool is_below_floor(const LoadCellOptions& cell, double true_force);

}  // namespace knot_utm
