#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/study/batch.hpp"
#include "knot_utm/study/specimens.hpp"

namespace knot_utm {

/// The results of a batch, read from the folders of its specimens once all tests have ended.
class BatchTable {
 public:
  BatchTable(const std::string& folder, const std::vector<DrawnSpecimen>& specimens);

  const std::vector<Rejected>& rejected() const { return rejected_; }

  /// The text of specimens.csv. Row 1 holds names and row 2 units; then follows one row for each specimen, with the
  /// drawn values and the numbers of result.yaml.
  std::string csv() const;
  /// The text of statistics.yaml: the statistics of each number of result.yaml over the specimens that were not
  /// rejected.
  std::string statistics() const;

 private:
  struct Row {
    const DrawnSpecimen* specimen;
    bool counts;
    std::string ended_by, motion_pattern;
    std::vector<std::optional<double>> numbers;  // in the order of the keys of result.yaml that are numbers
  };

  std::vector<Row> rows_;
  std::vector<Rejected> rejected_;
};

}  // namespace knot_utm
