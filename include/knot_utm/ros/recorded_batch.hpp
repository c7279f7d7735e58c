#pragma once

#include <string>
#include <vector>

#include "knot_utm/run/claimed_folder.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/study/batch.hpp"

namespace knot_utm {

/// The folder of a batch whose specimens are tested under ROS, one after the other. It has the files that run_batch
/// writes. Its tables are written after each test, for the specimens so far. `tensile_test --resume` can test the
/// others.
class RecordedBatch {
 public:
  /// A batch in a folder that has been begun (begin_run_folder), be it by a recorder that has died.
  RecordedBatch(const Method& method, ClaimedFolder claimed);

  const std::string& folder() const { return claimed_.path(); }

  /// The method of a specimen, and the folder for its files. Throws InvalidInput where it would be refused.
  const Method& method_of(int number);
  std::string folder_of(int number) const { return specimen_folder(folder(), number); }

  /// Adds the specimens up to this one, which have been tested, to the tables, and writes them. Returns whether all
  /// have been tested now. Throws std::runtime_error.
  bool conclude(int number);

 private:
  Method method_;
  ClaimedFolder claimed_;
  std::vector<DrawnSpecimen> drawn_;  ///< those so far
  BatchTable table_;
  int concluded_ = 0;  ///< number of specimens in the table
};

}  // namespace knot_utm
