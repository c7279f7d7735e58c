#include <filesystem>
#include <string>
#include <system_error>

#include "knot_utm/io/method.hpp"
#include "knot_utm/io/number.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void reject(const std::string& key, double value, const std::string& allowed) {
  throw InvalidInput(key, format_number(value), allowed);
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
  const bool loop =
      m.specimen.knot == KnotKind::kFisherman || (m.specimen.knot == KnotKind::kFile && m.specimen.closed);
  if (m.machine.grips == GripKind::kRollers && !loop) {
    throw InvalidInput("machine.grips", "rollers", "nodes or clamps: rollers hold nothing but a loop");
  }
}

void check_program(const Method& m) {
  const bool tied = m.specimen.knot == KnotKind::kFisherman || m.specimen.knot == KnotKind::kOverhand;
  bool pulled = false;
  bool released = true;
  for (std::size_t i = 0; i < m.program.size(); ++i) {
    const ProgramStep& step = m.program[i];
    const std::string key = "program." + std::to_string(i);
    const std::string name = phase_name(step.phase);
    switch (step.phase) {
      case Phase::kTie:
        if (i != 0) throw InvalidInput(key, name, "the first step only");
        if (!tied) throw InvalidInput(key, name, "for knot: fisherman or overhand; start with another step");
        released = false;
        break;
      case Phase::kRelease:
        if (i != 1 || m.program[0].phase != Phase::kTie) throw InvalidInput(key, name, "right after tie only");
        released = true;
        break;
      case Phase::kMount:
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
}

}  // namespace knot_utm
