#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/program/program.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/options.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

enum class ForceUnit { kNewton, kKilonewton, kPoundForce };
enum class LengthUnit { kMillimetre, kInch, kMetre };

/// What a report says in addition to the results. None of it changes a number of the test. The test's files stay in SI
/// units.
struct ReportOptions {
  std::string specimen_id;
  std::string standard;
  std::string conditioning;  ///< of the specimens before the test
  std::string terminations;  ///< of the specimen's ends in the grips
  std::string notes;
  ForceUnit force = ForceUnit::kNewton;
  LengthUnit length = LengthUnit::kMillimetre;
};

/// A requirement on one number of result.yaml, in the unit of that file. At least one of the limits is set.
struct Requirement {
  std::string key;
  std::optional<double> min;
  std::optional<double> max;
};

/// The requirements in the order of the method. Empty: there are none.
using Specification = std::vector<Requirement>;

/// The `ends` section of a method: what ends a test before its program does. A rod that parts, the end of the
/// crosshead's travel (`machine.travel`) and the operator end it in any case.
struct EndOptions {
  std::optional<double> load;                       ///< load limit [N]; unset: the cell's capacity
  std::optional<double> time;                       ///< [s]
  std::optional<double> break_at_fraction_of_peak;  ///< the load has fallen to this fraction of its peak [-]
};

/// How a value of the method scatters from specimen to specimen. With x0 the value in the method and d the spread:
///
///     normal      x0 (1 + d z), where z is standard normal, limited to 3 standard deviations; d is the cv
///     log_normal  x0 exp(d z), with the same z
///     uniform     x0 (1 + d u), where u is uniform from -1 to 1
enum class ScatterLaw { kNormal, kLogNormal, kUniform };

struct Scatter {
  std::string key;  ///< dotted key of the method, as `--set` takes it
  ScatterLaw law = ScatterLaw::kNormal;
  double spread = 0.0;  ///< d [-]
};

inline constexpr int kMostSpecimens = 10000;

/// The `specimens` section of a method: how many specimens are tested, and how they differ.
struct SpecimensOptions {
  int count = 1;
  unsigned seed = 1;
  std::vector<Scatter> scatter;
};

/// A test method with everything resolved: the content of a method file.
struct Method {
  std::string name;  ///< name of the method file, without folder and extension
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;
  Program program;
  EndOptions ends;
  PhysicsOptions physics;
  ReportOptions report;
  Specification specification;
  SpecimensOptions specimens;
  std::map<std::string, std::string>
      automatic;                       ///< dotted keys whose values `auto` gave, and these as they are written
  std::vector<std::string> overruled;  ///< what nearer keys left without effect and took away, a sentence each
};

/// Reads a method file. Materials and load cells are given as maps, or by the name of a file in materials/ or
/// load_cells/ of the method's own folder, its config/, its ../config, the current folder, or what comes with the
/// package (shipped_folders). After reading, `specimen.preload` and the load cell are resolved, and `specimen.file` and
/// the records that are followed are absolute paths. Records are not read, nor is a specification compared with the
/// results that there are: load_test (run/load_test.hpp) does that.
///
/// Each override has the form "dotted.key=YAML", as `--set` takes it; `option`: what messages call it. An entry of a
/// list is named by its index from 0 or, in the program, by the name of the step ("program.pull.speed"). A key inside a
/// material or load cell that is given by name changes a copy of it. Overrides whose keys have fewer parts are applied
/// first; others keep the order given.
///
/// Throws InvalidInput with one line that names file, key, value and what is allowed.
Method load_method(const std::string& file, const std::vector<std::string>& overrides = {},
                   const std::string& option = "--set");

/// The same for the text of a method. `file`: the path of the text, or the path that it would have.
Method parse_method(const std::string& text, const std::string& file, const std::vector<std::string>& overrides = {},
                    const std::string& option = "--set");

/// The method as YAML. `load_method` reads it back to the same method. It contains every value, so no other files are
/// needed than `specimen.file` and records that are followed.
std::string method_yaml(const Method& method);

/// The number that `method_yaml` of a single specimen has at a dotted key, as overrides name it; empty: none.
std::optional<double> number_at(const Method& method, const std::string& key);

/// Checks values that must go together, as `load_method` does. Throws InvalidInput.
void check_method(const Method& method);

}  // namespace knot_utm
