#pragma once

#include <string>
#include <vector>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// The dotted key of a number of a method, as overrides name it, and its unit.
struct KeyUnit {
  std::string key;
  std::string unit;  ///< "-": dimensionless
};

/// All numbers that this method may have, whether set or not. The keys of a program step are listed with the step's
/// index and name, and with its name alone where that occurs once.
std::vector<KeyUnit> key_units(const Method& method);

/// The unit of the number at a dotted key of the method: "m/s" for "program.pull.speed". Empty where the method has no
/// such number.
std::string unit_of_key(const Method& method, const std::string& key);

}  // namespace knot_utm
