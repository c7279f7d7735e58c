#pragma once

#include <optional>
#include <string>

#include "knot_utm/specimen/material.hpp"

namespace knot_utm::fields {

/// The terms in which a method may give a load of its program, instead of a number of newtons, so that it suits every
/// material: "50 %" of the breaking force, or "reference_tension".
class LoadTerms {
 public:
  explicit LoadTerms(const Material& material);

  /// The load that a text stands for [N]; empty: the text is no such term. Throws std::invalid_argument, whose text
  /// says why, for a percentage where the material has no breaking force.
  std::optional<double> load(const std::string& text) const;

  /// What is allowed beside a number, for messages.
  static const char* allowed() {
    return ", a percentage of material.breaking_force, such as \"50 %\", or reference_tension";
  }

 private:
  std::optional<double> breaking_force_;  ///< [N]
  double reference_tension_;              ///< [N]
};

/// The tension under which a rope is measured, d^2/8 in decanewtons for a rope of d millimetres [N]; its source stands
/// in doc/standards.md.
double reference_tension(const Material& material);

}  // namespace knot_utm::fields
