#include <filesystem>
#include <string>
#include <system_error>
#include <type_traits>

#include "knot_utm/io/method.hpp"
#include "knot_utm/io/number.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void reject(const std::string& key, double value, const std::string& allowed) {
  throw InvalidInput(key, format_number(value), allowed);
}

/// A key that another choice leaves without effect may stand in a method only with the value that it has anyway.
template <class Value>
void has_effect(bool has, const char* key, const Value& value, const Value& unset, const std::string& where) {
  if (has || value == unset) return;
  if constexpr (std::is_arithmetic_v<Value>) {
    reject(key, value, "only " + where);
  } else {
    throw InvalidInput(key, value, "only " + where);
  }
}

void check_effects(const Method& m) {
  const SpecimenOptions& s = m.specimen;
  const SpecimenOptions unset;
  const bool loop = s.knot == KnotKind::kFisherman;
  const bool overhand = s.knot == KnotKind::kOverhand;
  const bool straight = s.knot == KnotKind::kStraight;
  const bool opposite = s.handedness == Handedness::kOpposite;
  has_effect(loop, "specimen.handedness", std::string(opposite ? "opposite" : "same"), std::string("same"),
             "for knot: fisherman");
  has_effect(overhand, "specimen.turns", s.turns, unset.turns, "for knot: overhand");
  has_effect(s.knot == KnotKind::kFile, "specimen.file", s.file, unset.file, "for knot: file");
  has_effect(loop, "specimen.knot_distance", s.knot_distance, unset.knot_distance, "for knot: fisherman");
  has_effect(loop || overhand, "specimen.end_to_end", s.end_to_end, unset.end_to_end,
             "for knot: fisherman or overhand");
  has_effect(loop || overhand, "specimen.refinement", s.refinement.value_or(0.0), 0.0,
             "for knot: fisherman or overhand");
  has_effect(straight || overhand, "specimen.length", s.length, unset.length, "for knot: straight or overhand");
  has_effect(loop, "specimen.tail", s.tail, unset.tail, "for knot: fisherman");
  has_effect(loop, "specimen.preload", s.preload.value_or(0.0), 0.0, "for knot: fisherman, which is tied");

  const MachineOptions& machine = m.machine;
  const MachineOptions bare;
  has_effect(loop, "machine.roller_diameter", machine.roller_diameter, bare.roller_diameter, "for knot: fisherman");
  has_effect(machine.grips == GripKind::kRollers, "machine.roller_friction", machine.roller_friction,
             bare.roller_friction, "with grips: rollers");
  has_effect(false, "machine.stiffness", machine.stiffness, bare.stiffness, ".inf N/m: the frame is rigid");

  const PhysicsOptions& physics = m.physics;
  const PhysicsOptions plain;
  const bool memory = physics.friction_law == FrictionLaw::kMemory;
  has_effect(!memory, "physics.friction.slip_tolerance", physics.slip_tolerance, plain.slip_tolerance,
             "with law: smoothed");
  has_effect(memory, "physics.friction.presliding", physics.presliding.value_or(0.0), 0.0, "with law: memory");
}

void check_specimen(const Method& m) {
  const SpecimenOptions& s = m.specimen;
  const double h = m.material.radius;
  const bool loop = s.knot == KnotKind::kFisherman;
  const bool knotted = loop || s.knot == KnotKind::kOverhand;
  if (knotted && s.edge_length > 2.0 * h) {
    reject("specimen.edge_length", s.edge_length, "at most twice the radius, " + format_number(2.0 * h) + " m");
  }
  // Coarse: room for the coils themselves. The bench judges the shape that it really lays.
  if (loop && s.knot_distance < 12.0 * h) {
    reject("specimen.knot_distance", s.knot_distance, "at least 12 radii, " + format_number(12.0 * h) + " m");
  }
  if (loop && s.end_to_end < s.knot_distance + 12.0 * h) {
    reject("specimen.end_to_end", s.end_to_end,
           "at least knot_distance and 12 radii, " + format_number(s.knot_distance + 12.0 * h) + " m");
  }
  if (s.knot == KnotKind::kOverhand && s.end_to_end >= s.length) {
    reject("specimen.end_to_end", s.end_to_end, "less than length, " + format_number(s.length) + " m");
  }
  if ((s.knot == KnotKind::kStraight || s.knot == KnotKind::kOverhand) && s.edge_length > s.length / 4.0) {
    reject("specimen.edge_length", s.edge_length,
           "at most a quarter of length, " + format_number(s.length / 4.0) + " m");
  }
  if (s.closed) throw InvalidInput("specimen.closed", "true", "false: the grips hold the rod's two ends");
  if (s.knot == KnotKind::kFile) {
    std::error_code error;
    if (s.file.empty() || !fs::is_regular_file(s.file, error)) {
      throw InvalidInput("specimen.file", s.file.empty() ? "\"\"" : s.file, "a CSV file of x,y,z in m");
    }
  }
}

void check_machine(const Method& m) {
  const LoadCellOptions& cell = m.machine.load_cell;
  if (cell.resolution >= cell.capacity) {
    reject("machine.load_cell.resolution", cell.resolution,
           "less than capacity, " + format_number(cell.capacity) + " N");
  }
  const bool loop = m.specimen.knot == KnotKind::kFisherman;
  if (m.machine.grips == GripKind::kRollers && !loop) {
    throw InvalidInput("machine.grips", "rollers", "nodes or clamps: rollers hold nothing but a loop");
  }
}

void check_program(const Method& m) {
  const bool loop = m.specimen.knot == KnotKind::kFisherman;
  bool pulled = false;
  bool released = true;
  for (std::size_t i = 0; i < m.program.size(); ++i) {
    const ProgramStep& step = m.program[i];
    const std::string key = "program." + std::to_string(i);
    const std::string name = phase_name(step.phase);
    switch (step.phase) {
      case Phase::kTie:
        if (i != 0) throw InvalidInput(key, name, "the first step only");
        if (!loop) throw InvalidInput(key, name, "for knot: fisherman; start with another step");
        released = false;
        break;
      case Phase::kRelease:
        if (i != 1 || m.program[0].phase != Phase::kTie) throw InvalidInput(key, name, "right after tie only");
        released = true;
        break;
      case Phase::kMount:
        if (!loop) throw InvalidInput(key, name, "for knot: fisherman; start with another step");
        if (pulled) throw InvalidInput(key, name, "before the crosshead has moved only");
        pulled = true;
        break;
      case Phase::kPreload:
      case Phase::kPull:
        pulled = true;
        break;
      default:
        break;
    }
    if (!released && i > 0) throw InvalidInput(key, name, "release, which follows tie");
    if (step.phase == Phase::kPull && !step.until.extension && !step.until.load && !step.until.time &&
        !step.until.broken) {
      throw InvalidInput(key + ".pull.until", "nothing", "one or more of extension, load, time and break");
    }
    const double capacity = m.machine.load_cell.capacity;
    if (step.phase == Phase::kPreload && step.load > capacity) {
      reject(key + ".preload.load", step.load, "at most the load cell's capacity, " + format_number(capacity) + " N");
    }
    if (step.until.load && *step.until.load > capacity) {
      reject(key + ".pull.until.load", *step.until.load,
             "at most the load cell's capacity, " + format_number(capacity) + " N");
    }
  }
}

}  // namespace

void check_method(const Method& method) {
  check_specimen(method);
  check_machine(method);
  check_program(method);
  check_effects(method);
}

}  // namespace knot_utm
