#include "knot_utm/run/curve_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <system_error>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

bool pulled(const CurveRow& row) { return pulls(row.phase); }

}  // namespace

std::string curve_file_of(const std::string& given, std::optional<int> specimen) {
  std::error_code error;
  const std::filesystem::path folder(given);
  if (!std::filesystem::is_directory(folder, error)) return given;
  const auto refuse = [&](const std::string& why) {
    return InvalidInput::sentence("folder", given, why).in_file(given);
  };
  const int wanted = specimen.value_or(0);
  if (std::filesystem::exists(folder / "curve.csv", error)) {
    if (wanted > 1)
      throw refuse("--specimen is " + std::to_string(wanted) + ", but the folder is that of a single test");
    return (folder / "curve.csv").string();
  }
  const std::size_t specimens = specimen_folders(given).size();
  if (specimens == 0) throw refuse("the folder has no curve.csv, so it is not that of a run");
  if (wanted < 1 || static_cast<std::size_t>(wanted) > specimens)
    throw refuse("the folder holds " + std::to_string(specimens) + " specimens: " +
                 (specimen ? "choose one by --specimen 1 to " + std::to_string(specimens) : "give the folder of one"));
  return (std::filesystem::path(specimen_folder(given, wanted)) / "curve.csv").string();
}

bool is_curve_file(const std::string& file) {
  const std::string content = read_input(file);
  std::istringstream names(content.substr(0, content.find_first_of("\r\n")));
  bool time = false, phase = false;
  for (std::string name; std::getline(names, name, ',');) {
    time |= name == "time";
    phase |= name == "phase";
  }
  return time && phase;
}

std::vector<CurveRow> read_course(const std::string& file, const Tell& tell) {
  if (!is_curve_file(file))
    throw InvalidInput::sentence("names", file,
                                 "the file is no curve.csv; import_instron makes one of what a testing machine exports")
        .in_file(file);
  std::vector<CurveRow> rows = read_curve(file);
  const auto first = std::find_if(rows.begin(), rows.end(), pulled);
  if (first == rows.end()) return {};
  const auto begin = first == rows.begin() ? first : first - 1;
  if (begin != first && balanced_between(*begin, *first))
    begin->extension = begin->crosshead_travel = 0.0;  // zero is where it stood
  const auto behind = std::find_if(rows.rbegin(), rows.rend(), pulled).base();
  auto end = rows.end();
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
    if (row->phase != Phase::kBalance && (row - 1 == begin || !balanced_between(*(row - 1), *row))) continue;
    if (row < behind)
      throw InvalidInput::sentence(reading, "a balance",
                                   "the test was balanced at " + reading +
                                       ", between its pulls; a record that is followed must keep one zero of extension")
          .in_file(file);
    if (tell)
      tell(file + ": followed to reading " + std::to_string(row - rows.begin()) +
           ", behind which the test was balanced");
    end = row;
    break;
  }
  return {begin, end};
}

}  // namespace knot_utm
