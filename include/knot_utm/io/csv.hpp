#pragma once

#include <fstream>
#include <istream>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// curve.csv and curve_full.csv: row 1 names, row 2 units, then one row a sample, comma between columns, every number
/// in the shortest form that reads back to the same double, "nan" for what is not there. Each row is handed to the
/// operating system before `write` returns, so a run that is killed keeps what it measured. The last column,
/// corrected_extension, is there only for a compliant frame.
class CurveWriter {
 public:
  /// Throws std::runtime_error where the file cannot be written.
  explicit CurveWriter(const std::string& file, bool compliant_frame = false);

  void write(const CurveRow& row);  ///< throws std::runtime_error (disk full)
  void write(const Sample& sample) { write(curve_row(sample)); }

  std::size_t rows() const { return rows_; }  ///< written, without the two of names and units

 private:
  std::string file_;
  std::ofstream out_;
  bool compliant_frame_;
  std::size_t rows_ = 0;
};

/// Reads what CurveWriter wrote, with corrected_extension or without. Columns are found by name, in any order; others
/// are passed over. Throws InvalidInput
/// where the file cannot be read, a column is missing, a unit differs, a row is not as it should be, or there are more
/// than TextRows allows.
std::vector<CurveRow> read_curve(const std::string& file);
/// The same from a stream; `file` is its name in messages.
std::vector<CurveRow> read_curve(std::istream& in, const std::string& file);

/// final_shape.csv: x,y,z [m], one row a point. Throws std::runtime_error where the file cannot be written.
void write_centreline(const std::string& file, const Points& points);

}  // namespace knot_utm
