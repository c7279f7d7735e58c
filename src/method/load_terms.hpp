#pragma once

#include <optional>
#include <string>

#include "knot_utm/specimen/material.hpp"

namespace knot_utm::fields {

/// A method may give a load of its program in terms that suit every material, instead of a number of newtons: "50 %" of
/// the breaking force, or "reference_tension". Empty: the text is no such term [N]. Throws std::invalid_argument, whose
/// text says why, for a percentage where the material has no breaking force.
std::optional<double> load_in_terms(const std::string& text, const Material& material);

/// What is allowed beside a number, for messages.
inline constexpr const char* kOrLoadTerm =
    ", a percentage of material.breaking_force, such as \"50 %\", or reference_tension";

}  // namespace knot_utm::fields
