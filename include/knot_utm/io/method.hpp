#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/io/analysis_options.hpp"
#include "knot_utm/io/report_options.hpp"
#include "knot_utm/io/specimens_options.hpp"
#include "knot_utm/machine/end_options.hpp"
#include "knot_utm/machine/options.hpp"
#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/record/program.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// A whole test, everything resolved: what a method file says.
struct Method {
  std::string name;  ///< the method file's name without folder and ending
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;
  Program program;
  EndOptions ends;
  PhysicsOptions physics;
  AnalysisOptions analysis;
  ReportOptions report;
  Specification specification;
  SpecimensOptions specimens;
};

/// Reads a method file. Materials and load cells are found by name in
///   1. the method's own folder, its config/ and its ../config (materials/NAME.yaml, load_cells/NAME.yaml),
///   2. share/knot_utm/config of the installation the running executable belongs to,
///   3. the config/ of the sources it was built from,
/// or stand in the method as maps. After reading, `specimen.preload` and the load cell are resolved and
/// `specimen.file`, `report.logo` and the records that are followed are absolute paths.
///
/// Each override is "dotted.key=YAML", as `--set` takes them. The key of a list's entry is its number from 0 or the
/// step's name ("program.pull.speed"). A key inside a material or load cell given by name changes a copy of it. Short
/// paths are applied before long ones, else in the order given.
///
/// Throws InvalidInput, one line that names file, key, value and what is allowed: file missing, longer than 64 KiB or
/// not YAML, unknown or repeated key, wrong type, value out of range, or values that do not go together.
Method load_method(const std::string& file, const std::vector<std::string>& overrides = {});

/// The same of a method's text; `file` is where it stands, or would.
Method parse_method(const std::string& text, const std::string& file, const std::vector<std::string>& overrides = {});

/// The method as YAML that `load_method` reads back to the same: every value stands in it, no other file is needed
/// but `specimen.file`, `report.logo` and records.
std::string method_yaml(const Method& method);

/// The number that `method_yaml` of a single specimen has at a dotted key, as overrides name it
/// ("program.pull.speed"); nothing where no
/// number stands there.
std::optional<double> number_at(const Method& method, const std::string& key);

/// Its program, for a physics whose longest step is `longest_step` [s].
ProgramRunner make_program(const Method& method, double longest_step);

/// The checks of values that must go together, as `load_method` makes them. Throws InvalidInput.
void check_method(const Method& method);

}  // namespace knot_utm
