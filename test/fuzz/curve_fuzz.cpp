// curve.csv, as `compare` and others read it.
#include <sstream>

#include "fuzz/target.hpp"
#include "knot_utm/io/csv.hpp"

namespace knot_utm {

void fuzz(const std::string& text) {
  std::istringstream in(text);
  const std::vector<CurveRow> rows = read_curve(in, "curve.csv");
  for (const CurveRow& row : rows) promise(phase_named(phase_name(row.phase)) == row.phase, "a phase that has a name");
}

}  // namespace knot_utm
