#include "method_defaults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace knot_utm::fields {
namespace {

constexpr double kPaperRadius = 0.003175;  // [m]

// Of the shipped methods, for the paper's radius [m].
constexpr double kKnotDistance = 0.15, kEndToEnd = 0.25, kTail = 0.03, kRollerDiameter = 0.0381;
constexpr double kKnottedEdge = 0.0032, kPlainEdge = 0.005;
constexpr double kOverhandLength = 1.0, kStraightLength = 0.25, kOverhandShare = 0.7;
constexpr double kLoopWay = 0.12, kFileWay = 0.04;

constexpr double kLoopWayOfDistance = 0.7;  // knots far apart lock after about this share of their distance, or less
constexpr double kShareOfLoop = 0.6;        // e over L, as the paper has it
constexpr double kLeastTravel = 1.0, kLargestTravel = 100.0;  // [m]
constexpr double kTravelOverWay = 2.0;                        // slack and balance take some of the crosshead's way, too

constexpr double kDropExtension = 1e-3;  // for the paper's radius [m]
constexpr double kCreep = 1.0 / 3.3;     // friction that creeps is Coulomb's well above this share of the slowest pull

constexpr double kMarginOfCell = 2.5;                            // over the strength of one strand: a loop has two
constexpr double kLeastCapacity = 1e-3, kLargestCapacity = 1e8;  // [N]

/// The least L for knots at this distance, by which their coils clear the rollers.
double least_end_to_end(double knot_distance, double roller_diameter, double h) {
  return knot_distance + 2.0 * (5.0 * h + std::sqrt(9.0 * h * (0.5 * roller_diameter + h)));
}

void suit_loop(const Method& known, double r, double h, SpecimenOptions& out) {
  const double e = known.specimen.knot_distance, roller = known.machine.roller_diameter;
  out.knot_distance = std::min(kKnotDistance * r, kShareOfLoop * known.specimen.end_to_end);
  const bool roomy = kEndToEnd * r >= e + 12.0 * h && roller <= kRollerDiameter * r;
  if (!roomy) out.end_to_end = std::max(kEndToEnd * r, least_end_to_end(e, roller, h));
}

/// Of rod beyond its end-to-end distance, that an overhand knot of so many turns takes up at least.
double taken_up(int turns, double h) { return 1.1 * (34.5 + 40.0 * turns) * h; }

void suit_overhand(const Method& known, double r, double h, SpecimenOptions& out) {
  const double length = known.specimen.length, least = taken_up(known.specimen.turns, h);
  const double loose = (1.0 - kOverhandShare) * length;
  out.end_to_end = loose >= least ? kOverhandShare * length : length - least;
  const double end_to_end = known.specimen.end_to_end;
  const bool is_default = end_to_end == kOverhandShare * kOverhandLength * r;  // it makes room for the knot itself
  if (!is_default && kOverhandLength * r - end_to_end < least)
    out.length = end_to_end + std::max((1.0 - kOverhandShare) * kOverhandLength * r, least);
}

/// Keys that another knot has keep their plain value, so that they may stand in a method with it.
SpecimenOptions specimen_of(KnotKind knot, double r) {
  SpecimenOptions out;
  out.knot = knot;
  const bool loop = knot == KnotKind::kFisherman, overhand = knot == KnotKind::kOverhand;
  out.edge_length = (loop || overhand ? kKnottedEdge : kPlainEdge) * r;
  if (loop) {
    out.knot_distance = kKnotDistance * r;
    out.end_to_end = kEndToEnd * r;
    out.tail = kTail * r;
  } else if (overhand) {
    out.length = kOverhandLength * r;
    out.end_to_end = kOverhandShare * out.length;
  } else if (knot == KnotKind::kStraight) {
    out.length = kStraightLength * r;
  }
  return out;
}

double way_of(KnotKind knot, const SpecimenOptions& specimen, double r) {
  switch (knot) {
    case KnotKind::kFisherman:
      return std::max(kLoopWay * r, kLoopWayOfDistance * specimen.knot_distance);
    case KnotKind::kOverhand:
      return specimen.length / 10.0;
    case KnotKind::kStraight:
      return specimen.length / 25.0;
    case KnotKind::kFile:
      break;
  }
  return kFileWay * r;
}

double asked_travel(const Program& program) {
  double out = 0.0;
  for (const ProgramStep& step : program) {
    if (step.until.extension) out = std::max(out, *step.until.extension);
    if (step.extension_turns) out = std::max({out, step.extension_turns->high, -step.extension_turns->low});
  }
  return out;
}

/// Of the steps that pull, or where there is none the paper's [m/s].
double slowest_pull(const Program& program, double scale) {
  double out = ProgramStep{}.speed * scale;
  for (const ProgramStep& step : program)
    if (pulls(step.phase)) out = std::min(out, step.speed);
  return out;
}

double asked_load(const Method& method) {
  double out = method.ends.load.value_or(0.0);
  for (const ProgramStep& step : method.program) {
    out = std::max({out, step.load, std::abs(step.until.load.value_or(0.0)), std::abs(step.held_load.value_or(0.0))});
    if (step.load_turns) out = std::max({out, step.load_turns->high, -step.load_turns->low});
  }
  return out;
}

/// The tension that one strand bears at most; of a material that says nothing about it, that at which it is twice as
/// long.
double strength(const Material& material) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double by_strain = material.breaking_strain.value_or(kNone) * material.stretching_stiffness;
  const double least = std::min(material.breaking_force.value_or(kNone), by_strain);
  return std::isfinite(least) ? least : material.stretching_stiffness;
}

/// The next larger of 1, 2, 5, 10, 20 ..., as cells are sold.
double next_cell(double load) {
  const double decade = std::pow(10.0, std::floor(std::log10(load)));
  for (const double step : {1.0, 2.0, 5.0})
    if (load <= step * decade) return step * decade;
  return 10.0 * decade;
}

double capacity(const Material& material, const Method* known) {
  const double asked = known ? asked_load(*known) : 0.0;
  const double load = std::max(kMarginOfCell * strength(material), asked);
  return std::min(next_cell(std::max(load, kLeastCapacity)), kLargestCapacity);
}

}  // namespace

Defaults defaults(KnotKind knot, const Material& material, const Method* known) {
  const double h = material.radius, r = h / kPaperRadius;
  Defaults out;
  out.scale = r;
  out.specimen = specimen_of(knot, r);
  if (knot == KnotKind::kFisherman) out.machine.roller_diameter = kRollerDiameter * r;
  if (known && knot == KnotKind::kFisherman) suit_loop(*known, r, h, out.specimen);
  if (known && knot == KnotKind::kOverhand) suit_overhand(*known, r, h, out.specimen);
  const SpecimenOptions& specimen = known ? known->specimen : out.specimen;
  if (knot == KnotKind::kStraight) out.specimen.edge_length = std::min(kPlainEdge * r, specimen.length / 4.0);
  out.way = way_of(knot, specimen, r);
  const double asked = known ? asked_travel(known->program) : out.way;
  out.machine.travel = std::min(std::max({kLeastTravel, kLeastTravel * r, kTravelOverWay * asked}), kLargestTravel);
  out.machine.load_cell.capacity = capacity(material, known);
  out.slip_tolerance = kCreep * slowest_pull(known ? known->program : Program{}, r);
  out.drop_extension = kDropExtension * r;
  return out;
}

}  // namespace knot_utm::fields
