#include "knot_utm/topology/loop_turn.hpp"

#include <algorithm>
#include <cmath>

namespace knot_utm {

void LoopTurn::add(const Points& shape) {
  // A knot, or a tail that swings, may stand out further than the strand on a roller.
  const Eigen::Index knotted = shape.cols() / 5, between = shape.cols() - 2 * knotted;
  Eigen::Index highest = 0, lowest = 0;
  shape.row(2).segment(knotted, between).maxCoeff(&highest);
  shape.row(2).segment(knotted, between).minCoeff(&lowest);
  highest += knotted;
  lowest += knotted;
  double length = 0.0, sum = 0.0;
  for (Eigen::Index i = 0; i < shape.cols(); ++i) {
    if (i > 0) length += (shape.col(i) - shape.col(i - 1)).norm();
    if (i == highest || i == lowest) sum += length;
  }
  const double middle = 0.5 * (sum - length);
  if (!first_) first_ = middle;
  largest_ = std::max(largest_, std::abs(middle - *first_));
}

}  // namespace knot_utm
