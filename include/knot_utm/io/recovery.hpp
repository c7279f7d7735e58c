#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "knot_utm/io/journal.hpp"
#include "knot_utm/io/locked_file.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/run_writer.hpp"

namespace knot_utm {

/// The method of a run's folder, which its journal must be of. Throws InvalidInput where it is not.
Method journalled_method(const std::string& folder, const JournalHeader& header);

/// For whoever can write no further: what to do, as the end of a line; empty where the journal is gone too.
std::string how_to_recover(const std::string& folder);

/// True where the folder's result is complete; a journal that it has outlived is removed then.
bool is_settled(const std::string& folder);

/// What a run left that did not end, written anew from its method.yaml and journal by the code that writes it live.
/// `next` has written a record to the curves; whoever has further files writes them to `place()`, and `finish` adds
/// result.yaml (ended by `not yet`, a reason and a warning) and the last shape known.
///
/// In the run's own folder everything is made in a folder within, and moved to where it belongs only once it is
/// complete: what fails changes nothing. The journal stays, so that the same can be done again, or elsewhere.
class Recovery {
 public:
  /// From `folder` to `out`, which may be the same. Throws InvalidInput where there is no journal, it is that of
  /// another method, or `out` holds another run; std::runtime_error where the run is still being written.
  Recovery(const std::string& folder, const std::string& out);

  const Method& method() const { return method_; }
  const std::string& place() const { return place_.folder; }

  bool next(Record& record);  ///< false: there are no more that are whole
  void finish();              ///< once `next` is false

  std::string summary() const;  ///< one line

 private:
  /// Where the files are made.
  struct Place {
    explicit Place(std::string folder_) : folder(std::move(folder_)) {}
    ~Place();
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    Place(Place&&) = delete;
    Place& operator=(Place&&) = delete;

    std::string folder;
    bool is_scratch = false;  ///< gone in the end
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
  Points shape_;            ///< the latest
  double wall_time_ = 0.0;  ///< of the last record [s]
  std::uint64_t next_ = 0;  ///< sequence after the last record
};

}  // namespace knot_utm
