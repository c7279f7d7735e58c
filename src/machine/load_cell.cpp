#include "knot_utm/machine/load_cell.hpp"

#include <cmath>
#include <cstdint>
#include <locale>
#include <sstream>

#include "knot_utm/numeric/random.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

/// Between the bounds that the class sets, from random numbers that no noise is made of.
double gain_error(const LoadCellOptions& options) {
  constexpr std::uint64_t kBeyondSeeds = std::uint64_t{1} << 32;
  std::mt19937_64 random(kBeyondSeeds + options.seed);
  return options.accuracy * (2.0 * uniform(random) - 1.0);
}

std::mt19937_64 noise_of(const LoadCellOptions& options) {
  if (options.noise_run == 0) return std::mt19937_64(options.seed);
  return sequence_of(options.seed, options.noise_run, "noise");
}

}  // namespace

LoadCell::LoadCell(const LoadCellOptions& options)
    : options_(options), gain_(1.0 + gain_error(options)), random_(noise_of(options)) {
  const auto check = [](const char* key, double value, bool allowed, const char* text) {
    if (!allowed) throw InvalidInput(std::string("machine.load_cell.") + key, std::to_string(value), text);
  };
  check("capacity", options.capacity, options.capacity > 0.0, "more than 0 N");
  check("sampling_rate", options.sampling_rate, options.sampling_rate > 0.0, "more than 0 Hz");
  check("accuracy", options.accuracy, options.accuracy >= 0.0 && options.accuracy < 1.0, "0 or more, less than 1");
  check("floor", options.floor, options.floor >= 0.0 && options.floor <= 1.0, "0 to 1 of the capacity");
  check("resolution", options.resolution, options.resolution >= 0.0, "0 N or more");
  check("noise", options.noise, options.noise >= 0.0, "0 N or more");
}

double LoadCell::read(double true_force) {
  double reading = gain_ * balanced(true_force);
  if (options_.noise > 0.0) reading += options_.noise * standard_normal(random_);
  if (options_.resolution > 0.0) reading = std::round(reading / options_.resolution) * options_.resolution;
  return reading;
}

void LoadCell::state(Archive& archive) {
  archive.section("CELU");  // "CELT" knew when it was balanced
  std::stringstream random;
  random.imbue(std::locale::classic());
  random << random_;
  std::string text = random.str();
  archive(balanced_, text);
  if (!archive.loads()) return;
  random.str(text);
  random >> random_;
  archive.require(!random.fail(), "state of the random numbers", std::to_string(text.size()) + " letters");
}

bool is_below_floor(const LoadCellOptions& cell, double true_force) {
  return std::abs(true_force) < cell.floor * cell.capacity;
}

std::optional<double> class_error(const LoadCellOptions& cell, double true_force) {
  if (cell.accuracy == 0.0 && cell.floor == 0.0) return std::nullopt;
  if (is_below_floor(cell, true_force)) return cell.floor * cell.capacity;
  return cell.accuracy * std::abs(true_force);
}

}  // namespace knot_utm
