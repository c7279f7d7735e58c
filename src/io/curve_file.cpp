#include "knot_utm/io/curve_file.hpp"

#include <fstream>

#include "knot_utm/io/raw_data.hpp"
#include "knot_utm/rod/invalid_input.hpp"
#include "knot_utm/rod/text_rows.hpp"

namespace knot_utm {
namespace {

/// A machine's raw data have no phases.
bool has_phases(std::istream& in) {
  TextRows rows(in);
  return rows.next() && rows.text().find("phase") != std::string::npos;
}

}  // namespace

std::vector<CurveRow> read_curve_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InvalidInput("file", file, "a curve that can be read");
  const bool own = has_phases(in);
  in.clear();
  in.seekg(0);
  return own ? read_curve(in, file) : read_raw_data(in, file);
}

Pull pull_of(const std::vector<CurveRow>& rows, bool balanced) {
  Pull pull;
  CurveRow zero;
  for (const CurveRow& row : rows) {
    if (row.phase != Phase::kPull) continue;
    if (pull.empty() && balanced) zero = row;
    const PullPoint point = {row.time, row.extension - zero.extension, row.knot_distance, row.load - zero.load};
    if (pull.empty() || point.extension > pull.back().extension) pull.push_back(point);
  }
  return pull;
}

}  // namespace knot_utm
