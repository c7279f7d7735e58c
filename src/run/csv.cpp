#include "knot_utm/run/csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <system_error>

#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample_fields.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "knot_utm/words/text_rows.hpp"

namespace knot_utm {
namespace {

struct Column {
  const char* name;
  const char* unit;
  double CurveRow::*value;  // null: the phase
  bool required = true;     // of a file that is read
};

/// The last one is written for a compliant frame only.
constexpr std::array<Column, 9> kColumns{
    {{"time", sample_unit("time"), &CurveRow::time},
     {"extension", sample_unit("extension"), &CurveRow::extension},
     {"load", sample_unit("load"), &CurveRow::load},
     {"knot_distance", sample_unit("knot_distance"), &CurveRow::knot_distance},
     {"end_to_end", sample_unit("end_to_end"), &CurveRow::end_to_end},
     {"load_lower", sample_unit("force_lower"), &CurveRow::load_lower},
     {"phase", sample_unit("phase"), nullptr},
     {"balance_offset", sample_unit("balance_offset"), &CurveRow::balance_offset, false},
     {"crosshead_travel", sample_unit("raw_extension"), &CurveRow::crosshead_travel, false}}};

/// A line with a cell for each column.
template <class Cell>
std::string row_text(bool compliant_frame, const Cell& cell) {
  std::string line;
  for (const Column& column : kColumns)
    if (&column != &kColumns.back() || compliant_frame) line += (line.empty() ? "" : ",") + std::string(cell(column));
  return line + '\n';
}

void open(std::ofstream& out, const std::string& file) {
  out.open(file, std::ios::binary | std::ios::trunc);
  if (!out) throw CannotWrite(file);
}

std::vector<std::string_view> cells(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string_view> result;
  for (;;) {
    const std::size_t comma = line.find(',');
    result.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return result;
    line.remove_prefix(comma + 1);
  }
}

/// Where a column stands, its unit checked; empty: nowhere, and it need not.
std::optional<std::size_t> place(const std::string& file, const std::vector<std::string_view>& names,
                                 const std::vector<std::string_view>& units, const Column& column) {
  const auto found = std::find(names.begin(), names.end(), column.name);
  if (found == names.end() && !column.required) return std::nullopt;
  if (found == names.end())
    throw InvalidInput::sentence("row 1",
                                 "row 1 names no column " + std::string(column.name) + ", which a curve.csv has")
        .in_file(file);
  const std::size_t index = static_cast<std::size_t>(found - names.begin());
  const std::string given = index < units.size() ? "\"" + std::string(units[index]) + "\"" : "missing";
  if (index >= units.size() || units[index] != column.unit)
    throw InvalidInput(file, "row 2: the unit of " + std::string(column.name), given, column.unit);
  return index;
}

}  // namespace

CurveWriter::CurveWriter(const std::string& file, bool compliant_frame)
    : file_(file), compliant_frame_(compliant_frame) {
  open(out_, file);
  out_ << row_text(compliant_frame, [](const Column& column) { return column.name; })
       << row_text(compliant_frame, [](const Column& column) { return column.unit; }) << std::flush;
}

void CurveWriter::write(const CurveRow& row) {
  // Adding zero turns -0 into 0.
  out_ << row_text(compliant_frame_, [&](const Column& column) {
    return column.value ? format_number(row.*column.value + 0.0) : phase_name(row.phase);
  }) << std::flush;
  if (!out_) throw CannotWrite(file_);
  ++rows_;
}

std::vector<CurveRow> read_curve(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InvalidInput::cannot_read(file);
  return read_curve(in, file);
}

std::vector<CurveRow> read_curve(std::istream& in, const std::string& file) {
  TextRows text(in);
  std::array<std::string, 2> head;  // names and units
  for (std::string& row : head) {
    if (!text.next())
      throw InvalidInput::sentence("rows", "a curve.csv begins with a row of names and a row of units").in_file(file);
    row = text.text();
  }
  const std::vector<std::string_view> names = cells(head[0]);
  const std::vector<std::string_view> units = cells(head[1]);
  std::array<std::optional<std::size_t>, kColumns.size()> places;
  std::transform(kColumns.begin(), kColumns.end(), places.begin(),
                 [&](const Column& column) { return place(file, names, units, column); });

  std::vector<CurveRow> rows;
  while (text.next()) {
    const std::string key = "row " + std::to_string(text.number());
    const std::vector<std::string_view> values = cells(text.text());
    if (values.size() != names.size())
      throw InvalidInput::sentence(key, key + " has " + std::to_string(values.size()) + " columns, but must have " +
                                            std::to_string(names.size()) + " as row 1 has")
          .in_file(file);
    CurveRow row;
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (!places[i]) continue;
      const std::string_view cell = values[*places[i]];
      const std::optional<double> number = kColumns[i].value ? parse_number(cell) : std::nullopt;
      const std::optional<Phase> phase = kColumns[i].value ? std::nullopt : phase_named(std::string(cell));
      if (!number && !phase)
        throw InvalidInput(file, key + ": " + kColumns[i].name, "\"" + std::string(cell) + "\"",
                           kColumns[i].value ? "a number" : "a phase of a test, such as pull");
      if (number) row.*kColumns[i].value = *number;
      if (phase) row.phase = *phase;
    }
    rows.push_back(row);
  }
  if (!text.fault().empty()) throw InvalidInput::sentence("rows", text.fault()).in_file(file);
  return rows;
}

void write_centreline(const std::string& file, const Points& points, const std::vector<int>& cuts) {
  std::ofstream out;
  open(out, file);
  out << (cuts.empty() ? "x,y,z\nm,m,m\n" : "x,y,z,rope\nm,m,m,-\n");
  int rope = 0;
  for (const Piece& piece : pieces_between(points.cols(), cuts)) {
    const std::string end = cuts.empty() ? "\n" : ',' + std::to_string(++rope) + '\n';
    for (Eigen::Index i = piece.begin; i < piece.end; ++i)
      out << format_number(points(0, i)) << ',' << format_number(points(1, i)) << ',' << format_number(points(2, i))
          << end;
  }
  out.close();
  if (!out) throw CannotWrite(file);
}

std::string curve_file_of(const std::string& given, std::optional<int> specimen) {
  std::error_code error;
  const std::filesystem::path folder(given);
  if (!std::filesystem::is_directory(folder, error)) return given;
  const auto refuse = [&](const std::string& why) { return InvalidInput::sentence("folder", why).in_file(given); };
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
    throw InvalidInput::sentence("names",
                                 "the file is no curve.csv; import_instron makes one of what a testing machine exports")
        .in_file(file);
  std::vector<CurveRow> rows = read_curve(file);
  const auto pulled = [](const CurveRow& row) { return pulls(row.phase); };
  const auto first = std::find_if(rows.begin(), rows.end(), pulled);
  if (first == rows.end()) return {};
  const std::string why = "there is no extension to follow: pull instead, and compare the test with ";
  if (!has_travel(rows)) throw InvalidInput::sentence("extension", why + shown(file)).in_file(file);
  const auto begin = first == rows.begin() ? first : first - 1;
  if (begin != first && balanced_between(*begin, *first))
    begin->extension = begin->crosshead_travel = 0.0;  // zero is where it stood
  const auto behind = std::find_if(rows.rbegin(), rows.rend(), pulled).base();
  auto end = rows.end();
  for (auto row = begin; row != end; ++row) {
    const std::string reading = "reading " + std::to_string(row - rows.begin() + 1);
    if (!std::isfinite(row->time) || !std::isfinite(row->extension))
      throw InvalidInput::sentence(reading, reading + " has no time or no extension").in_file(file);
    if (row == begin) continue;
    if (row->time < (row - 1)->time)
      throw InvalidInput::sentence(reading, "time goes back at " + reading + ", from " +
                                                format_number((row - 1)->time) + " s to " + format_number(row->time) +
                                                " s")
          .in_file(file);
    if (row->phase != Phase::kBalance && (row - 1 == begin || !balanced_between(*(row - 1), *row))) continue;
    if (row < behind)
      throw InvalidInput::sentence(reading,
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
