#include "knot_utm/specimen/drawn_rod.hpp"

#include <filesystem>
#include <system_error>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/specimen/centreline_file.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {

namespace {

constexpr double kPulledWay = 0.04;  // of a pull, for the paper's radius [m]

KnotDescription describe_drawn_rod() {
  KnotDescription out;
  out.name = "file";
  out.title = "Rod of a shape from a file";
  out.keys = {"file", "closed"};
  out.any_shape = true;
  return out;
}

}  // namespace

DrawnRod::DrawnRod() : Knot(describe_drawn_rod()) {}

SpecimenOptions DrawnRod::defaults(double h) const {
  SpecimenOptions out;
  out.edge_length = kPaperEdge * (h / kPaperRadius);
  return out;
}

double DrawnRod::pull(const SpecimenOptions&, double h) const { return kPulledWay * (h / kPaperRadius); }

void DrawnRod::check(const SpecimenOptions& specimen, double) const {
  std::error_code error;
  if (specimen.file.empty()) throw InvalidInput::missing("specimen.file", "a CSV file with the columns x,y,z in m");
  if (!std::filesystem::is_regular_file(specimen.file, error))
    throw InvalidInput::cannot_read(specimen.file, "specimen.file");
}

Centreline DrawnRod::centreline(const SpecimenOptions& specimen, const Material& material, const Mounting&) const {
  check_ends(specimen);
  const Points points = read_centreline(specimen.file);
  Centreline out = from_points(points, false, material.radius, specimen.edge_length, specimen.file);
  if (!(out.points.rightCols(1)(2) > out.points.leftCols(1)(2))) {
    throw InvalidInput::sentence(
        "specimen.file", specimen.file,
        "specimen.file " + shown(specimen.file) + ": the last point must be higher than the first one, along z");
  }
  return out;
}

}  // namespace knot_utm
