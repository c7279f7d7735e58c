// Raw data of a testing machine. What is understood can be written as a curve.csv, pulled, and compared with itself.
#include <cmath>

#include "fuzz/target.hpp"
#include "knot_utm/io/comparison.hpp"
#include "knot_utm/io/curve_file.hpp"
#include "knot_utm/io/raw_data.hpp"

namespace knot_utm {

void fuzz(const std::string& text) {
  const std::vector<CurveRow> rows = read_raw_data(text, "raw.csv");
  promise(!rows.empty(), "a row at least");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    promise(std::isfinite(rows[i].time) && std::isfinite(rows[i].extension) && std::isfinite(rows[i].load), "numbers");
    promise(i == 0 || rows[i].time >= rows[i - 1].time, "times that do not go back");
  }
  const Pull pull = pull_of(rows);
  const Comparison same = compare(pull, pull);
  promise(!same.difference || same.difference->rms == 0.0, "a curve is the same as itself");
  promise(!comparison_yaml(same, "a", "b").empty(), "a comparison can be written");
}

}  // namespace knot_utm
