#include "knot_utm/io/curve_file.hpp"

#include <sstream>

#include "knot_utm/io/raw_data.hpp"
#include "knot_utm/io/run_folder.hpp"

namespace knot_utm {
namespace {

/// By the row of its names; raw data of a machine have no phases.
bool is_own(const std::string& content) {
  std::istringstream names(content.substr(0, content.find_first_of("\r\n")));
  bool time = false, phase = false;
  for (std::string name; std::getline(names, name, ',');) {
    time |= name == "time";
    phase |= name == "phase";
  }
  return time && phase;
}

}  // namespace

std::vector<CurveRow> read_curve_file(const std::string& file) {
  const std::string content = read_input(file, "a curve.csv, or raw data of a testing machine");
  if (!is_own(content)) return read_raw_data(content, file);
  std::istringstream in(content);
  return read_curve(in, file);
}

Pull pull_of(const std::vector<CurveRow>& rows, bool balanced) {
  Pull pull;
  CurveRow zero;
  for (const CurveRow& row : rows) {
    if (!pulls(row.phase)) continue;
    if (pull.empty() && balanced) zero = row;
    const PullPoint point = {row.time, row.extension - zero.extension, row.knot_distance, row.load - zero.load};
    if (pull.empty() || point.extension > pull.back().extension) pull.push_back(point);
  }
  return pull;
}

}  // namespace knot_utm
