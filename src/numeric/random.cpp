#include "knot_utm/numeric/random.hpp"

#include <cmath>

namespace knot_utm {
namespace {

constexpr double kUnit = 0x1p-53;

/// Each bit of the result depends on each bit of x.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * kUnit; }

double standard_normal(std::mt19937_64& random) {
  const double u = uniform(random) + kUnit;
  const double v = uniform(random);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * M_PI * v);
}

std::mt19937_64 sequence_of(std::uint64_t seed, std::uint64_t number, const std::string& name) {
  std::uint64_t mix = mixed(seed);
  mix = mixed(mix ^ number);
  for (const char letter : name) mix = mixed(mix ^ static_cast<unsigned char>(letter));
  return std::mt19937_64(mix);
}

}  // namespace knot_utm
