#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <vector>

#include "config_library.hpp"
#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// Writes overrides, each "dotted.key=YAML", into the map of a method. `option`: what messages call them. A key inside
/// a material or load cell that is given by name changes a copy of it. Overrides whose keys have fewer parts are
/// applied first; others keep the order given.
void apply_overrides(YAML::Node root, const std::vector<std::string>& overrides, const std::string& option,
                     const ConfigLibrary& library);

/// Who gave the value that a key has, the nearest to the user last: a material's file or nobody, the method, an
/// override of a whole section, an override of the key.
enum class GivenBy { kOther, kMethod, kSection, kOverride };

/// `method`: the map before the overrides.
GivenBy given_by(const std::string& key, const YAML::Node& method, const std::vector<std::string>& overrides);

/// The value at a dotted key; undefined where there is none.
YAML::Node value_at(const YAML::Node& root, const std::string& key);

/// Takes away the keys of a material and of friction that a choice nearer to the user has left without effect: what a
/// material's file says of its own bending law where an override chooses another one; its resistance to rolling where
/// the method or an override has strands that do not roll or rub; its soft section where one needs a round one. The
/// last two are told in `overruled`. Who gives both in one place has them refused (check_method). `given`: the method's
/// map before the overrides.
void drop_overruled_keys(const YAML::Node& given, const std::vector<std::string>& overrides, Method& method);

/// What `rolling_resistance` of this material takes to have an effect, and lacks. `section`: that of the material, with
/// a dot.
std::string what_rolling_takes(const Material& material, const PhysicsOptions& physics, const std::string& section);

/// What a soft section of this material does not go with, and the keys that say so.
struct NeedsRound {
  std::string where;
  std::vector<std::string> keys;
};
std::optional<NeedsRound> needs_round(const Material& material, const PhysicsOptions& physics,
                                      const std::string& section);

/// A law has the plain values of its own keys that were not given. Keys of other laws, which have no effect, go.
void keep_own_keys(Method& method);

/// Replaces the material of the other ropes by one that `change` has changed.
template <class Change>
void change_other(Material& material, const Change& change) {
  Material other = *material.other;
  change(other);
  material.other = std::make_shared<const Material>(std::move(other));
}

}  // namespace knot_utm
