#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/study/specimens.hpp"

namespace knot_utm {

/// A specimen whose readings do not count, and the reason, such as "the knot came undone before it was pulled".
struct Rejected {
  int specimen = 0;
  std::string reason;
};

/// The results of a batch, read from the folders of its specimens as their tests end. A test is rejected if the
/// simulation gave up, if the knot came undone before it was pulled, or if an operator stopped it.
class BatchTable {
 public:
  /// `folder`: that of the batch.
  explicit BatchTable(std::string folder) : folder_(std::move(folder)) {}

  /// Adds a specimen whose test has ended. Throws std::runtime_error where its result cannot be read.
  void add(const DrawnSpecimen& specimen);

  const std::vector<Rejected>& rejected() const { return rejected_; }

  /// Writes specimens.csv and statistics.yaml into the folder of the batch. Throws std::runtime_error where one cannot
  /// be written.
  void write() const;

  /// The text of specimens.csv. Row 1 holds names and row 2 units; then follows one row for each specimen, with the
  /// drawn values and the numbers of result.yaml.
  std::string csv() const;
  /// The text of statistics.yaml: the statistics of each number of result.yaml over the specimens that were not
  /// rejected.
  std::string statistics() const;

 private:
  struct Row {
    int specimen;
    std::vector<double> drawn;
    bool counts;
    std::string ended_by, motion_pattern;
    std::vector<std::optional<double>> numbers;  // in the order of the keys of result.yaml that are numbers
  };

  std::string folder_;
  std::vector<std::pair<std::string, std::string>> drawn_keys_;  // with units
  std::vector<Row> rows_;
  std::vector<Rejected> rejected_;
};

/// The file that a batch has once all its tests have ended; under ROS, once the first has.
std::string statistics_file(const std::string& folder);

}  // namespace knot_utm
