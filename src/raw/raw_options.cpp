#include "knot_utm/raw/raw_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

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
  out.invert = words.invert;
  if (!out.invert.empty() && out.invert != "falling" && out.invert != "extension" && out.invert != "load" &&
      out.invert != "both")
    throw InvalidInput(spelling.option("invert"), out.invert, "falling, extension, load or both");
  if (!words.specimen.empty()) out.specimen = parse_specimen(words.specimen, spelling, file, files);
  return out;
}

RawColumns parse_raw_columns(const std::string& text, const std::string& key) {
  constexpr const char* kForm = "time=NAME,extension=NAME,load=NAME, or one or two of these";
  constexpr std::array<const char*, 3> kQuantities{"time=", "extension=", "load="};
  RawColumns out;
  std::string* current = nullptr;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    std::string part = text.substr(begin, comma - begin);
    const auto word = std::find_if(kQuantities.begin(), kQuantities.end(),
                                   [&](const char* begins) { return part.rfind(begins, 0) == 0; });
    if (word != kQuantities.end()) {
      current = &out[static_cast<std::size_t>(word - kQuantities.begin())];
      if (!current->empty()) throw InvalidInput(key, text, std::string("a list with ") + *word + " only once");
      part.erase(0, std::string(*word).size());
    } else if (current) {
      part.insert(0, ",");  // a name may have one
    }
    if (!current || (*current + part).empty()) throw InvalidInput(key, text.empty() ? "\"\"" : text, kForm);
    *current += part;
    begin = comma + 1;
  }
  return out;
}

bool falls(const std::vector<CurveRow>& rows, double CurveRow::*value) {
  double up = 0.0, down = 0.0;
  for (const CurveRow& row : rows) {
    up = std::max(up, row.*value - rows.front().*value);
    down = std::max(down, rows.front().*value - row.*value);
  }
  return down > up;
}

void turn_signs(std::vector<CurveRow>& rows, const RawOptions& options, const std::string& file, const Tell& tell) {
  struct Quantity {
    const char* name;
    double CurveRow::*value;
    double unit;
    const char* unit_name;
  };
  const std::string& asked = options.invert;
  const auto said = [&](const char* what) { return options.spelling.invert(what); };
  std::vector<std::string> turned, falling;
  for (const Quantity& one :
       {Quantity{"extension", &CurveRow::extension, 1e-3, "mm"}, Quantity{"load", &CurveRow::load, 1.0, "N"}}) {
    const bool down = falls(rows, one.value);
    if (asked == one.name || asked == "both" || (asked == "falling" && down)) {
      for (CurveRow& row : rows) row.*one.value = -(row.*one.value);
      turned.emplace_back(one.name);
    } else if (down && asked.empty()) {
      double lowest = rows.front().*one.value;
      for (const CurveRow& row : rows) lowest = std::min(lowest, row.*one.value);
      falling.push_back(std::string("the ") + one.name + " falls from " +
                        short_number(rows.front().*one.value / one.unit) + " to " + short_number(lowest / one.unit) +
                        ' ' + one.unit_name);
    }
  }
  if (!tell || rows.empty()) return;
  if (!turned.empty())
    tell(file + ": the sign of " + listed(turned, " and ") + " is turned");
  else if (!falling.empty())
    tell(file + ": " + listed(falling, ", and ") + ", as in compression or where the sign is another one: " + said("") +
         " turns it");
  else if (asked == "falling")
    tell(file + ": nothing falls, and " + said("") + " turns nothing; " + said("load") + ", " + said("extension") +
         " or " + said("both") + " turn what they name");
}

}  // namespace knot_utm
