#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "knot_utm/io/locked_file.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/record.hpp"

namespace knot_utm {

/// The journal of a run: every record, on its way to the disk before anybody is told that it is kept. With method.yaml
/// it is enough to write all else that the run leaves, to the same bytes. It stands in the run's folder as `journal`
/// until result.yaml is complete.
///
/// The file, all numbers little-endian:
///
///     "knot_utm journal\n", version (4 bytes), frame of the header, then one frame a record
///     frame: length n of the payload (4 bytes), CRC-32 of length and payload (4 bytes), payload (n bytes)
///     payload: what is kept, as a bare Archive saves it
///
/// The checksum is zlib's: several times faster than a table of bytes as Boost has it.
///
/// What has been written is in the hands of the operating system: it outlives the process, however that ends. A power
/// cut may take what the system had not put on the disk yet.
struct JournalHeader {
  std::string method;          ///< text of method.yaml
  std::uint32_t specimen = 0;  ///< CRC-32 of the centreline file; 0: the specimen is none
  std::string test;            ///< tells tests of one method apart, such as those of one launch from another's

  bool operator==(const JournalHeader& other) const {
    return method == other.method && specimen == other.specimen && test == other.test;
  }

  void state(Archive& archive);
};

JournalHeader journal_header(const Method& method, const std::string& test = "");

/// The journal in a folder.
std::string journal_file(const std::string& folder);

/// Appends. As long as one is there nobody else can write to the same journal, in this process or another.
class JournalWriter {
 public:
  /// Begins anew, and makes the folder. Throws InvalidInput (key "--out") where folder or file cannot be made, or
  /// another run writes there.
  JournalWriter(const std::string& folder, const JournalHeader& header);

  /// The same, but none where there is a journal already, of a run that goes on or was cut off.
  static std::optional<JournalWriter> begin_first(const std::string& folder, const JournalHeader& header);

  /// Goes on behind what is there; `truncate_to` the end that a JournalReader found before appending. Waits up to
  /// `patience` [s] for another to let go. Throws std::runtime_error where there is none or it is still held.
  static JournalWriter go_on(const std::string& folder, double patience);

  /// One unbuffered write; once it returns the record outlives the process. Throws std::runtime_error, which names file
  /// and reason, where it could not be written whole (the file then ends with the record before) or the file was
  /// removed.
  void append(const Record& record);

  /// Takes back everything behind `bytes`, the end of the header or of a record. Throws std::runtime_error.
  void truncate_to(std::uint64_t bytes);

  /// Once everything else is complete.
  void remove();

  std::uint64_t bytes() const { return bytes_; }  ///< length of the file: the end of the latest record

 private:
  JournalWriter(const std::string& folder, int flags, double patience);
  void require_open(const std::string& folder) const;
  void begin(const JournalHeader& header);
  void write(const std::string& bytes);

  std::string path_;
  LockedFile file_;
  std::uint64_t bytes_ = 0;
  std::string buffer_;  ///< of a frame, kept for its memory
};

/// Reads records in order, up to the first that is cut or damaged: nothing behind it is believed.
class JournalReader {
 public:
  /// Throws InvalidInput, which names the file, where there is no journal, or one of another version.
  explicit JournalReader(const std::string& folder);

  const JournalHeader& header() const { return header_; }

  /// The next record; false where there is none that is whole.
  bool next(Record& record);

  std::uint64_t records() const { return records_; }                 ///< read so far
  std::uint64_t good_bytes() const { return good_bytes_; }           ///< up to the end of the latest record read
  std::uint64_t bytes_left() const { return bytes_ - good_bytes_; }  ///< once `next` is false: cut or damaged

 private:
  bool read_frame();  ///< into `payload_`
  template <class T>
  bool load(T& kept) const;  ///< from `payload_`: whether that is the whole of it

  std::string file_;
  std::ifstream in_;
  JournalHeader header_;
  std::uint64_t bytes_ = 0;
  std::uint64_t good_bytes_ = 0;
  std::uint64_t records_ = 0;
  std::string payload_;
};

}  // namespace knot_utm
