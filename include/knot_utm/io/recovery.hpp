#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "knot_utm/io/journal.hpp"
#include "knot_utm/io/locked_file.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/run_writer.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Loads method.yaml of a run's folder. Throws InvalidInput where the journal belongs to another method.
Method journalled_method(const std::string& folder, const JournalHeader& header);

/// The end of an error message for a run that cannot write any more: how to recover what was recorded. Empty where
/// there is no journal.
std::string how_to_recover(const std::string& folder);

/// Whether the result in the folder is complete. A journal that is left over from it is then removed.
bool is_settled(const std::string& folder);

/// Recovers a run that did not end. All of its files are written again from method.yaml and the journal, by the same
/// code that writes them during a run. `next` writes one record to the curves. Further files are to be written to the
/// folder `place()`. `finish` adds result.yaml, with `ended_by: not yet`, a reason and a warning, and the last known
/// shape.
///
/// In the run's own folder all files are first written to a subfolder, and are moved to their places only once they are
/// complete. A recovery that fails therefore changes nothing. The journal is kept, so that the recovery can be
/// repeated, there or elsewhere.
class Recovery {
 public:
  /// Recovers the run in `folder` and writes its files to `out`, which may be the same folder. Throws InvalidInput
  /// where there is no journal, it belongs to another method, or `out` holds another run. Throws std::runtime_error
  /// where the run is still being written.
  Recovery(const std::string& folder, const std::string& out);

  const Method& method() const { return method_; }
  const std::string& place() const { return place_.folder; }

  bool next(Record& record);  ///< false: no complete record is left
  void finish();              ///< to be called once `next` has returned false

  std::string summary() const;  ///< one line that says what was recovered

 private:
  /// The folder in which the files are made.
  struct Place {
    explicit Place(std::string folder_) : folder(std::move(folder_)) {}
    ~Place();
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    Place(Place&&) = delete;
    Place& operator=(Place&&) = delete;

    std::string folder;
    bool is_scratch = false;  ///< whether it is temporary, and removed in the end
  };

  void make_place();
  void move_into_place() const;

  std::string folder_;
  std::string out_;
  LockedFile lock_;
  JournalReader journal_;
  Method method_;
  Place place_;
  std::unique_ptr<RunWriter> writer_;
  Points shape_;            ///< shape of the latest record that has one
  double wall_time_ = 0.0;  ///< wall time of the last record [s]
  std::uint64_t next_ = 0;  ///< sequence number after that of the last record
};

}  // namespace knot_utm
