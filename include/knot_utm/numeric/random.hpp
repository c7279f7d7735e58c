#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace knot_utm {

/// Random numbers that are the same on every machine, which those of the standard library's distributions are not. This
/// one is uniform, at least 0 and below 1.
double uniform(std::mt19937_64& random);

/// Normal with mean 0 and standard deviation 1. Source: Box, Muller 1958.
double standard_normal(std::mt19937_64& random);

/// A sequence of its own for each seed, number and name, so that what is drawn from one does not depend on what is
/// drawn from others. The seeds are mixed by the finaliser of SplitMix64. Source: Steele, Lea, Flood 2014.
std::mt19937_64 sequence_of(std::uint64_t seed, std::uint64_t number, const std::string& name);

}  // namespace knot_utm
