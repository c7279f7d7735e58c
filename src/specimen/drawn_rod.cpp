#include <filesystem>
#include <system_error>

#include "knot_utm/specimen/centreline_file.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

namespace {

constexpr double kPulledWay = 0.04;  // of a pull, for the paper's radius [m]

KnotDescription describe_drawn_rod() {
  KnotDescription out;
  out.name = "file";
  out.title = "Rod of a shape from a file";
  out.keys = {"file", "refinement", "natural_curvature"};
  out.any_shape = true;
  return out;
}

/// knot: file. A rod whose centreline is in a CSV file (centreline_file.hpp). The grips hold its ends, the upper grip,
/// which moves along +z, the last one. The program does not know whether it is knotted.
class DrawnRod final : public Knot {
 public:
  DrawnRod() : Knot(describe_drawn_rod()) {}

  SpecimenOptions defaults(double h) const override {
    SpecimenOptions out;
    out.edge_length = kPaperEdge * (h / kPaperRadius);
    return out;
  }
  double pull(const SpecimenOptions&, double h) const override { return kPulledWay * (h / kPaperRadius); }

  void check(const SpecimenOptions& specimen, double) const override {
    std::error_code error;
    if (specimen.file.empty()) throw InvalidInput::missing("specimen.file", "a CSV file with the columns x,y,z in m");
    if (!std::filesystem::is_regular_file(specimen.file, error))
      throw InvalidInput::cannot_read(specimen.file, "specimen.file");
  }

  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override {
    const Points points = read_centreline(specimen.file);
    Centreline out = from_points(points, material.radius, specimen.edge_length, specimen.file, mounting.refinement);
    if (!(out.points.rightCols(1)(2) > out.points.leftCols(1)(2))) {
      throw InvalidInput::sentence(
          "specimen.file", specimen.file,
          "specimen.file " + shown(specimen.file) + ": the last point must be higher than the first one, along z");
    }
    return out;
  }
};

}  // namespace

const Knot& drawn_rod() {
  static const DrawnRod knot;
  return knot;
}

}  // namespace knot_utm
