#include "knot_utm/specimen/straight_rod.hpp"

#include <algorithm>
#include <utility>

#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "shape_checks.hpp"

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

}  // namespace

StraightRod::StraightRod() : Knot(describe_straight_rod()) {}

SpecimenOptions StraightRod::defaults(double h) const {
  const double r = h / kPaperRadius;
  SpecimenOptions out;
  out.edge_length = kPaperEdge * r;
  out.length = kShippedLength * r;
  return out;
}

void StraightRod::suit(const SpecimenOptions& known, double, double h, SpecimenOptions& out) const {
  out.edge_length = std::min(kPaperEdge * (h / kPaperRadius), known.length / 4.0);
}

double StraightRod::pull(const SpecimenOptions& specimen, double) const { return specimen.length / 25.0; }

void StraightRod::check(const SpecimenOptions& specimen, double) const { check_edges_of_length(specimen); }

Centreline StraightRod::centreline(const SpecimenOptions& specimen, const Material& material,
                                   const Mounting& mounting) const {
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

HeldNode StraightRod::held_below(const Centreline& centreline, bool clamped) const {
  HeldNode out = Knot::held_below(centreline, clamped);
  if (clamped) std::swap(out.node, out.next);
  return out;
}

HeldNode StraightRod::held_above(const Centreline& centreline, bool clamped) const {
  HeldNode out = Knot::held_above(centreline, clamped);
  if (clamped) std::swap(out.node, out.next);
  return out;
}

}  // namespace knot_utm
