#include "knot_utm/io/key_units.hpp"

#include "key_walk.hpp"

namespace knot_utm {

std::vector<KeyUnit> key_units(const Method& method) {
  std::vector<KeyUnit> found;
  for (const WalkedKey& one : walked_keys(method))
    if (one.number) found.push_back({one.key, one.unit});
  return found;
}

std::string unit_of_key(const Method& method, const std::string& key) {
  for (const KeyUnit& one : key_units(method))
    if (one.key == key) return one.unit;
  return "";
}

}  // namespace knot_utm
