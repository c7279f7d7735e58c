#pragma once

#include <CLI/CLI.hpp>

#include "knot_utm/raw/raw_options.hpp"

namespace knot_utm {

/// Adds the options with which a user says how raw data are to be read.
inline void add_raw_options(CLI::App& app, RecordWords& words, const char* help_on_specimen) {
  app.add_option("--columns", words.columns,
                 "columns of raw data by name or number: time=NAME,extension=NAME,load=NAME, or one or two of these");
  app.add_option("--units", words.units, "units of raw data: time=s,extension=in,load=lbf, or one or two of these");
  app.add_option("--specimen", words.specimen, help_on_specimen);
  app.add_flag("--invert{falling}", words.invert,
               "turn the sign of what falls in the pull, or, as --invert=load, --invert=extension or --invert=both, of "
               "these");
}

}  // namespace knot_utm
