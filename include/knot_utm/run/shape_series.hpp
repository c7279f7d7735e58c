#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/run/record.hpp"

namespace knot_utm {

/// The rod over the time of a test, for pictures: what becomes shapes.csv. Of all records that have readings of the rod
/// it keeps each 2^k-th, with the smallest k that leaves no more than `kMost`, and the last one: how long a test takes
/// is not known before it has ended.
class ShapeSeries {
 public:
  static constexpr std::size_t kMost = 120;

  /// `cuts`: edges between one rope and the next (RodProperties::cuts).
  explicit ShapeSeries(const std::vector<int>& cuts = {}) : cuts_(cuts) {}

  void add(const Record& record);  ///< not that of a rod that has parted
  /// As the rod lies once it has parted, when its forces are not known. `time` [s].
  void add_parted(double time, const Points& shape);

  bool empty() const { return kept_.empty(); }

  /// Rows of names and of units, then a row a node, shape after shape, to seven digits; "nan" where something is not
  /// known. `tension` is that of the edge to the next node. Of several ropes there is a column `rope`, from 1.
  std::string csv() const;

 private:
  struct Shape {
    double time = 0.0;  // [s]
    Points points;      // [m]
    Eigen::VectorXd tension;
    RodReadings readings;
  };
  void write(const Shape& shape, std::string& text) const;

  std::vector<int> cuts_;
  std::vector<Shape> kept_;
  std::vector<Shape> at_the_end_;  // the last record where it is not kept, and the parted rod
  std::size_t records_ = 0;
  std::size_t stride_ = 1;  // 2^k
};

}  // namespace knot_utm
