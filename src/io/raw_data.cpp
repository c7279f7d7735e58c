#include "knot_utm/io/raw_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/numeric/text_rows.hpp"
#include "raw_names.hpp"
#include "raw_text.hpp"

namespace knot_utm {
namespace {

using Cells = std::vector<std::string>;

// ---- cells ----------------------------------------------------------------------------------------------------------

std::string trimmed(std::string_view text) {
  constexpr const char* kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin));
}

Cells split(const std::string& row, char separator) {
  Cells cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool twice = quoted && row[i] == '"' && i + 1 < row.size() && row[i + 1] == '"';
    if (twice)
      cells.back() += row[i++];
    else if (row[i] == '"')
      quoted = !quoted;
    else if (row[i] == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += row[i];
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

// ---- names and units ------------------------------------------------------------------------------------------------

/// What a user calls time, extension and load; empty where the known names are to do.
using Names = std::array<std::string, 3>;

std::optional<double> si_of(const RawQuantity& quantity, const std::string& unit) {
  if (unit == "MN") return std::nullopt;  // mega is not milli
  for (const RawUnit& known : quantity.units)
    if (is_name(unit, known.name)) return known.si;
  return std::nullopt;
}

/// "(mm)" or "[mm]" without its brackets; nothing where there are none.
std::optional<std::string> bracketed(const std::string& text) {
  if (text.size() < 2) return std::nullopt;
  const char first = text.front(), last = text.back();
  if (!((first == '(' && last == ')') || (first == '[' && last == ']'))) return std::nullopt;
  return trimmed(std::string_view(text).substr(1, text.size() - 2));
}

/// A cell of the row of names: "Load (N)", or "Load" and no unit.
struct Name {
  std::string name;
  std::optional<std::string> unit;
};

Name name_of(const std::string& cell) {
  const std::size_t bracket = cell.find_last_of("([");
  if (bracket != std::string::npos && bracket > 0) {
    if (const auto unit = bracketed(cell.substr(bracket))) return {trimmed(cell.substr(0, bracket)), unit};
  }
  return {cell, std::nullopt};
}

/// "Time sec", "Force_kN" and "Force/kN", where what stands behind is a unit of the quantity.
std::optional<Name> name_before_unit(const RawQuantity& quantity, const std::string& cell) {
  constexpr const char* kBetween = " _/,";
  const std::size_t between = cell.find_last_of(kBetween);
  if (between == std::string::npos || between == 0) return std::nullopt;
  const std::string unit = cell.substr(between + 1);
  const std::size_t end = cell.find_last_not_of(kBetween, between);
  if (end == std::string::npos || !si_of(quantity, unit)) return std::nullopt;
  return Name{cell.substr(0, end + 1), unit};
}

/// Where a column stands and what its numbers are in.
struct Column {
  const RawQuantity* quantity;
  std::size_t place;
  std::string name;                 // as given
  std::optional<std::string> unit;  // that behind the name
};

/// The cell, where it is of this name.
std::optional<Column> column_named(const RawQuantity& quantity, const std::string& known, const std::string& cell,
                                   std::size_t place) {
  const Name name = name_of(cell);
  if (is_name(name.name, known) || is_name(cell, known)) return Column{&quantity, place, visible(cell), name.unit};
  const std::optional<Name> other = name_before_unit(quantity, cell);
  if (other && is_name(other->name, known)) return Column{&quantity, place, visible(cell), other->unit};
  return std::nullopt;
}

/// The one of the machine's own name; of two alike that with a unit of this quantity: the other may be a strain
/// gauge's, "Displacement (Strain 1)".
std::optional<Column> find(const RawQuantity& quantity, const std::string& given, const Cells& cells) {
  std::vector<std::string> names = quantity.names;
  if (!given.empty()) names = {given};
  std::optional<Column> best;
  for (const std::string& known : names) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::optional<Column> column = column_named(quantity, known, cells[i], i);
      if (!column) continue;
      if (!column->unit || si_of(quantity, *column->unit)) return column;
      if (!best) best = column;
    }
  }
  return best;
}

using Columns = std::array<Column, 3>;
using Found = std::array<std::optional<Column>, 3>;

Found columns_in(const Cells& cells, const Names& given) {
  Found found;
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = find(raw_quantities()[i], given[i], cells);
  return found;
}

std::optional<Columns> all_of(const Found& found) {
  if (!std::all_of(found.begin(), found.end(), [](const auto& column) { return column.has_value(); }))
    return std::nullopt;
  return Columns{*found[0], *found[1], *found[2]};
}

/// A handful of the known names, those first that a cell nearly is.
std::string some_of(const std::vector<std::string>& known, const Cells& cells) {
  constexpr std::size_t kHandful = 4;
  std::vector<std::string> some;
  const auto add = [&](const std::string& name) {
    const bool is_new = std::find(some.begin(), some.end(), name) == some.end();
    if (!name.empty() && is_new && some.size() < kHandful) some.push_back(name);
  };
  for (const std::string& cell : cells) add(nearest_name(name_of(cell).name, known));
  for (const std::string& name : known) add(name);
  return listed(some, ", ") + " and " + std::to_string(known.size() - some.size()) + " others";
}

/// What the row does not name, and names that it might have, for the message.
std::string missing_names(const Found& found, const Names& given, const Cells& cells) {
  std::string out;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i]) continue;
    out += (out.empty() ? "" : "; ") + std::string(raw_quantities()[i].name) + ", whose known names are ";
    out += given[i].empty() ? some_of(raw_quantities()[i].names, cells) : '"' + shown(given[i]) + "\" alone";
  }
  return out;
}

// ---- numbers --------------------------------------------------------------------------------------------------------

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool has_digit(const std::string& cell) { return std::any_of(cell.begin(), cell.end(), is_digit); }

/// 1,234,567 without its marks; what has none as it is; nothing where they stand elsewhere.
std::optional<std::string> without_groups(const std::string& whole, char mark) {
  const std::size_t first = whole.find(mark);
  if (first == std::string::npos) return whole;
  const std::size_t begin = whole[0] == '-' || whole[0] == '+' ? 1 : 0;
  if (first == begin || first > begin + 3 || whole[begin] == '0' || (whole.size() - first) % 4 != 0)
    return std::nullopt;
  std::string out = whole.substr(0, begin);
  for (std::size_t i = begin; i < whole.size(); ++i) {
    const bool between = i >= first && (i - first) % 4 == 0;
    if (between ? whole[i] != mark : !is_digit(whole[i])) return std::nullopt;
    if (!between) out += whole[i];
  }
  return out;
}

/// The mark of decimals in a file: the first cell that tells it counts for all.
class DecimalMark {
 public:
  void look_at(const std::string& cell) {
    if (is_told()) return;
    const std::size_t point = cell.rfind('.'), comma = cell.rfind(',');
    if (point != std::string::npos && comma != std::string::npos) {
      told_ = point > comma ? '.' : ',';
    } else if (point != comma) {
      const char mark = point != std::string::npos ? '.' : ',';
      const bool twice = std::count(cell.begin(), cell.end(), mark) > 1;
      if (twice)
        told_ = mark == '.' ? ',' : '.';
      else if (!without_groups(cell, mark))
        told_ = mark;
      else if (unclear_.empty())
        unclear_ = cell;
    }
  }

  bool is_told() const { return told_.has_value(); }
  char mark() const { return told_.value_or('.'); }
  /// A number of three digits behind a mark, where none tells whether it is of decimals; else empty.
  std::string unclear() const { return told_ ? std::string() : unclear_; }

 private:
  std::optional<char> told_;
  std::string unclear_;
};

std::optional<double> number(const std::string& cell, char mark) {
  const std::size_t decimals = std::min(cell.find(mark), cell.size());
  std::optional<std::string> text = without_groups(cell.substr(0, decimals), mark == '.' ? ',' : '.');
  if (text) text = without_groups(*text, ' ');
  if (!text) return std::nullopt;
  if (decimals < cell.size()) *text += '.' + cell.substr(decimals + 1);
  return has_digit(*text) ? parse_number(*text) : std::nullopt;
}

template <typename Iterator>
bool are_empty(Iterator begin, Iterator end) {
  return std::all_of(begin, end, [](const std::string& cell) { return cell.empty(); });
}

// ---- the file -------------------------------------------------------------------------------------------------------

struct Row {
  std::size_t number;  // in the file, from 1
  std::string text;
};

std::vector<Row> rows_of(const std::string& meaning, const std::string& file) {
  std::istringstream text(meaning);
  TextRows rows(text);
  std::vector<Row> out;
  while (rows.next()) out.push_back({rows.number(), rows.text()});
  if (!rows.fault().empty()) throw InvalidInput::sentence("rows", "too many", rows.fault()).in_file(file);
  return out;
}

/// The table in the file: what its columns are, and the cells of its rows.
class RawTable {
 public:
  RawTable(const std::string& content, const std::string& file, const Names& names) : file_(file), given_(names) {
    find_names(content);
    find_units();
    for (std::size_t i = next_; i < rows_.size() && !mark_.is_told(); ++i)
      for (const std::string& cell : wanted(split(rows_[i].text, separator_))) mark_.look_at(cell);
    if (!mark_.unclear().empty())
      throw InvalidInput::sentence("decimals", mark_.unclear(),
                                   "the number " + shown(mark_.unclear()) +
                                       " may have decimals or thousands behind its mark, and no other number of the "
                                       "file tells which")
          .in_file(file_);
  }

  std::vector<CurveRow> read() const {
    std::vector<CurveRow> out;
    for (std::size_t i = next_; i < rows_.size(); ++i) {
      const Cells all = split(rows_[i].text, separator_);
      const std::array<std::string, 3> cells = wanted(all);
      if (are_empty(cells.begin(), cells.end())) continue;
      require_named(all, rows_[i].number);
      if (!has_digit(cells[0]) && all_of(columns_in(all, given_)))
        refuse(rows_[i].number, " names the columns once more, but the file must hold one table");
      const CurveRow row = row_of(cells, rows_[i].number);
      if (!out.empty() && row.time < out.back().time)
        refuse(rows_[i].number, ": " + shown(columns_[0].name) + " goes back to " + shown(visible(cells[0])));
      if (out.empty() || !is_same(row, out.back())) out.push_back(row);
    }
    if (out.empty()) throw InvalidInput::sentence("rows", "none", "no row of numbers follows the names").in_file(file_);
    return out;
  }

 private:
  /// In the first of its meanings in which the file has them.
  void find_names(const std::string& content) {
    std::string nearest;
    for (const std::string& meaning : meanings_of(content)) {
      rows_ = rows_of(meaning, file_);
      if (find_row_of_names()) return;
      if (nearest.empty()) nearest = nearest_row();
    }
    throw InvalidInput::sentence("names", "none",
                                 "no row names the columns time, extension and load" +
                                     (nearest.empty() ? "" : "; " + nearest + "; other names are given by --columns"))
        .in_file(file_);
  }

  bool find_row_of_names() {
    for (next_ = 0; next_ < rows_.size(); ++next_)
      for (const char separator : kSeparators) {
        const Cells cells = split(rows_[next_].text, separator);
        if (cells.size() < columns_.size()) continue;
        if (const auto found = all_of(columns_in(cells, given_))) {
          columns_ = *found;
          separator_ = separator;
          names_ = cells.size();
          ++next_;
          return true;
        }
      }
    return false;
  }

  /// The first row that names the most columns, and which it does not name; of a file that names none, its first row of
  /// words in three columns or more.
  std::string nearest_row() const {
    std::string out;
    std::ptrdiff_t most = -1;
    for (const Row& row : rows_)
      for (const char separator : kSeparators) {
        const Cells cells = split(row.text, separator);
        if (cells.size() < columns_.size() || std::all_of(cells.begin(), cells.end(), has_digit)) continue;
        const Found found = columns_in(cells, given_);
        const auto named =
            std::count_if(found.begin(), found.end(), [](const auto& column) { return column.has_value(); });
        if (named <= most) continue;
        most = named;
        out = "row " + std::to_string(row.number) + " is \"" + shown(visible(row.text)) + "\" and does not name " +
              missing_names(found, given_, cells);
      }
    return out;
  }

  /// Those behind the names, or of the row below them.
  void find_units() {
    const auto is_empty = [&](const Row& row) {
      const Cells cells = split(row.text, separator_);
      return are_empty(cells.begin(), cells.end());
    };
    while (next_ < rows_.size() && is_empty(rows_[next_])) ++next_;
    std::array<std::string, 3> below;
    if (next_ < rows_.size()) below = wanted(split(rows_[next_].text, separator_));
    const bool has_units = std::none_of(below.begin(), below.end(), has_digit);
    if (has_units) ++next_;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      si_[i] = si(columns_[i], has_units ? bracketed(below[i]).value_or(below[i]) : "");
  }

  /// Whose cells have a name each: a decimal comma that is not in quotes would make two of one.
  void require_named(const Cells& cells, std::size_t row) const {
    const std::size_t named = std::min(names_, cells.size());
    if (!are_empty(cells.begin() + static_cast<std::ptrdiff_t>(named), cells.end()))
      refuse(row, " has " + std::to_string(cells.size()) + " cells, but must have " + std::to_string(names_) +
                      " as there are names; a number with a decimal comma must stand in quotes");
  }

  double si(const Column& column, const std::string& below) const {
    const std::string unit = column.unit.value_or(below);
    const std::string key = "the unit of column " + column.name, allowed = column.quantity->allowed;
    if (unit.empty()) throw InvalidInput::missing(key, allowed).in_file(file_);
    const std::optional<double> si = si_of(*column.quantity, unit);
    if (!si) throw InvalidInput(file_, key, unit, allowed);
    if (!below.empty() && si_of(*column.quantity, below) != si)
      throw InvalidInput(file_, key, below + " below the name", "the same as in the name, " + unit);
    return *si;
  }

  std::array<std::string, 3> wanted(const Cells& cells) const {
    std::array<std::string, 3> out;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (columns_[i].place < cells.size()) out[i] = cells[columns_[i].place];
    return out;
  }

  CurveRow row_of(const std::array<std::string, 3>& cells, std::size_t row_number) const {
    CurveRow row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double value = number(cells[i], mark_.mark()).value_or(Sample::kNone) * si_[i];
      if (!std::isfinite(value))
        refuse(row_number, ": " + shown(columns_[i].name) + " is \"" + shown(visible(cells[i])) +
                               "\", but must be a number with \"" + mark_.mark() + "\" before its decimals");
      row.*columns_[i].quantity->value = value;
    }
    row.end_to_end = row.load_lower = Sample::kNone;
    row.phase = Phase::kPull;
    return row;
  }

  static bool is_same(const CurveRow& a, const CurveRow& b) {
    return a.time == b.time && a.extension == b.extension && a.load == b.load;
  }

  /// `why` goes on with the sentence that begins with the row.
  [[noreturn]] void refuse(std::size_t row, const std::string& why) const {
    const std::string key = "row " + std::to_string(row);
    throw InvalidInput::sentence(key, why, key + why).in_file(file_);
  }

  static constexpr std::array<char, 3> kSeparators{';', '\t', ','};

  std::string file_;
  Names given_;
  std::vector<Row> rows_;
  std::size_t next_ = 0;  // that has not been read yet
  char separator_ = ',';
  std::size_t names_ = 0;  // how many columns have one
  Columns columns_;
  std::array<double, 3> si_{};
  DecimalMark mark_;
};

}  // namespace

std::vector<CurveRow> read_raw_data(const std::string& content, const std::string& file, const RawColumns& columns) {
  return RawTable(content, file, {columns.time, columns.extension, columns.load}).read();
}

}  // namespace knot_utm
