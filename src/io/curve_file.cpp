#include "knot_utm/io/curve_file.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "knot_utm/io/raw_data.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"

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

bool pulled(const CurveRow& row) { return pulls(row.phase); }

}  // namespace

std::vector<CurveRow> read_curve_file(const std::string& file, const RawColumns& columns) {
  const std::string content = read_input(file);
  if (!is_own(content)) return read_raw_data(content, file, columns);
  std::istringstream in(content);
  return read_curve(in, file);
}

std::vector<CurveRow> read_course(const std::string& file, const RawColumns& columns) {
  std::vector<CurveRow> rows = read_curve_file(file, columns);
  const auto first = std::find_if(rows.begin(), rows.end(), pulled);
  if (first == rows.end()) return {};
  const auto begin = first == rows.begin() ? first : first - 1;
  if (begin != first && balanced_between(*begin, *first)) begin->extension = 0.0;  // zero is where it stood
  const auto end = std::find_if(rows.rbegin(), rows.rend(), pulled).base();
  for (auto row = begin; row != end; ++row) {
    const std::string reading = "reading " + std::to_string(row - rows.begin() + 1);
    if (!std::isfinite(row->time) || !std::isfinite(row->extension))
      throw InvalidInput::sentence(reading, "not finite", reading + " has no time or no extension").in_file(file);
    if (row == begin) continue;
    if (row->time < (row - 1)->time)
      throw InvalidInput::sentence(reading, format_number(row->time),
                                   "time goes back at " + reading + ", from " + format_number((row - 1)->time) +
                                       " s to " + format_number(row->time) + " s")
          .in_file(file);
    if (row->phase == Phase::kBalance || (row - 1 != begin && balanced_between(*(row - 1), *row)))
      throw InvalidInput::sentence(reading, "a balance",
                                   "the test was balanced at " + reading +
                                       ", between its pulls; a record that is followed must keep one zero of extension")
          .in_file(file);
  }
  return {begin, end};
}

}  // namespace knot_utm
