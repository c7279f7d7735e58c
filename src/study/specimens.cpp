#include "knot_utm/study/specimens.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/numeric/random.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {

namespace {

constexpr double kFurthest = 3.0;  // standard deviations
constexpr const char* kNoise = "machine.load_cell.noise_run";

double drawn(double x0, const Scatter& scatter, std::mt19937_64 random) {
  if (scatter.law == ScatterLaw::kUniform) return x0 * (1.0 + scatter.spread * (2.0 * uniform(random) - 1.0));
  double z = standard_normal(random);
  while (std::abs(z) > kFurthest) z = standard_normal(random);
  return scatter.law == ScatterLaw::kNormal ? x0 * (1.0 + scatter.spread * z) : x0 * std::exp(scatter.spread * z);
}

/// From 1 on: 0 is the run of a method that says none.
std::uint32_t noise_run(unsigned seed, int number) {
  return static_cast<std::uint32_t>(sequence_of(seed, static_cast<std::uint64_t>(number), kNoise)() >> 33) + 1;
}

}  // namespace

void check_fits(const Method& method) {
  const TestingMachine machine(method.specimen, method.material, method.machine, method.physics);
  make_program(method, machine.longest_step());
}

DrawnSpecimen draw_specimen(const Method& method, int number) {
  const SpecimensOptions& specimens = method.specimens;
  Method one = method;
  one.specimens = {};
  one.specimens.scatter.clear();
  DrawnSpecimen specimen;
  specimen.number = number;
  std::vector<std::string> overrides;
  for (const Scatter& scatter : specimens.scatter) {
    const double nominal = number_at(method, scatter.key).value();
    const double value =
        drawn(nominal, scatter, sequence_of(specimens.seed, static_cast<std::uint64_t>(number), scatter.key));
    specimen.drawn.emplace_back(scatter.key, value);
    overrides.push_back(scatter.key + "=" + format_yaml_number(value));
  }
  overrides.push_back(kNoise + ("=" + std::to_string(noise_run(specimens.seed, number))));
  try {
    specimen.method = parse_method(method_yaml(one), method.name + ".yaml", overrides);
    check_fits(specimen.method);
  } catch (const InvalidInput& invalid) {
    throw InvalidInput::sentence("specimens", std::to_string(number),
                                 "specimen " + std::to_string(number) + " of " + std::to_string(specimens.count) +
                                     " cannot be made: " + invalid.what());
  }
  return specimen;
}

std::vector<DrawnSpecimen> draw_specimens(const Method& method) {
  std::vector<DrawnSpecimen> out;
  for (int number = 1; number <= method.specimens.count; ++number) out.push_back(draw_specimen(method, number));
  return out;
}

}  // namespace knot_utm
