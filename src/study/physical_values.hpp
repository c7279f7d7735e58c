#pragma once

#include <yaml-cpp/yaml.h>

#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// The sections of a method on which depends what the simulated machine answers.
inline constexpr const char* kPhysicalSections[] = {"specimen", "material", "other_material", "machine", "physics"};

/// The values of a method but its names and notes, which change nothing. A specimen's file is named as the copy in a
/// run's folder is.
YAML::Node physical_values(const Method& method);

}  // namespace knot_utm
