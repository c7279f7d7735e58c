#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace knot_utm {

/// Numbers at random that are the same on every machine: the distributions of the standard library are not.
/// Uniform from 0 to 1, without the end.
double uniform(std::mt19937_64& random);

/// Normal with mean 0 and standard deviation 1. Source: Box, Muller 1958.
double standard_normal(std::mt19937_64& random);

/// A sequence of its own for each seed, number and name: what is drawn for one of them does not depend on what else is
/// drawn. The seeds are mixed by the finaliser of SplitMix64. Source: Steele, Lea, Flood 2014.
std::mt19937_64 sequence_of(std::uint64_t seed, std::uint64_t number, const std::string& name);

}  // namespace knot_utm
