#include <algorithm>
#include <utility>

#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "path.hpp"

namespace knot_utm {
namespace {

constexpr double kShippedLength = 0.25;  // of the shipped method, for the paper's radius [m]

KnotDescription describe_straight_rod() {
  KnotDescription out;
  out.name = "straight";
  out.title = "Straight rod";
  out.keys = {"length"};
  out.straight = true;
  out.error_study = ErrorStudy::kStraight;
  return out;
}

/// knot: straight. A straight rod along the load axis. Its `length` is that between the grips, so that the load grows
/// by k_s/length per extension (`stretching_law: linear`).
class StraightRod final : public Knot {
 public:
  StraightRod() : Knot(describe_straight_rod()) {}

  SpecimenOptions defaults(double h) const override {
    const double r = h / kPaperRadius;
    SpecimenOptions out;
    out.edge_length = kPaperEdge * r;
    out.length = kShippedLength * r;
    return out;
  }
  void suit(const SpecimenOptions& known, double, double h, SpecimenOptions& out) const override {
    out.edge_length = std::min(kPaperEdge * (h / kPaperRadius), known.length / 4.0);
  }
  double pull(const SpecimenOptions& specimen, double) const override { return specimen.length / 25.0; }
  void check(const SpecimenOptions& specimen, double) const override { check_edges_of_length(specimen); }

  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override {
    Centreline out = knot_utm::straight(specimen.length, material.radius, specimen.edge_length);
    if (!mounting.clamps) return out;
    // What the clamps hold is one edge more at each end.
    const Eigen::Index nodes = out.points.cols() + 2;
    const double edge = out.length() / static_cast<double>(out.points.cols() - 1);
    out.points = Points::Zero(3, nodes);
    out.points.row(2).setLinSpaced(0.0, specimen.length + 2.0 * edge);
    out.points.row(2).array() -= edge;
    return out;
  }
  std::vector<HeldNode> held_below(const Centreline& centreline, bool clamped) const override {
    return inwards(Knot::held_below(centreline, clamped), clamped);
  }
  std::vector<HeldNode> held_above(const Centreline& centreline, bool clamped) const override {
    return inwards(Knot::held_above(centreline, clamped), clamped);
  }

 private:
  static std::vector<HeldNode> inwards(std::vector<HeldNode> held, bool clamped) {
    for (HeldNode& end : held)
      if (clamped) std::swap(end.node, end.next);
    return held;
  }
};

}  // namespace

const Knot& straight_rod() {
  static const StraightRod knot;
  return knot;
}

}  // namespace knot_utm
