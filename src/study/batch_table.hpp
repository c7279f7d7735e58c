#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/study/batch.hpp"
#include "knot_utm/study/specimens.hpp"

namespace knot_utm {

/// What the folders of a batch's specimens say once all tests have ended.
class BatchTable {
 public:
  BatchTable(const std::string& folder, const std::vector<DrawnSpecimen>& specimens);

  const std::vector<Rejected>& rejected() const { return rejected_; }

  /// specimens.csv: row 1 names, row 2 units; the values that were drawn, then the numbers of result.yaml.
  std::string csv() const;
  /// statistics.yaml: of each number of result.yaml, over the specimens that are not rejected.
  std::string statistics() const;

 private:
  struct Row {
    const DrawnSpecimen* specimen;
    bool counts;
    std::string ended_by, motion_pattern;
    std::vector<std::optional<double>> numbers;  // by the keys of result.yaml that are numbers
  };

  std::vector<Row> rows_;
  std::vector<Rejected> rejected_;
};

}  // namespace knot_utm
