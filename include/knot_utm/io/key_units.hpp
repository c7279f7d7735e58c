#pragma once

#include <string>
#include <vector>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// A number of a method: its dotted key, as overrides name it, and its unit.
struct KeyUnit {
  std::string key;
  std::string unit;  ///< "-": none
};

/// All numbers that this method may have, set or not. A step of the program goes by its number and name, and by its
/// name alone where that stands once.
std::vector<KeyUnit> key_units(const Method& method);

/// The unit of the number at a dotted key of the method, as overrides name it: "m/s" for "program.pull.speed". Empty
/// where the method has no number of that name.
std::string unit_of_key(const Method& method, const std::string& key);

}  // namespace knot_utm
