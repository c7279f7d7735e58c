#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// A key that a method may have, as a report shows it.
struct MethodKey {
  std::string key;    ///< dotted: "machine.load_cell.noise"; of a step by its name: "program.pull.speed"
  std::string label;  ///< in words
  std::string unit;   ///< as method_fields.hpp has it; "-": none
};

/// Every key of specimen, material, machine, program, ends and physics that some method may have: those of all knots,
/// laws and steps. Their names and units come from the fields of a method (method_fields.hpp). A key is called by its
/// name in words, unless the table of labels in method_keys.cpp has better ones.
std::vector<MethodKey> method_keys();

/// The same as CSV: key, label, unit. The report reads it from `tensile_test --list-method-keys`.
std::string method_keys_csv();

/// What a report calls each knot, and the keys of `specimen` that it shows of it, as CSV: knot, title, keys. The
/// report reads it from `tensile_test --list-knots`.
std::string knots_csv();

}  // namespace knot_utm
