#include "knot_utm/run/curve_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <system_error>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/raw/raw_cells.hpp"
#include "knot_utm/raw/raw_data.hpp"
#include "knot_utm/raw/raw_text.hpp"
#include "knot_utm/run/run_folder.hpp"

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

/// A curve.csv as a spreadsheet saves it, with a byte order mark, quotes, other separators and a decimal comma, as it
/// was before. Empty for any other text.
std::optional<std::string> as_it_was(const std::string& content) {
  if (!why_no_text(content).empty()) return std::nullopt;
  const std::string text = meanings_of(content).front();
  for (const char separator : {',', ';', '\t'}) {
    std::istringstream rows(text);
    std::string out;
    for (std::string row; std::getline(rows, row) && (out.empty() || is_own(out));) {
      Cells cells = split(row, separator);
      if (are_empty(cells)) continue;
      for (std::string& cell : cells)
        if (separator != ',') std::replace(cell.begin(), cell.end(), ',', '.');
      for (std::size_t i = 0; i < cells.size(); ++i) out += (i == 0 ? "" : ",") + cells[i];
      out += '\n';
    }
    if (is_own(out)) return out;
  }
  return std::nullopt;
}

bool pulled(const CurveRow& row) { return pulls(row.phase); }

}  // namespace

std::string curve_file_of(const std::string& given, const RawOptions& options) {
  std::error_code error;
  const std::filesystem::path folder(given);
  if (!std::filesystem::is_directory(folder, error)) return given;
  if (std::filesystem::exists(folder / "curve.csv", error)) {
    if (options.specimen > 1)
      throw InvalidInput::sentence("specimens", std::to_string(options.specimen),
                                   options.spelling.option("specimen") + " is " + std::to_string(options.specimen) +
                                       ", but the folder is that of a single test")
          .in_file(given);
    return (folder / "curve.csv").string();
  }
  const std::size_t specimens = specimen_folders(given).size();
  if (specimens == 0)
    throw InvalidInput::sentence("folder", given, "the folder has no curve.csv, so it is not that of a run")
        .in_file(given);
  if (options.specimen < 1 || static_cast<std::size_t>(options.specimen) > specimens)
    throw InvalidInput::sentence("specimens", std::to_string(options.specimen),
                                 "the folder holds " + std::to_string(specimens) + " specimens: choose one by " +
                                     options.spelling.option("specimen", "1 to ") + std::to_string(specimens))
        .in_file(given);
  return (std::filesystem::path(specimen_folder(given, options.specimen)) / "curve.csv").string();
}

std::vector<CurveRow> read_curve_file(const std::string& file, const RawOptions& options, const Tell& tell) {
  const std::string content = read_input(file);
  if (is_own(content)) {
    std::istringstream in(content);
    return read_curve(in, file);
  }
  const std::optional<std::string> own = as_it_was(content);
  if (!own) return read_raw_data(content, file, options, tell);
  if (tell) tell(file + ": read as a curve.csv that a spreadsheet saved anew");
  std::istringstream in(*own);
  return read_curve(in, file);
}

std::vector<CurveRow> read_course(const std::string& file, const RawOptions& options, const Tell& tell) {
  std::vector<CurveRow> rows = read_curve_file(file, options, tell);
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
