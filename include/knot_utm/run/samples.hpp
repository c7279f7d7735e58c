#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// What a picture colours the rod by, beside its tension. A vector is empty where its values are not known.
struct RodReadings {
  Eigen::VectorXd twist_rate;    ///< of each inner node (twist_rates) [rad/m]
  Eigen::VectorXd contact_load;  ///< normal forces on each node per length (TestingMachine::contact_load) [N/m]

  void state(Archive& archive);
};

/// All that is kept of one command. The files of a run are made from its records alone.
struct Record {
  Command command;
  Sample answer;
  std::vector<Sample> steps;            ///< the accepted time steps of this command, in order
  Points shape;                         ///< nodes after the command [m]; no columns where no shape is due
  Eigen::VectorXd tension;              ///< of each edge, tension positive [N]; empty where no shape is due
  std::optional<RodReadings> readings;  ///< where they are asked for and a shape is due
  double wall_time = 0.0;               ///< wall time since the beginning of the test [s]

  void state(Archive& archive);
};

/// The row of curve.csv that belongs to a command; null: none does. It is the answer at a sampling instant of the load
/// cell, and also where the cell was balanced, so that the curve contains its zero. The time step in which the rod
/// parted ends the curve, mostly between two sampling instants. A machine that failed gives no row.
const Sample* cell_reading(const Record& record);

/// The rows of curve.csv, in order. Where a step that pulls ends between two sampling instants, the cell is read once
/// more, without its errors, as where the rod parts: the largest load is often the last one.
class CellReadings {
 public:
  using Take = std::function<void(const Sample& reading)>;

  void add(const Record& record, const Take& take);  ///< with the readings that this record shows
  void end(const Take& take);                        ///< with the last one, if there is one more

 private:
  std::optional<Sample> unread_;  ///< the last answer to a step that pulls
  int step_ = -1;                 ///< that step
};

/// Whether a command's record has the rod's shape: at every reading of the load cell, and once the rod has parted.
inline bool shape_is_due(const Command& command, const Sample& answer) {
  return command.read_cell || answer.status == BenchStatus::kBroken;
}

/// How a test ended.
struct TestEnd {
  EndedBy ended_by = EndedBy::kNotYet;
  std::string reason;  ///< one line; empty: as programmed
};

/// The samples of a run, from which all its other files are made (run_writer.hpp):
///
///   samples.csv   row 1 has the names of the columns and row 2 their units. A row of the kind `step` is a time step, a
///                 row `answer` is a command with its answer, a row `answered step` is both, and the row `end`, which
///                 repeats the last answer, says how the test ended. A cell is empty where its row has no such
///                 value. Every number reads back to the same bits.
///   shapes.bin    the rod at each reading of the load cell, which fits no row, where a file is to be made of it: for
///                 each shape the length of what follows [8 bytes, little-endian], then the shape as a bare Archive
///                 saves it.
///
/// The rows of a command are passed to the operating system, by one write, before the command counts as answered. They
/// therefore outlive the process, but what is not on the disk yet may not outlive a power failure.
std::string samples_file(const std::string& folder);
std::string shapes_file(const std::string& folder);

/// Reads the records in order, up to the last command that is whole.
class SamplesReader {
 public:
  explicit SamplesReader(const std::string& folder);

  /// Reads the next record. False where no whole command is left.
  bool next(Record& record);

  std::uint64_t records() const { return records_; }  ///< number of records read so far
  /// How the test ended, once `next` has returned false; nothing where its samples do not say so.
  const std::optional<TestEnd>& end() const { return end_; }
  const Points& final_shape() const { return final_shape_; }  ///< the last known shape; no columns: none is known
  /// Bytes of a last command that was cut off, once `next` has returned false.
  std::uint64_t torn_bytes() const { return bytes_ - whole_bytes_; }

 private:
  friend class SamplesWriter;
  /// A shape without its row.
  struct Shape {
    std::uint64_t sequence = 0;
    Points points;
    Eigen::VectorXd tension;
    std::optional<RodReadings> readings;
    void state(Archive& archive);
  };
  static constexpr std::uint64_t kFinal = UINT64_MAX;  ///< sequence of the shape at the end of the test

  bool take_shape(std::uint64_t sequence);  ///< whether the next shape in the file, which is then `shape_`, has it

  std::string file_, shapes_file_;
  std::ifstream in_, shapes_in_;
  std::string line_;
  std::uint64_t row_ = 2;
  std::uint64_t bytes_ = 0, whole_bytes_ = 0, shapes_whole_bytes_ = 0;
  std::uint64_t records_ = 0;
  std::optional<TestEnd> end_;
  Points final_shape_;
  Shape shape_;
  std::uint64_t shape_bytes_ = 0;  ///< length of `shape_` in the file, where it was read and not yet taken; else 0
};

/// Appends to the samples of a run whose folder is claimed (run_folder.hpp). All functions throw CannotWrite, and
/// then leave the file as it was, so that it ends with a whole command.
class SamplesWriter {
 public:
  /// Begins the files of a new run, of which none may be there. `shapes`: writes shapes.bin, too.
  explicit SamplesWriter(const std::string& folder, bool shapes = true);

  void append(const Record& record);
  /// Says how the test ended. `final_shape`: the rod then; no columns: it is not known.
  void end(const TestEnd& end, const Points& final_shape);

 private:
  /// A file that is written without a buffer.
  struct File {
    File(std::string path_, const char* mode);
    void append(const std::string& bytes);
    void cut(std::uint64_t bytes);

    std::string path;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file;
    std::uint64_t size = 0;
  };
  void append(const SamplesReader::Shape& shape);

  File rows_;
  std::optional<File> shapes_;
  Sample last_;         ///< the last answer
  std::string buffer_;  ///< a member so that its memory is reused
};

}  // namespace knot_utm
