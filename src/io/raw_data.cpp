#include "knot_utm/io/raw_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "knot_utm/io/number.hpp"
#include "knot_utm/rod/invalid_input.hpp"
#include "knot_utm/rod/text_rows.hpp"

namespace knot_utm {
namespace {

using Cells = std::vector<std::string>;

// ---- characters -----------------------------------------------------------------------------------------------------

constexpr char kForeign = '?';  // stands for every letter beyond ASCII, but for blanks that do not break a line

/// Two bytes a character, the high one first or second.
std::string from_utf16(const std::string& bytes, std::size_t high) {
  std::string out;
  for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const int upper = static_cast<unsigned char>(bytes[i + high]),
              lower = static_cast<unsigned char>(bytes[i + 1 - high]);
    const int letter = upper << 8 | lower;
    if (letter < 0x80)
      out += static_cast<char>(letter);
    else
      out += letter == 0xA0 || letter == 0x202F ? ' ' : kForeign;
  }
  return out;
}

/// Of a code page every byte is a letter.
std::string from_code_page(const std::string& bytes) {
  std::string out = bytes;
  for (char& c : out) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) c = byte == 0xA0 ? ' ' : kForeign;
  }
  return out;
}

/// Bytes that go on with a letter (10xxxxxx) are none of their own.
std::string from_utf8(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    if (byte < 0x80)
      out += bytes[i];
    else if ((byte & 0xC0) != 0x80)
      out += bytes.compare(i, 2, "\xC2\xA0") == 0 || bytes.compare(i, 3, "\xE2\x80\xAF") == 0 ? ' ' : kForeign;
  }
  return out;
}

/// Whether every letter beyond ASCII is whole: 110xxxxx 10xxxxxx and so on.
bool is_utf8(const std::string& bytes) {
  int missing = 0;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const bool goes_on = (byte & 0xC0) == 0x80;
    if (goes_on != (missing > 0)) return false;
    if (goes_on)
      --missing;
    else if (byte >= 0x80)
      missing = byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : 1;
  }
  return missing == 0;
}

/// The text in ASCII.
std::string decoded(const std::string& bytes) {
  const auto begins = [&](const char* mark) { return bytes.rfind(mark, 0) == 0; };
  if (begins("\xFF\xFE")) return from_utf16(bytes, 1);
  if (begins("\xFE\xFF")) return from_utf16(bytes, 0);
  if (begins("\xEF\xBB\xBF")) return from_utf8(bytes.substr(3));
  return is_utf8(bytes) ? from_utf8(bytes) : from_code_page(bytes);
}

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

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

// ---- names and units ------------------------------------------------------------------------------------------------

struct Unit {
  const char* name;
  double si;
};

/// What a column may hold. Letters beyond ASCII are '?'.
struct Quantity {
  const char* name;
  double CurveRow::*value;
  std::vector<const char*> names;  // the machine's own first
  std::vector<Unit> units;
  const char* allowed;
};

const std::array<Quantity, 3>& quantities() {
  static const std::array<Quantity, 3> all{
      {{"time",
        &CurveRow::time,
        {"time", "zeit", "czas", "godzina", "temps"},
        {{"s", 1.0}, {"sec", 1.0}, {"ms", 1e-3}, {"min", 60.0}, {"h", 3600.0}},
        "ms, s, sec, min or h"},
       {"extension",
        &CurveRow::extension,
        {"extension", "displacement", "crosshead displacement", "traversenweg", "verl?ngerung", "przemieszczenie",
         "wyd?u?enie", "d?placement", "deplacement", "d?placement de la traverse", "allongement", "tensile extension",
         "tensile displacement"},
        {{"mm", 1e-3}, {"m", 1.0}, {"cm", 1e-2}, {"um", 1e-6}, {"?m", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}},
        "um, mm, cm, m, in or ft"},
       {"load",
        &CurveRow::load,
        {"load", "force", "last", "kraft", "obci??enie", "obciazenie", "si?a", "sila", "charge"},
        {{"n", 1.0},
         {"kn", 1e3},
         {"mn", 1e-3},
         {"cn", 1e-2},
         {"gf", 9.80665e-3},
         {"kgf", 9.80665},
         {"lbf", 4.4482216152605}},
        "mN, cN, N, kN, gf, kgf or lbf"}}};
  return all;
}

std::optional<double> si_of(const Quantity& quantity, const std::string& unit) {
  if (unit == "MN") return std::nullopt;  // mega is not milli
  for (const Unit& known : quantity.units)
    if (lower(unit) == known.name) return known.si;
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
    if (const auto unit = bracketed(cell.substr(bracket))) return {lower(trimmed(cell.substr(0, bracket))), unit};
  }
  return {lower(cell), std::nullopt};
}

/// Where a column stands and what its numbers are in.
struct Column {
  const Quantity* quantity;
  std::size_t place;
  std::string name;                 // as given
  std::optional<std::string> unit;  // that behind the name
};

/// The one of the machine's own name; of two alike that with a unit of this quantity: the other may be a strain
/// gauge's, "Displacement (Strain 1)".
std::optional<Column> find(const Quantity& quantity, const Cells& cells) {
  std::optional<Column> best;
  for (const char* known : quantity.names) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Name name = name_of(cells[i]);
      if (name.name != known) continue;
      if (!name.unit || si_of(quantity, *name.unit)) return Column{&quantity, i, cells[i], name.unit};
      if (!best) best = Column{&quantity, i, cells[i], name.unit};
    }
  }
  return best;
}

using Columns = std::array<Column, 3>;

std::optional<Columns> find_columns(const Cells& cells) {
  std::array<std::optional<Column>, 3> found;
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i] = find(quantities()[i], cells);
    if (!found[i]) return std::nullopt;
  }
  return Columns{*found[0], *found[1], *found[2]};
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

std::vector<Row> rows_of(const std::string& content, const std::string& file) {
  std::istringstream text(decoded(content));
  TextRows rows(text);
  std::vector<Row> out;
  while (rows.next()) out.push_back({rows.number(), rows.text()});
  if (!rows.fault().empty()) throw InvalidInput::sentence("rows", "too many", rows.fault()).in_file(file);
  return out;
}

/// The table in the file: what its columns are, and the cells of its rows.
class RawTable {
 public:
  RawTable(const std::string& content, const std::string& file) : file_(file), rows_(rows_of(content, file)) {
    find_names();
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
      if (!has_digit(cells[0]) && find_columns(all))
        refuse(rows_[i].number, " names the columns once more, but the file must hold one table");
      const CurveRow row = row_of(cells, rows_[i].number);
      if (!out.empty() && row.time < out.back().time)
        refuse(rows_[i].number, ": " + shown(columns_[0].name) + " goes back to " + shown(cells[0]));
      if (out.empty() || !is_same(row, out.back())) out.push_back(row);
    }
    if (out.empty()) throw InvalidInput::sentence("rows", "none", "no row of numbers follows the names").in_file(file_);
    return out;
  }

 private:
  void find_names() {
    for (; next_ < rows_.size(); ++next_)
      for (const char separator : {';', '\t', ','})
        if (const auto found = find_columns(split(rows_[next_].text, separator))) {
          columns_ = *found;
          separator_ = separator;
          names_ = split(rows_[next_].text, separator).size();
          ++next_;
          return;
        }
    throw InvalidInput::sentence("names", "none", "no row names the columns time, extension and load").in_file(file_);
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
        refuse(row_number, ": " + shown(columns_[i].name) + " is \"" + shown(cells[i]) +
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

  std::string file_;
  std::vector<Row> rows_;
  std::size_t next_ = 0;  // that has not been read yet
  char separator_ = ',';
  std::size_t names_ = 0;  // how many columns have one
  Columns columns_;
  std::array<double, 3> si_{};
  DecimalMark mark_;
};

}  // namespace

std::vector<CurveRow> read_raw_data(const std::string& content, const std::string& file) {
  return RawTable(content, file).read();
}

}  // namespace knot_utm
