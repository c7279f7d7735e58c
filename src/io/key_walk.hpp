#pragma once

#include <string>
#include <vector>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// A key of a method that a walk over its fields came by.
struct WalkedKey {
  std::string key;   ///< dotted, as overrides name it
  std::string unit;  ///< "-": none
  bool number;
};

/// All keys of specimen, material, machine, program, ends and physics that this method may have, in the order of its
/// fields. A list of numbers is followed by its entries. A step goes by its number and, where that stands once, by its
/// name.
std::vector<WalkedKey> walked_keys(const Method& method);

}  // namespace knot_utm
