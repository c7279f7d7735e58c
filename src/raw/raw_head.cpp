#include "raw_head.hpp"

#include <algorithm>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/raw/raw_text.hpp"

namespace knot_utm {
namespace {

constexpr std::size_t kTime = 0, kExtension = 1, kLoad = 2;

/// A cell of the row of names: "Load (N)", or "Load" and no unit.
struct Name {
  std::string name;
  std::optional<std::string> unit;
};

Name name_of(const std::string& cell) {
  const std::size_t bracket = cell.find_last_of("([");
  if (bracket != std::string::npos && bracket > 0) {
    const std::string unit = cell.substr(bracket);
    if (unit != without_brackets(unit)) return {trimmed(cell.substr(0, bracket)), without_brackets(unit)};
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

/// A name without the number of a specimen or a channel: "C_1_load", "specimen 2: load", "load 1", "load (1)",
/// "load.1".
std::string without_number(const std::string& name) {
  constexpr const char* kDigits = "0123456789";
  constexpr const char* kBetween = " _.:-/#";
  constexpr std::size_t kNone = std::string::npos, kLongest = 12;  // word before the number
  const std::size_t first = name.find_first_of(kDigits);
  if (first == kNone) return name;
  const std::size_t behind = name.find_first_not_of(kDigits, first), next = name.find_first_not_of(kBetween, behind);
  if (behind != kNone && next != kNone && next > behind && first <= kLongest) return name.substr(next);
  const bool in_brackets = name.back() == ')';
  std::size_t last = name.find_last_not_of(kDigits, name.size() - (in_brackets ? 2 : 1));
  if (last == kNone || (in_brackets && (name[last] != '(' || last == 0)) || (!in_brackets && last + 1 == name.size()))
    return name;
  if (in_brackets) --last;
  last = name.find_last_not_of(kBetween, last);
  return last == kNone ? name : name.substr(0, last + 1);
}

std::optional<std::size_t> number_in(const std::string& given) {
  if (given.empty() || given.size() > 4 || given.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return static_cast<std::size_t>(*parse_number(given));
}

RawColumn labelled(const RawQuantity& quantity, const std::string& cell, std::size_t place) {
  RawColumn out;
  out.place = place;
  out.label = cell;
  out.unit = name_of(cell).unit;
  if (!out.unit)
    if (const auto other = name_before_unit(quantity, cell)) out.unit = other->unit;
  return out;
}

std::optional<RawColumn> as_column(const RawQuantity& quantity, const std::string& given, const std::string& cell,
                                   std::size_t place) {
  RawColumn out = labelled(quantity, cell, place);
  if (const auto number = number_in(given)) {
    if (place + 1 != *number) return std::nullopt;
    return out;
  }
  std::vector<Name> readings;
  for (const std::string& text : {cell, without_number(cell)}) {
    readings.push_back(name_of(text));
    readings.push_back({text, std::nullopt});
    if (const auto other = name_before_unit(quantity, text)) readings.push_back(*other);
  }
  for (const Name& name : readings) {
    const std::string whole = folded(name.name), base = without_number(whole);
    out.unit = name.unit;
    out.base = base;
    if (!given.empty()) {
      if (whole == folded(given)) return out;
      continue;
    }
    for (const std::string* key : {&whole, &base}) {
      const auto known = quantity.ranks.find(*key);
      if (known == quantity.ranks.end()) continue;
      out.rank = 2 * known->second + (key == &base ? 1 : 0);
      out.base = *key == whole ? whole : base;
      out.of_machine = known->second >= quantity.machines;
      return out;
    }
  }
  return std::nullopt;
}

/// Those of a row that may have a quantity, best first: one with a unit of another kind, such as "Displacement (Strain
/// 1)", is that of another channel.
std::vector<RawColumn> columns_in(std::size_t quantity, const std::string& given, const Cells& cells) {
  const RawQuantity& of = raw_quantities()[quantity];
  std::vector<RawColumn> suitable, other;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (const auto column = as_column(of, given, cells[i], i))
      (!column->unit || si_of(of, *column->unit) || !given.empty() ? suitable : other).push_back(*column);
  if (suitable.empty()) suitable = std::move(other);
  std::stable_sort(suitable.begin(), suitable.end(),
                   [](const RawColumn& a, const RawColumn& b) { return a.rank / 2 < b.rank / 2; });
  return suitable;
}

/// Those of the same name as the best one.
std::vector<RawColumn> alike(const std::vector<RawColumn>& columns, const std::string& base) {
  std::vector<RawColumn> out;
  for (const RawColumn& column : columns)
    if (column.base == base) out.push_back(column);
  std::stable_sort(out.begin(), out.end(), [](const RawColumn& a, const RawColumn& b) { return a.place < b.place; });
  return out;
}

std::vector<RawColumn> best_alike(const std::vector<RawColumn>& columns) {
  return columns.empty() ? columns : alike(columns, columns.front().base);
}

RawHead head_of(const Cells& names, std::size_t index, char separator, const RawColumns& given) {
  RawHead head;
  head.names_row = index;
  head.first = index + 1;
  head.separator = separator;
  head.cells = names.size();
  for (std::size_t i = 0; i < head.columns.size(); ++i) head.columns[i] = columns_in(i, given[i], names);
  return head;
}

/// Some programs begin the row of names with the mark of a comment.
std::string uncommented(const std::string& row) {
  const std::size_t begin = row.find_first_not_of(' ');
  if (begin == std::string::npos || (row[begin] != '#' && row[begin] != '%')) return row;
  return row.substr(std::min(row.find_first_not_of("#% ", begin), row.size()));
}

Cells names_in(const std::string& row, char separator) {
  return separator == ' ' ? split_names(uncommented(row)) : split(uncommented(row), separator);
}

bool is_complete(const RawHead& head, bool with_time) {
  return !head.columns[kExtension].empty() && !head.columns[kLoad].empty() &&
         (!with_time || !head.columns[kTime].empty());
}

/// Whether none of the cells is a number and one says something.
bool are_words(const Cells& cells, const std::vector<std::size_t>& places) {
  bool some = false;
  for (const std::size_t place : places) {
    if (place >= cells.size() || has_digit(cells[place])) return false;
    some |= !cells[place].empty();
  }
  return some;
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
std::string missing_names(const RawHead& head, const RawColumns& given, const Cells& cells, bool with_time) {
  std::string out;
  for (std::size_t i = with_time ? kTime : kExtension; i < head.columns.size(); ++i) {
    if (!head.columns[i].empty()) continue;
    const std::string& own = given[i];
    out += (out.empty() ? "" : "; ") + std::string(raw_quantities()[i].name) + ", whose known names are ";
    out += own.empty() ? some_of(raw_quantities()[i].names, cells) : '"' + shown(own) + "\" alone";
  }
  return out;
}

}  // namespace

std::string without_brackets(const std::string& text) {
  if (text.size() < 2) return text;
  const char first = text.front(), last = text.back();
  if (!((first == '(' && last == ')') || (first == '[' && last == ']'))) return text;
  return trimmed(std::string_view(text).substr(1, text.size() - 2));
}

std::size_t RawHead::specimens() const {
  const std::size_t loads = best_alike(columns[kLoad]).size();
  return loads == best_alike(columns[kExtension]).size() ? loads : 1;
}

RawChoice RawHead::of_specimen(std::size_t specimen) const {
  RawChoice out;
  for (const std::size_t i : {kExtension, kLoad}) {
    const std::vector<RawColumn> all = best_alike(columns[i]);
    out[i] = specimens() > 1 ? all[specimen] : columns[i].front();
  }
  const std::vector<RawColumn> times = best_alike(columns[kTime]);
  if (times.empty()) return out;
  // That of its own, else the nearest on the left, else the common one.
  out[kTime] = times.front();
  for (const RawColumn& time : times)
    if (time.place < std::min(out[kExtension]->place, out[kLoad]->place)) out[kTime] = time;
  if (times.size() == specimens()) out[kTime] = times[specimen];
  return out;
}

std::vector<RawColumn> RawHead::others(std::size_t quantity, std::size_t specimen) const {
  const RawChoice own = of_specimen(specimen);
  std::vector<RawColumn> out;
  for (const RawColumn& column : columns[quantity]) {
    const std::vector<RawColumn> same = alike(columns[quantity], column.base);
    const bool of_another = specimens() > 1 && same.size() == specimens() && same[specimen].place != column.place;
    if (column.place != own[quantity]->place && !of_another) out.push_back(column);
  }
  return out;
}

std::optional<RawHead> head_in(const std::string& row, std::size_t index, const RawColumns& given, bool with_time) {
  for (const char separator : kSeparators) {
    const Cells cells = names_in(row, separator);
    if (cells.size() < (with_time ? 3u : 2u)) continue;
    RawHead head = head_of(cells, index, separator, given);
    if (is_complete(head, with_time)) return head;
  }
  return std::nullopt;
}

std::optional<RawHead> head_by_numbers(const std::vector<std::string>& rows, const RawColumns& given, bool with_time) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < raw_quantities().size(); ++i) {
    const std::string& text = given[i];
    const auto number = number_in(text);
    if (i == kTime && text.empty() && !with_time) continue;
    if (!number || *number == 0) return std::nullopt;
    places.push_back(*number - 1);
  }
  const auto are_numbers = [&](const Cells& cells) {
    return std::all_of(places.begin(), places.end(),
                       [&](std::size_t place) { return place < cells.size() && is_number(cells[place]); });
  };
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (const char separator : kSeparators) {
      const Cells numbers = split(rows[row], separator);
      if (!are_numbers(numbers)) continue;
      RawHead head = head_of(Cells(numbers.size()), row, separator, given);
      head.names_row.reset();
      head.first = row;
      // At most two rows of words stand above. The upper one has the names, and a single one also the units, if any.
      for (std::size_t above = row; above > 0 && row - above < 2; --above) {
        const Cells cells = names_in(rows[above - 1], separator);
        if (!are_words(cells, places)) break;
        const RawHead named = head_of(cells, above - 1, separator, given);
        const bool has_units = si_of(raw_quantities()[kLoad], without_brackets(cells[places.back()])).has_value();
        head.columns = named.columns;
        head.first = has_units ? above - 1 : above;
        head.cells = std::max(head.cells, cells.size());
        if (!has_units) {
          head.names_row = above - 1;
          break;
        }
      }
      return head;
    }
  return std::nullopt;
}

std::string nearest_head(const std::vector<std::string>& rows, const RawColumns& given, bool with_time) {
  std::string out;
  std::ptrdiff_t most = -1;
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (const char separator : kSeparators) {
      const Cells cells = names_in(rows[row], separator);
      if (cells.size() < 2 || std::all_of(cells.begin(), cells.end(), has_digit)) continue;
      const RawHead head = head_of(cells, row, separator, given);
      const auto named = std::count_if(head.columns.begin(), head.columns.end(),
                                       [](const std::vector<RawColumn>& columns) { return !columns.empty(); });
      if (named <= most || (named == 0 && (cells.size() < 3 || separator == ' '))) continue;
      most = named;
      out = "row " + std::to_string(row + 1) + " is \"" + shown(rows[row]) + "\" and does not name " +
            missing_names(head, given, cells, with_time);
    }
  return out;
}

}  // namespace knot_utm
