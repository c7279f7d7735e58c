#include "knot_utm/raw/raw_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

/// "the load falls from 0.1 to -9 N".
std::string fall(const std::vector<CurveRow>& rows, double CurveRow::*value, const char* name, double unit,
                 const char* unit_name) {
  double lowest = rows.front().*value;
  for (const CurveRow& row : rows) lowest = std::min(lowest, row.*value);
  return std::string("the ") + name + " falls from " + short_number(rows.front().*value / unit) + " to " +
         short_number(lowest / unit) + ' ' + unit_name;
}

void turn(std::vector<CurveRow>& rows, double CurveRow::*value) {
  for (CurveRow& row : rows) row.*value = -(row.*value);
}

int parse_specimen(const std::string& text, const RawSpelling& spelling, std::size_t file, std::size_t files) {
  const std::size_t comma = text.find(',');
  const std::string own = comma == std::string::npos ? text
                          : file == 0                ? text.substr(0, comma)
                                                     : text.substr(comma + 1);
  const std::optional<double> number = parse_number(own);
  constexpr int kMost = 100000;
  if ((comma != std::string::npos && files < 2) || !number || !(*number >= 1 && *number <= kMost) ||
      *number != std::floor(*number))
    throw InvalidInput(spelling.option("specimen"), text,
                       files < 2 ? "a number from 1 on" : "a number from 1 on, or one for each file: 1,2");
  return static_cast<int>(*number);
}

}  // namespace

std::string RawSpelling::invert(const std::string& what) const {
  if (!invert_is_flag) return option("invert", what.empty() ? "falling" : what);
  return option("invert") + (what.empty() ? "" : '=' + what);
}

std::string without_effect(const RecordWords& words, const RawSpelling& spelling, bool one_of_many) {
  std::vector<std::string> given;
  if (!words.columns.empty()) given.push_back(spelling.option("columns"));
  if (!words.units.empty()) given.push_back(spelling.option("units"));
  if (!words.invert.empty()) given.push_back(spelling.option("invert"));
  if (!words.specimen.empty() && !one_of_many) given.push_back(spelling.option("specimen"));
  return given.empty() ? "" : listed(given, " and ") + (given.size() == 1 ? " changes nothing" : " change nothing");
}

RawOptions raw_options(const RecordWords& words, const RawSpelling& spelling, std::size_t file, std::size_t files) {
  RawOptions out;
  out.spelling = spelling;
  if (!words.columns.empty()) out.columns = parse_raw_columns(words.columns, spelling.option("columns"));
  if (!words.units.empty()) out.units = parse_raw_columns(words.units, spelling.option("units"));
  if (!words.invert.empty()) out.invert = parse_invert(words.invert, spelling.option("invert"));
  if (!words.specimen.empty()) out.specimen = parse_specimen(words.specimen, spelling, file, files);
  return out;
}

RawColumns parse_raw_columns(const std::string& text, const std::string& key) {
  constexpr const char* kForm = "time=NAME,extension=NAME,load=NAME, or one or two of these";
  constexpr std::array<std::pair<const char*, std::string RawColumns::*>, 3> kQuantities{
      {{"time=", &RawColumns::time}, {"extension=", &RawColumns::extension}, {"load=", &RawColumns::load}}};
  RawColumns out;
  std::string* current = nullptr;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, comma - begin);
    std::string* next = nullptr;
    for (const auto& [word, name] : kQuantities)
      if (part.rfind(word, 0) == 0) {
        next = &(out.*name);
        if (!next->empty()) throw InvalidInput(key, text, std::string("a list with ") + word + " only once");
        *next = part.substr(std::string(word).size());
      }
    if (!next && !current) throw InvalidInput(key, text.empty() ? "\"\"" : text, kForm);
    if (!next) *current += ',' + part;
    if (next) current = next;
    if (current->empty()) throw InvalidInput(key, text, kForm);
    begin = comma + 1;
  }
  return out;
}

Invert parse_invert(const std::string& text, const std::string& key) {
  constexpr std::array<std::pair<const char*, Invert>, 4> kWords{{{"falling", Invert::kWhatFalls},
                                                                  {"extension", Invert::kExtension},
                                                                  {"load", Invert::kLoad},
                                                                  {"both", Invert::kBoth}}};
  for (const auto& [word, invert] : kWords)
    if (text == word) return invert;
  throw InvalidInput(key, text, "falling, extension, load or both");
}

Falling what_falls(const std::vector<CurveRow>& rows) {
  const auto falls = [&](double CurveRow::*value) {
    double up = 0.0, down = 0.0;
    for (const CurveRow& row : rows) {
      up = std::max(up, row.*value - rows.front().*value);
      down = std::max(down, rows.front().*value - row.*value);
    }
    return down > up;
  };
  return {falls(&CurveRow::extension), falls(&CurveRow::load)};
}

void turn_signs(std::vector<CurveRow>& rows, const RawOptions& options, const std::string& file, const Tell& tell) {
  if (rows.empty()) return;
  const Invert invert = options.invert;
  const auto said = [&](const char* what) { return options.spelling.invert(what); };
  const Falling falling = what_falls(rows);
  if (invert == Invert::kWhatFalls && !falling.extension && !falling.load) {
    if (tell)
      tell(file + ": nothing falls, and " + said("") + " turns nothing; " + said("load") + ", " + said("extension") +
           " or " + said("both") + " turn what they name");
    return;
  }
  if (invert == Invert::kNothing) {
    if (!tell || (!falling.extension && !falling.load)) return;
    std::string what;
    if (falling.extension) what = fall(rows, &CurveRow::extension, "extension", 1e-3, "mm");
    if (falling.load) what += (what.empty() ? "" : ", and ") + fall(rows, &CurveRow::load, "load", 1.0, "N");
    return tell(file + ": " + what + ", as in compression or where the sign is another one: " + said("") + " turns it");
  }
  const bool all = invert == Invert::kBoth, found = invert == Invert::kWhatFalls;
  std::string turned;
  if (all || invert == Invert::kExtension || (found && falling.extension)) {
    turn(rows, &CurveRow::extension);
    turned = "extension";
  }
  if (all || invert == Invert::kLoad || (found && falling.load)) {
    turn(rows, &CurveRow::load);
    turned += turned.empty() ? "load" : " and load";
  }
  if (tell) tell(file + ": the sign of " + turned + " is turned");
}

}  // namespace knot_utm
