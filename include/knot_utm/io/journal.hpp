#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "knot_utm/io/locked_file.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/record.hpp"

namespace knot_utm {

/// The journal of a run: a file of all its records. Each record is passed to the operating system before the sender is
/// told that it is kept. From the journal and method.yaml all other files of the run can be written again with the same
/// bytes. It is the file `journal` in the run's folder until result.yaml is complete.
///
/// Format of the file, with all numbers little-endian:
///
///     "knot_utm journal\n", version (4 bytes), frame of the header, then one frame for each record
///     frame: length n of the payload (4 bytes), CRC-32 of length and payload (4 bytes), payload (n bytes)
///     payload: the object, as a bare Archive saves it
///
/// The checksum is computed by zlib, which is several times faster than the table of bytes in Boost.
///
/// What has been written outlives the process, however that ends, because it is held by the operating system. A power
/// failure may lose what the system has not yet written to the disk.
struct JournalHeader {
  std::string method;          ///< text of method.yaml
  std::uint32_t specimen = 0;  ///< CRC-32 of the centreline file; 0: the specimen is not read from a file
  std::string test;            ///< distinguishes tests of the same method, such as those of two launches

  /// Whether both runs test the same method on the same specimen, and so have the same records.
  bool same_run(const JournalHeader& other) const { return method == other.method && specimen == other.specimen; }

  void state(Archive& archive);
};

JournalHeader journal_header(const Method& method, const std::string& test = "");

/// The path of the journal in a folder.
std::string journal_file(const std::string& folder);

/// Appends records to a journal. While a writer exists, nobody else can write to the same journal, in this process or
/// another.
class JournalWriter {
 public:
  /// Makes the folder and begins a new journal. Throws InvalidInput (key "--out") where folder or file cannot be made,
  /// or where another run is writing there.
  JournalWriter(const std::string& folder, const JournalHeader& header);

  /// The same, but returns nothing where the folder has a journal already, of a run that goes on or was cut off.
  static std::optional<JournalWriter> begin_first(const std::string& folder, const JournalHeader& header);

  /// Opens an existing journal in order to append to it. Before appending, call `truncate_to` with the end that a
  /// JournalReader found. Waits up to `patience` [s] for another writer to release it. Throws std::runtime_error where
  /// there is no journal or it is not released.
  static JournalWriter go_on(const std::string& folder, double patience);

  /// Appends a record by one unbuffered write; once it returns, the record outlives the process. Throws
  /// std::runtime_error, which names file and reason, where the record could not be written completely or the file was
  /// removed. In the first case the file then ends with the previous record.
  void append(const Record& record);

  /// Removes everything after the first `bytes` bytes, which must be the end of the header or of a record. Throws
  /// std::runtime_error.
  void truncate_to(std::uint64_t bytes);

  /// Deletes the journal, once all other files are complete.
  void remove();

  std::uint64_t bytes() const { return bytes_; }  ///< length of the file, which is the end of the latest record

 private:
  JournalWriter(const std::string& folder, int flags, double patience);
  void require_open(const std::string& folder) const;
  void begin(const JournalHeader& header);
  void write(const std::string& bytes);

  std::string path_;
  LockedFile file_;
  std::uint64_t bytes_ = 0;
  std::string buffer_;  ///< bytes of a frame; a member so that its memory is reused
};

/// Reads records in order, up to the first that is incomplete or damaged. Whatever follows it is not trusted.
class JournalReader {
 public:
  /// Throws InvalidInput, which names the file, where there is no journal or it is of another version.
  explicit JournalReader(const std::string& folder);

  const JournalHeader& header() const { return header_; }

  /// Reads the next record. False where no complete record is left.
  bool next(Record& record);

  std::uint64_t records() const { return records_; }        ///< number of records read so far
  std::uint64_t good_bytes() const { return good_bytes_; }  ///< bytes up to the end of the latest record read
  std::uint64_t bytes_left() const {
    return bytes_ - good_bytes_;
  }  ///< bytes that are incomplete or damaged, once `next` has returned false

 private:
  bool read_frame();  ///< reads the next frame into `payload_`
  template <class T>
  bool load(T& kept) const;  ///< loads an object from `payload_`; false unless it uses all of it

  std::string file_;
  std::ifstream in_;
  JournalHeader header_;
  std::uint64_t bytes_ = 0;
  std::uint64_t good_bytes_ = 0;
  std::uint64_t records_ = 0;
  std::string payload_;
};

}  // namespace knot_utm
