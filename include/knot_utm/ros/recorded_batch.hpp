#pragma once

#include <string>
#include <vector>

#include "knot_utm/io/claimed_folder.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/study/batch.hpp"

namespace knot_utm {

/// The folder of a batch whose specimens are tested under ROS, one after the other. It has the files that run_batch
/// writes. Its tables are written after each test, for the specimens so far. Its journal, which has no records, is
/// removed once all specimens have been tested; until then `tensile_test --resume` can test the others.
class RecordedBatch {
 public:
  /// Begins a batch in a claimed folder. Throws as begin_run_folder does.
  static RecordedBatch begin(const Method& method, ClaimedFolder claimed);
  /// Goes on with the batch of a recorder that has died.
  static RecordedBatch go_on(const Method& method, ClaimedFolder claimed);

  const std::string& folder() const { return claimed_.folder; }

  /// The method of a specimen, and the folder for its files. Throws InvalidInput where it would be refused.
  const Method& method_of(int number);
  std::string folder_of(int number) const { return specimen_folder(folder(), number); }

  /// Adds the specimens up to this one, which have been tested, to the tables, and writes them. Returns whether all
  /// have been tested now. Throws std::runtime_error.
  bool conclude(int number);

 private:
  RecordedBatch(const Method& method, ClaimedFolder claimed);

  Method method_;
  ClaimedFolder claimed_;
  std::vector<DrawnSpecimen> drawn_;  ///< those so far
  BatchTable table_;
  int concluded_ = 0;  ///< number of specimens in the table
};

}  // namespace knot_utm
