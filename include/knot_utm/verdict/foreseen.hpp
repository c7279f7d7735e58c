#pragma once

#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"

/// What is said of a method, before anything is simulated or where its knot came undone.
namespace knot_utm {

/// Warnings that are known of a method before anything is simulated, one line each. Among them are questions about a
/// rod that is like no rod there is: most likely a slip of a unit, such as a modulus in MPa. Their limits lie far
/// beyond those of threads, ropes, wires and gels.
std::vector<std::string> foreseen_warnings(const Method& method);

/// Warnings about speeds of the method.
std::vector<std::string> speed_warnings(const Method& method);

/// The rod in numbers that a person can check: "36.4 g/m at a diameter of 6.35 mm, E = 2.32 GPa stretched, ...".
std::string rod_in_words(const Material& material);

/// Advice for a knot that came undone: which values of the method to change so that it stays tied, in one line.
std::string what_keeps_a_knot(const Method& method);

}  // namespace knot_utm
