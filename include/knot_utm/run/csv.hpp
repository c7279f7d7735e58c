#pragma once

#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

struct Sample;

/// Writes curve.csv and curve_full.csv: a row with the names of the columns, one with their units, and one for each
/// sample. Every number reads back to the same double; "nan" stands for a value that does not exist. Each row is passed
/// to the operating system before `write` returns, so a run that is killed keeps what it measured. The last column,
/// crosshead_travel, is written for a compliant frame only.
class CurveWriter {
 public:
  /// Throws std::runtime_error where the file cannot be written.
  explicit CurveWriter(const std::string& file, bool compliant_frame = false);

  void write(const CurveRow& row);  ///< throws std::runtime_error (disk full)
  void write(const Sample& sample) { write(curve_row(sample)); }

  std::size_t rows() const { return rows_; }  ///< rows written, without those of names and units

 private:
  std::string file_;
  std::ofstream out_;
  bool compliant_frame_;
  std::size_t rows_ = 0;
};

/// Reads a file of CurveWriter, whose columns are found by name. Throws InvalidInput where the file cannot be read, a
/// column is missing, a unit differs, a row is malformed, or there are more rows than TextRows allows.
std::vector<CurveRow> read_curve(const std::string& file);
/// The same from a stream; `file` is its name in messages.
std::vector<CurveRow> read_curve(std::istream& in, const std::string& file);

/// Writes final_shape.csv: x,y,z [m], one row for each point, and of several ropes, between which the edges `cuts` are,
/// the number of the point's rope, from 1. Throws std::runtime_error where the file cannot be written.
void write_centreline(const std::string& file, const Points& points, const std::vector<int>& cuts = {});

/// The curve of the run in a folder, or of a specimen of the batch there. `specimen`: its number, which --specimen has,
/// 0: none is given; empty: none can be given. What is no folder is the file itself. Throws InvalidInput.
std::string curve_file_of(const std::string& given, std::optional<int> specimen = std::nullopt);

/// Whether a file is a curve.csv or curve_full.csv, by the row of its names: what a testing machine exports has no
/// phases. Throws InvalidInput where it cannot be read.
bool is_curve_file(const std::string& file);

/// Reads the readings of a test whose crosshead motion another test follows. They begin with the reading before the
/// first that pulls (pulls(phase)) and end with the record, or where it was balanced behind the last that pulls, which
/// `tell` receives. Throws InvalidInput where the file is no curve.csv, a number is not finite, a time is smaller than
/// the one before, or a balance before the last that pulls makes two zeros of extension.
std::vector<CurveRow> read_course(const std::string& file, const Tell& tell = nullptr);

}  // namespace knot_utm
