#include "knot_utm/raw/raw_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/numeric/text_rows.hpp"
#include "knot_utm/raw/raw_cells.hpp"
#include "knot_utm/raw/raw_text.hpp"
#include "knot_utm/record/sample.hpp"
#include "raw_head.hpp"
#include "raw_names.hpp"

namespace knot_utm {
namespace {

using Rows = std::vector<std::string>;

Rows rows_of(const std::string& meaning, const std::string& file) {
  std::istringstream text(meaning);
  TextRows rows(text);
  Rows out;
  while (rows.next()) out.push_back(rows.text());
  join_quoted(out);
  if (!rows.fault().empty()) throw InvalidInput::sentence("rows", "too many", rows.fault()).in_file(file);
  return out;
}

/// "row 7".
std::string row_name(std::size_t index) { return "row " + std::to_string(index + 1); }

/// One specimen of one table.
class RawTable {
 public:
  RawTable(const Rows& rows, RawHead head, std::size_t end, std::size_t specimen, const RawOptions& options,
           const std::string& file)
      : rows_(rows), head_(std::move(head)), end_(end), specimen_(specimen), options_(options), file_(file) {
    columns_ = head_.of_specimen(specimen);
    if (columns_[1]->place == columns_[2]->place)
      throw InvalidInput(options.spelling.option("columns"), options.columns[1] + " and " + options.columns[2],
                         "another column for the extension than for the load");
    while (head_.first < end_ && are_empty(cells(head_.first))) ++head_.first;
    find_units();
    find_decimals();
    prefer_crosshead();
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i]) si_[i] = si(i, *columns_[i]);
  }

  std::vector<CurveRow> read() {
    std::vector<CurveRow> out;
    for (std::size_t i = head_.first; i < end_; ++i) {
      const Cells all = cells(i);
      const Cells own = wanted(all);
      if (own[1].empty() && own[2].empty()) {
        ++empty_;
        continue;
      }
      require_named(all, i);
      const CurveRow row = row_of(own, i);
      if (!out.empty() && row.time < out.back().time)
        refuse(i, ": " + shown(name(0)) + " goes back to " + shown(own.front()));
      if (!out.empty() && is_same(row, out.back())) {
        ++repeated_;
        continue;
      }
      out.push_back(row);
      places_.push_back(i);
    }
    if (out.empty()) throw InvalidInput::sentence("rows", "none", "no row of numbers follows the names").in_file(file_);
    leave_out_jumps(out);
    return out;
  }

  /// What was read, from which columns, and what was not.
  void tell(std::size_t readings, std::size_t specimens, const Tell& say) const {
    std::string line = file_ + ": " + std::to_string(readings) + (readings == 1 ? " reading" : " readings");
    if (specimens > 1) line += " of specimen " + std::to_string(options_.specimen) + " of " + std::to_string(specimens);
    const char* between = ": ";
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!columns_[i]) continue;
      line += std::string(between) + raw_quantities()[i].name + " is " + described(i);
      between = ", ";
    }
    if (!columns_[0]) line += "; no column of time";
    if (repeated_ > 0) line += "; rows left out that repeat the one before: " + std::to_string(repeated_);
    if (empty_ > 0) line += "; empty rows: " + std::to_string(empty_);
    say(line);
    for (const auto& column : columns_)
      if (column && column->base.rfind("compressi", 0) == 0)
        say(file_ + ": \"" + shown(column->label) + "\" is the name of a test in compression; its sign is kept");
    for (const std::string& note : notes_) say(file_ + ": " + note);
  }

 private:
  Cells cells(std::size_t row) const { return split(rows_[row], head_.separator); }

  Cells wanted(const Cells& cells) const {
    Cells out(columns_.size());
    for (std::size_t i = 0; i < out.size(); ++i)
      if (columns_[i] && columns_[i]->place < cells.size()) out[i] = cells[columns_[i]->place];
    return out;
  }

  std::string name(std::size_t quantity) const {
    const RawColumn& column = *columns_[quantity];
    return column.label.empty() ? "column " + std::to_string(column.place + 1) : column.label;
  }

  /// "column 2, "Extension (mm)"", and its unit where its name does not have it.
  std::string described(std::size_t quantity) const {
    const RawColumn& column = *columns_[quantity];
    std::string out = "column " + std::to_string(column.place + 1);
    if (!column.label.empty()) out += " \"" + shown(column.label) + '"';
    if (!column.unit || !options_.units[quantity].empty()) out += " in " + shown(unit_of(quantity, column));
    return out;
  }

  /// The row of units below the names, or else above them.
  void find_units() {
    if (head_.first < end_) {
      const Cells below = wanted(cells(head_.first));
      if (std::none_of(below.begin(), below.end(), has_digit)) {
        below_ = cells(head_.first++);
        return;
      }
    }
    if (!head_.names_row || *head_.names_row == 0) return;
    const Cells above = cells(*head_.names_row - 1);
    const Cells own = wanted(above);
    for (std::size_t i = 0; i < own.size(); ++i)
      if (columns_[i] && !si_of(raw_quantities()[i], without_brackets(own[i]))) return;
    below_ = above;
  }

  void find_decimals() {
    for (std::size_t i = head_.first; i < end_ && !mark_.is_told(); ++i)
      for (const std::string& cell : wanted(cells(i))) mark_.look_at(cell);
    // Where commas separate the cells, a point is the mark of decimals.
    const bool clear = head_.separator == ',' && mark_.unclear().find('.') != std::string::npos;
    if (!mark_.unclear().empty() && !clear)
      throw InvalidInput::sentence("decimals", mark_.unclear(),
                                   "the number " + shown(mark_.unclear()) +
                                       " may have decimals or thousands behind its mark, and no other number of the "
                                       "file tells which: a zero more behind its decimals would")
          .in_file(file_);
  }

  /// The unit of the column as the user or the file gives it; empty where nobody does.
  std::string unit_of(std::size_t quantity, const RawColumn& column) const {
    const std::string& own = options_.units[quantity];
    if (!own.empty()) return own;
    return column.unit.value_or(column.place < below_.size() ? without_brackets(below_[column.place]) : "");
  }

  double si(std::size_t quantity, const RawColumn& column) const {
    const RawQuantity& of = raw_quantities()[quantity];
    const std::string unit = unit_of(quantity, column), own = options_.units[quantity];
    const std::string allowed = of.allowed,
                      key = own.empty()
                                ? "the unit of " + (column.label.empty() ? "" : std::string("column ")) + name(quantity)
                                : options_.spelling.option("units");
    if (unit.empty())
      throw InvalidInput::missing(key,
                                  allowed + ", by " + options_.spelling.option("units", std::string(of.name) + "=UNIT"))
          .in_file(file_);
    const std::optional<double> si = si_of(of, unit);
    if (!si && own.empty()) throw InvalidInput(file_, key, unit, allowed);
    if (!si) throw InvalidInput(key, std::string(of.name) + '=' + unit, allowed);
    const std::string below = column.place < below_.size() ? without_brackets(below_[column.place]) : "";
    if (own.empty() && !below.empty() && si_of(of, below) != si)
      throw InvalidInput(file_, key, below + " below the name", "the same as in the name, " + unit);
    return *si;
  }

  /// How far a column of extension goes [m]; empty where it has no unit or no numbers.
  std::optional<double> travel(const RawColumn& column) const {
    const std::optional<double> si = si_of(raw_quantities()[1], unit_of(1, column));
    std::optional<double> low, high;
    for (std::size_t i = head_.first; si && i < end_; ++i) {
      const Cells all = cells(i);
      const auto value = column.place < all.size() ? number(all[column.place], mark_.mark()) : std::nullopt;
      if (!value) continue;
      low = std::min(low.value_or(*value), *value);
      high = std::max(high.value_or(*value), *value);
    }
    return low ? std::optional<double>((*high - *low) * *si) : std::nullopt;
  }

  /// Where what is called an extension goes another way than the crosshead, it is that of an extensometer.
  void prefer_crosshead() {
    constexpr double kAlike = 0.05;
    std::vector<RawColumn> others = head_.others(1, specimen_);
    const std::optional<double> own = travel(*columns_[1]);
    for (RawColumn& other : others) {
      const std::optional<double> way = travel(other);
      if (!own || !way || columns_[1]->of_machine || !other.of_machine) continue;
      if (std::abs(*way - *own) > kAlike * std::max(*way, *own)) std::swap(*columns_[1], other);
    }
    for (const RawColumn& other : others)
      if (const auto way = travel(other))
        note_unread(1, other, ", which goes over " + short_number(1e3 * *way) + " mm,");
    for (const RawColumn& other : head_.others(2, specimen_)) note_unread(2, other, "");
  }

  void note_unread(std::size_t quantity, const RawColumn& column, const std::string& what) {
    const std::string number = std::to_string(column.place + 1);
    notes_.push_back("column " + number + " \"" + shown(column.label) + '"' + what + " is not read; " +
                     options_.spelling.option("columns", std::string(raw_quantities()[quantity].name) + '=' + number) +
                     " would read it");
  }

  /// Whose cells have a name each: a decimal comma that is not in quotes would make two of one.
  void require_named(const Cells& all, std::size_t row) const {
    const std::size_t named = std::min(head_.cells, all.size());
    if (!are_empty(Cells(all.begin() + static_cast<std::ptrdiff_t>(named), all.end())))
      refuse(row, " has " + std::to_string(all.size()) + " cells, but must have " + std::to_string(head_.cells) +
                      " as there are names; a number with a decimal comma must stand in quotes");
  }

  CurveRow row_of(const Cells& own, std::size_t row_index) const {
    CurveRow row;
    row.time = Sample::kNone;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (!columns_[i]) continue;
      const double value = number(own[i], mark_.mark()).value_or(Sample::kNone) * si_[i];
      if (!std::isfinite(value))
        refuse(row_index, ": " + shown(name(i)) + " is \"" + shown(own[i]) + "\", but must be a number with \"" +
                              mark_.mark() + "\" before its decimals");
      row.*raw_quantities()[i].value = value;
    }
    row.end_to_end = row.load_lower = Sample::kNone;
    row.phase = Phase::kPull;
    return row;
  }

  /// Single readings whose extension lies far off those before and behind them, on the same side: no crosshead goes
  /// there and back from one reading to the next.
  void leave_out_jumps(std::vector<CurveRow>& rows) {
    constexpr double kFar = 5.0;  // times the usual step
    std::vector<double> steps;
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (const double step = std::abs(rows[i].extension - rows[i - 1].extension); step > 0.0) steps.push_back(step);
    if (steps.size() < 5) return;
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
    const double usual = steps[steps.size() / 2];
    std::vector<std::size_t> jumps;
    for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
      const double before = rows[i].extension - rows[i - 1].extension,
                   behind = rows[i].extension - rows[i + 1].extension;
      if (before * behind <= 0.0 || std::min(std::abs(before), std::abs(behind)) <= kFar * usual) continue;
      jumps.push_back(i++);  // the one behind it lies far off this one only
    }
    note_jumps(jumps, rows);
    std::size_t kept = 0;
    auto jump = jumps.begin();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (jump != jumps.end() && *jump == i) {
        ++jump;
      } else {
        rows[kept++] = rows[i];
      }
    }
    rows.resize(kept);
  }

  void note_jumps(const std::vector<std::size_t>& jumps, const std::vector<CurveRow>& rows) {
    constexpr std::size_t kNamed = 5;
    for (std::size_t i = 0; i < std::min(jumps.size(), kNamed); ++i)
      notes_.push_back(row_name(places_[jumps[i]]) + ", whose extension of " +
                       short_number(1e3 * rows[jumps[i]].extension) +
                       " mm lies far off the readings before and behind it, is left out");
    if (jumps.size() <= kNamed) return;
    const std::size_t others = jumps.size() - kNamed;
    notes_.push_back(std::to_string(others) + (others == 1 ? " other row is left out for the same reason"
                                                           : " other rows are left out for the same reason"));
  }

  static bool is_same(const CurveRow& a, const CurveRow& b) {
    const bool at_once = a.time == b.time || (std::isnan(a.time) && std::isnan(b.time));
    return at_once && a.extension == b.extension && a.load == b.load;
  }

  /// `why` goes on with the sentence that begins with the row.
  [[noreturn]] void refuse(std::size_t row, const std::string& why) const {
    throw InvalidInput::sentence(row_name(row), why, row_name(row) + why).in_file(file_);
  }

  const Rows& rows_;
  RawHead head_;
  std::size_t end_, specimen_;
  const RawOptions& options_;
  const std::string& file_;
  RawChoice columns_;
  Cells below_;  // the row of units
  std::array<double, 3> si_{};
  DecimalMark mark_;
  std::vector<std::size_t> places_;  // rows of the readings
  std::size_t empty_ = 0, repeated_ = 0;
  std::vector<std::string> notes_;
};

/// A head and the end of its table.
struct Place {
  RawHead head;
  std::size_t end;
};

/// Tables below each other, each with names of its own. Text between two of them belongs to none.
std::vector<Place> tables_from(const Rows& rows, const RawHead& first, const RawOptions& options) {
  std::vector<Place> out{{first, rows.size()}};
  const bool with_time = !first.columns[0].empty();
  for (std::size_t row = first.first; first.names_row && row < rows.size(); ++row) {
    const std::size_t load = out.back().head.columns[2].front().place;
    const Cells cells = split(rows[row], first.separator);
    if (load < cells.size() && is_number(cells[load])) continue;
    const auto head = head_in(rows[row], row, options.columns, with_time);
    if (!head) continue;
    std::size_t end = row;
    const auto is_reading = [&](const std::string& text) {
      const Cells own = split(text, out.back().head.separator);
      return load < own.size() && is_number(own[load]);
    };
    while (end > out.back().head.first && !is_reading(rows[end - 1])) --end;
    out.back().end = end;
    out.push_back({*head, rows.size()});
  }
  return out;
}

/// "side by side", or "in tables that begin with rows 1, 45 and 90".
std::string where(const std::vector<Place>& tables) {
  if (tables.size() == 1) return "side by side";
  std::vector<std::string> begins;
  for (const Place& table : tables) begins.push_back(std::to_string(*table.head.names_row + 1));
  return "in tables that begin with rows " + listed(begins, " and ");
}

/// The table and the place in it of the specimen that is asked for, from 0.
std::pair<Place, std::size_t> chosen(const std::vector<Place>& tables, std::size_t all, const RawOptions& options,
                                     const std::string& file) {
  const int wanted = options.specimen;
  const RawSpelling& spelling = options.spelling;
  if (wanted == 0 && all > 1)
    throw InvalidInput::sentence("specimens", std::to_string(all),
                                 "the file holds " + std::to_string(all) + " specimens, " + where(tables) +
                                     ": choose one by " + spelling.option("specimen", "1 to ") + std::to_string(all))
        .in_file(file);
  std::size_t left = wanted == 0 ? 0 : static_cast<std::size_t>(wanted - 1);
  for (const Place& table : tables) {
    if (left < table.head.specimens()) return {table, left};
    left -= table.head.specimens();
  }
  throw InvalidInput::sentence("specimens", std::to_string(wanted),
                               spelling.option("specimen") + " is " + std::to_string(wanted) + ", but the file holds " +
                                   std::to_string(all) + (all == 1 ? " specimen" : " specimens"))
      .in_file(file);
}

std::optional<RawHead> first_head(const Rows& rows, const RawColumns& given, bool with_time) {
  if (auto head = head_by_numbers(rows, given, with_time)) return head;
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (auto head = head_in(rows[row], row, given, with_time)) return head;
  return std::nullopt;
}

}  // namespace

std::vector<CurveRow> read_raw_data(const std::string& content, const std::string& file, const RawOptions& options,
                                    const Tell& tell) {
  if (const std::string why = why_no_text(content); !why.empty())
    throw InvalidInput::sentence("text", "none", why).in_file(file);
  std::string nearest;
  const std::vector<std::string> meanings = meanings_of(content);
  for (const bool with_time : {true, false}) {
    if (!with_time && (options.needs_time || !options.columns[0].empty())) break;
    for (const std::string& meaning : meanings) {
      const Rows rows = rows_of(meaning, file);
      const auto head = first_head(rows, options.columns, with_time);
      if (!head) {
        if (nearest.empty()) nearest = nearest_head(rows, options.columns, options.needs_time);
        continue;
      }
      const std::vector<Place> tables = tables_from(rows, *head, options);
      std::size_t all = 0;
      for (const Place& table : tables) all += table.head.specimens();
      const auto [place, specimen] = chosen(tables, all, options, file);
      RawTable table(rows, place.head, place.end, specimen, options, file);
      std::vector<CurveRow> out = table.read();
      std::string falling;
      turn_signs(out, options, file, [&](const std::string& line) { falling = line; });
      if (tell) table.tell(out.size(), all, tell);
      if (tell && !falling.empty()) tell(falling);
      return out;
    }
  }
  throw InvalidInput::sentence("names", "none",
                               std::string("no row names the columns ") + (options.needs_time ? "time, " : "") +
                                   "extension and load" + (nearest.empty() ? "" : "; " + nearest) + "; " +
                                   options.spelling.option("columns") + " takes other names, or numbers, such as " +
                                   options.spelling.option("columns", "time=1,extension=2,load=3"))
      .in_file(file);
}

}  // namespace knot_utm
