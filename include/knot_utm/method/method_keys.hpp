#pragma once

#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// A key of a method, as overrides, a report and the page of the keys name it.
struct MethodKey {
  std::string key;              ///< dotted: "machine.load_cell.noise"; of a step "program.pull.speed"
  std::string unit = "-";       ///< "-": dimensionless
  bool number = false;          ///< or a list of numbers
  std::optional<double> value;  ///< of a number; empty: not set
  bool experimental = false;    ///< no shipped method uses it, so that it may still change or go
  std::string label;            ///< in words
  std::string note;             ///< more words, for the page alone
  std::string otherwise;  ///< what it is where a method does not give it: "required", "`none`", "`auto`: 12 radii"
  std::string allowed;    ///< "0.0001 to 5" of its unit, names, "text"
  std::string with;       ///< the knots or laws that alone have it; empty: all
};

/// All numbers that this method may have, whether set or not. The keys of a program step are listed with the step's
/// index and name, and with its name alone where that occurs once.
std::vector<MethodKey> numbers_of(const Method& method);

/// The keys of a step of a program, with the path of the step before them.
std::vector<MethodKey> step_keys(ProgramStep step, const std::string& path);

/// The unit of the number at a dotted key of the method: "m/s" for "program.pull.speed". Empty where the method has no
/// such number.
std::string unit_of_key(const Method& method, const std::string& key);

/// Every key of specimen, material, machine, program, ends, physics and report that some method may have: those of all
/// knots, laws and steps, from their rows in method_fields.hpp.
std::vector<MethodKey> method_keys();

/// The same as CSV. The report reads it from `tensile_test --list-method-keys`, and
/// so does `scripts/tables` for doc/method.md.
std::string method_keys_csv();

/// What a report calls each knot, and the keys of `specimen` that it shows of it, as CSV: knot, title, keys. The
/// report reads it from `tensile_test --list-knots`.
std::string knots_csv();

}  // namespace knot_utm
