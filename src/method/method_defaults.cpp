#include "method_defaults.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm::fields {
namespace {

constexpr double kLeastTravel = 1.0, kLargestTravel = 100.0;  // [m]
constexpr double kTravelOverWay = 2.0;                        // slack and balance take some of the crosshead's way, too

constexpr double kCreep = 1.0 / 3.3;  // friction that creeps is Coulomb's well above this fraction of the slowest pull

constexpr double kMarginOfCell = 2.5;                            // over the strength of one strand: a loop has two
constexpr double kLeastCapacity = 1e-3, kLargestCapacity = 1e8;  // [N]

/// The largest of the program's numbers that have this unit.
double largest(const Program& program, const std::string& unit) {
  double out = 0.0;
  for (const ProgramStep& step : program)
    for (const KeyUnit& number : step_numbers(step, ""))
      if (number.unit == unit) out = std::max(out, std::abs(number.value.value_or(0.0)));
  return out;
}

/// The slowest speed of the steps that pull; where there is none, the paper's [m/s].
double slowest_pull(const Program& program, double scale) {
  double out = PullStep().speed * scale;
  for (const ProgramStep& step : program)
    if (pulls(step->phase())) out = std::min(out, step->speed);
  return out;
}

/// The tension that one strand bears at most; of a material that says nothing about it, that at which it is twice as
/// long.
double strength(const Material& material) { return material.breaking_force.value_or(material.stretching_stiffness); }

/// That of the weaker rope: it bears at least half of the load, and parts before the stronger one shows its strength.
double weaker_strength(const Material& material) {
  return material.other ? std::min(strength(material), strength(*material.other)) : strength(material);
}

/// The next larger of 1, 2, 5, 10, 20 ..., as cells are sold.
double next_cell(double load) {
  const double decade = std::pow(10.0, std::floor(std::log10(load)));
  for (const double step : {1.0, 2.0, 5.0})
    if (load <= step * decade) return step * decade;
  return 10.0 * decade;
}

double capacity(const Material& material, const Method* known) {
  const double asked = known ? std::max(known->ends.load.value_or(0.0), largest(known->program, "N")) : 0.0;
  const double load = std::max(kMarginOfCell * weaker_strength(material), asked);
  return std::min(next_cell(std::max(load, kLeastCapacity)), kLargestCapacity);
}

}  // namespace

Defaults defaults(const SpecimenOptions& specimen, const Material& material, const Method* known) {
  const double h = thickest(material), r = h / kPaperRadius;
  Defaults out;
  out.scale = r;
  const Knot& knot = knot_of(specimen);
  out.specimen = knot.defaults(h);
  out.specimen.knot = specimen.knot;
  out.specimen.drawing = specimen.drawing;
  out.machine.roller_diameter = knot.roller_diameter(h).value_or(out.machine.roller_diameter);
  if (specimen.drawing && !specimen.drawing->posts.empty()) out.machine.roller_friction = material.friction_coefficient;
  if (known) knot.suit(known->specimen, known->machine.roller_diameter, h, out.specimen);
  out.way = knot.pull(known ? known->specimen : out.specimen, h);
  const double asked = known ? largest(known->program, "m") : out.way;
  out.machine.travel = std::min(std::max({kLeastTravel, kLeastTravel * r, kTravelOverWay * asked}), kLargestTravel);
  out.machine.load_cell.capacity = capacity(material, known);
  out.slip_tolerance = kCreep * slowest_pull(known ? known->program : Program{}, r);
  return out;
}

}  // namespace knot_utm::fields
