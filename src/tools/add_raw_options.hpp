#pragma once

#include <CLI/CLI.hpp>

#include "knot_utm/raw/raw_options.hpp"

namespace knot_utm {

/// Adds the options with which a user says how raw data are to be read.
inline void add_raw_options(CLI::App& app, RecordWords& words, const char* help_on_specimen) {
  app.add_option("--columns", words.columns, kColumnsHelp);
  app.add_option("--units", words.units, kUnitsHelp);
  app.add_option("--specimen", words.specimen, help_on_specimen);
  app.add_flag("--invert{falling}", words.invert, kInvertHelp);
}

}  // namespace knot_utm
