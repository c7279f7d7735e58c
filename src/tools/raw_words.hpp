#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>

#include "knot_utm/io/raw_options.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"

namespace knot_utm {

/// The options with which a user says how raw data are to be read.
struct RawWords {
  std::string columns, units, specimen, invert;

  void add_to(CLI::App& app, const char* help_on_specimen) {
    app.add_option(kColumnsOption, columns, kColumnsHelp);
    app.add_option(kUnitsOption, units, kUnitsHelp);
    app.add_option(kSpecimenOption, specimen, help_on_specimen);
    app.add_flag(std::string(kInvertOption) + "{falling}", invert, kInvertHelp);
  }

  /// Whether anything is said of columns, units or signs.
  bool says_how() const { return !columns.empty() || !units.empty() || !invert.empty(); }

  /// For the first of `files` files, or for the second. Throws InvalidInput.
  RawOptions options(std::size_t file = 0, std::size_t files = 1) const {
    RawOptions out;
    if (!columns.empty()) out.columns = parse_raw_columns(columns, kColumnsOption);
    if (!units.empty()) out.units = parse_raw_columns(units, kUnitsOption);
    if (!invert.empty()) out.invert = parse_invert(invert);
    if (specimen.empty()) return out;
    const std::size_t comma = specimen.find(',');
    const std::string text = comma == std::string::npos ? specimen
                             : file == 0                ? specimen.substr(0, comma)
                                                        : specimen.substr(comma + 1);
    const std::optional<double> number = parse_number(text);
    constexpr int kMost = 100000;
    if ((comma != std::string::npos && files < 2) || !number || *number < 1 || *number > kMost ||
        *number != static_cast<int>(*number))
      throw InvalidInput(kSpecimenOption, specimen,
                         files < 2 ? "a number from 1 on" : "a number from 1 on, or one for each file: 1,2");
    out.specimen = static_cast<int>(*number);
    return out;
  }
};

}  // namespace knot_utm
