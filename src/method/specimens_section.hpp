#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "knot_utm/method/method.hpp"

/// The `specimens` section of a method.
namespace knot_utm {

/// Reads the section. `automatic` is true where it says `scatter: auto`; default_scatter then gives the values that
/// scatter.
SpecimensOptions read_specimens(const YAML::Node& node, const std::string& file, bool& automatic);

/// The default scatter: of the values that a person cannot reproduce exactly from one specimen of this method to the
/// next.
std::vector<Scatter> default_scatter(const Method& method);

/// Checks that every key that scatters is a number of the method.
void check_scatter(const Method& method);

YAML::Node specimens_map(const SpecimensOptions& specimens);

}  // namespace knot_utm
