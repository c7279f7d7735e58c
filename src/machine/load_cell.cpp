#include "knot_utm/machine/load_cell.hpp"

#include <cmath>
#include <locale>
#include <sstream>

#include "knot_utm/rod/invalid_input.hpp"

namespace knot_utm {

LoadCell::LoadCell(const LoadCellOptions& options) : options_(options), random_(options.seed) {
  const auto check = [](const char* key, double value, bool allowed, const char* text) {
    if (!allowed) throw InvalidInput(std::string("machine.load_cell.") + key, std::to_string(value), text);
  };
  check("capacity", options.capacity, options.capacity > 0.0, "more than 0 N");
  check("sampling_rate", options.sampling_rate, options.sampling_rate > 0.0, "more than 0 Hz");
  check("resolution", options.resolution, options.resolution >= 0.0, "0 N or more");
  check("noise", options.noise, options.noise >= 0.0, "0 N or more");
}

double LoadCell::read(double true_force) {
  double reading = balanced(true_force);
  if (options_.noise > 0.0) reading += options_.noise * normal();
  if (options_.resolution > 0.0) reading = std::round(reading / options_.resolution) * options_.resolution;
  return reading;
}

void LoadCell::state(Archive& archive) {
  archive.section("CELL");
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

double LoadCell::normal() {
  // Box and Muller: std::normal_distribution differs between standard libraries.
  constexpr double kUnit = 0x1p-53;
  const double u = (static_cast<double>(random_() >> 11) + 1.0) * kUnit;
  const double v = static_cast<double>(random_() >> 11) * kUnit;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * M_PI * v);
}

}  // namespace knot_utm
