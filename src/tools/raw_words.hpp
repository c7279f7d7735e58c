#pragma once

#include <CLI/CLI.hpp>

#include "knot_utm/io/raw_options.hpp"

namespace knot_utm {

/// The options with which a user says how raw data are to be read.
struct RawWords : RecordWords {
  void add_to(CLI::App& app, const char* help_on_specimen) {
    app.add_option("--columns", columns, kColumnsHelp);
    app.add_option("--units", units, kUnitsHelp);
    app.add_option("--specimen", specimen, help_on_specimen);
    app.add_flag("--invert{falling}", invert, kInvertHelp);
  }
};

}  // namespace knot_utm
