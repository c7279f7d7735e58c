#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

#include "knot_utm/io/method.hpp"

/// The `specimens` section of a method.
namespace knot_utm {

/// `scatter: auto` leaves `automatic` true: `default_scatter` then says how specimens differ.
SpecimensOptions read_specimens(const YAML::Node& node, const std::string& file, bool& automatic);

/// What a person cannot repeat from one specimen of this method to the next.
std::vector<Scatter> default_scatter(const Method& method);

/// Every key that scatters must be a number of the method. Throws InvalidInput.
void check_scatter(const Method& method);

YAML::Node specimens_map(const SpecimensOptions& specimens);

}  // namespace knot_utm
