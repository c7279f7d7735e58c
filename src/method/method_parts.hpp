#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "config_library.hpp"
#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// Writes overrides into the map of a method, as load_method says.
void apply_overrides(YAML::Node root, const std::vector<std::string>& overrides, const std::string& option,
                     const ConfigLibrary& library);

/// Who gave the value that a key has, the nearest to the user last: a material's file or nobody, the method, an
/// override of a whole section, an override of the key.
enum class GivenBy { kOther, kMethod, kSection, kOverride };

/// `method`: the map before the overrides.
GivenBy given_by(const std::string& key, const YAML::Node& method, const std::vector<std::string>& overrides);

/// The value at a dotted key; undefined where there is none.
YAML::Node value_at(const YAML::Node& root, const std::string& key);

/// The checks of check_method on keys that another choice leaves without effect, and on what two materials share, as
/// nothing in a time step tells them apart by it.
void check_effects(const Method& method);
void check_other_material(const Method& method);

/// Takes away the keys of a material and of friction that a choice nearer to the user has left without effect: what a
/// material's file says of its own bending law where an override chooses another one; its resistance to rolling where
/// the method or an override has strands that do not roll or rub; its soft section where one needs a round one. The
/// last two are told in `overruled`. Who gives both in one place has them refused (check_method). `given`: the method's
/// map before the overrides.
void drop_overruled_keys(const YAML::Node& given, const std::vector<std::string>& overrides, Method& method);

/// A law has the plain values of its own keys that were not given. Keys of other laws, which have no effect, go.
void keep_own_keys(Method& method);

/// Replaces the material of the other ropes by one that `change` has changed, where there are two materials.
template <class Change>
void change_other(Material& material, const Change& change) {
  if (!material.other) return;
  Material other = *material.other;
  change(other);
  material.other = std::make_shared<const Material>(std::move(other));
}

/// Reads the `specimens` section. `automatic` is true where it says `scatter: auto`; default_scatter then gives the
/// values that scatter: those that a person cannot reproduce exactly from one specimen of this method to the next.
SpecimensOptions read_specimens(const YAML::Node& node, const std::string& file, bool& automatic);
std::vector<Scatter> default_scatter(const Method& method);

/// Checks that every key that scatters is a number of the method.
void check_scatter(const Method& method);

YAML::Node specimens_map(const SpecimensOptions& specimens);

}  // namespace knot_utm
