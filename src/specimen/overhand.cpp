#include "knot_utm/specimen/overhand.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "path.hpp"

namespace knot_utm {
namespace {

constexpr double kLength = 1.0;    // of the shipped method, for the paper's radius [m]
constexpr double kEndToEnd = 0.7;  // [of its length]

/// The least excess of the rod's length over its end-to-end distance with which an overhand of so many turns fits [m].
double least_excess(int turns, double h) { return 1.1 * (34.5 + 40.0 * turns) * h; }

/// Length of the braid: the loose knot's own, but never so short that its strands would overlap.
double braid_length(double radius, int turns, double loop_radius) {
  const double full_turns = 0.5 * (2 * turns + 1);
  const double turn = 2.0 * M_PI * std::pow(12.0, 0.25) * std::sqrt(radius * loop_radius);
  return full_turns * std::max(turn, 4.0 * M_PI * radius);
}

/// The overhand with a loop of the given radius, before smoothing; straight tails reach the ends.
Path sketch_overhand(const OverhandShape& shape, double loop_radius, double spacing) {
  const double half = 0.5 * braid_length(shape.radius, shape.turns, loop_radius);
  const double angle = (2 * shape.turns + 1) * M_PI;
  const double middle = 0.5 * shape.end_to_end;
  const double helix = 2.0 * half / angle;  // advance a radian
  const double r = 1.2 * shape.radius * std::exp(0.5 * std::pow(shape.radius / helix, 2));
  // The tails lie on the z axis: the braid's own axis is at x = r.
  const auto braid = [&](double t, double start) {
    const double phi = start + angle * t;
    return Vec3(r + r * std::cos(phi), r * std::sin(phi), middle + half * (2.0 * t - 1.0));
  };
  const double braid_arc = std::hypot(2.0 * half, angle * r);
  const double top = 2.0 * r + 2.0 * loop_radius;
  Path path(spacing);
  path.add(Vec3::Zero());
  path.add_curve(braid_arc, [&](double t) { return braid(t, M_PI); });
  path.add_curve(M_PI * loop_radius, [&](double t) {
    return Vec3(top - loop_radius * (1.0 + std::cos(M_PI * t)), 0.0, middle + half + loop_radius * std::sin(M_PI * t));
  });
  path.add_curve(M_PI * loop_radius, [&](double t) {
    return Vec3(top - loop_radius * (1.0 - std::cos(M_PI * t)), 0.0, middle - half - loop_radius * std::sin(M_PI * t));
  });
  path.add_curve(braid_arc, [&](double t) { return braid(t, 0.0); });
  path.add(Vec3(0.0, 0.0, shape.end_to_end));
  return path;
}

/// Fine edges in the middle, from which the tight knot is made: 40 h of rod for one turn, 15 h for each further one.
EdgeGrading grading(const OverhandShape& shape, double path_length) {
  const double half = (20.0 + 7.5 * (shape.turns - 1)) * shape.radius;
  const double middle = 0.5 * path_length;
  return {shape.edge_length, {{middle - half, middle + half, shape.edge_length / shape.refinement}}};
}

void check_overhand(const OverhandShape& shape) {
  check_radius(shape.radius);
  check_edge_length(shape.edge_length, shape.radius);
  if (shape.turns < 1 || shape.turns > 4) throw InvalidInput("specimen.turns", std::to_string(shape.turns), "1 to 4");
  if (!(shape.length > 0.0 && shape.length <= 100.0))
    throw InvalidInput("specimen.length", text(shape.length), "above 0 and at most 100 m");
}

/// Length between the grips that is left beside the braid and straight tails of 4 h at both ends [m].
double room(const OverhandShape& shape, double loop_radius) {
  return shape.end_to_end - braid_length(shape.radius, shape.turns, loop_radius) - 8.0 * shape.radius;
}

double rod_length(const OverhandShape& shape, double loop_radius, double spacing) {
  const Path path = sketch_overhand(shape, loop_radius, spacing);
  const Points smooth = smoothed(path, shape.radius, spacing);
  return (smooth.rightCols(smooth.cols() - 1) - smooth.leftCols(smooth.cols() - 1)).colwise().norm().sum();
}

double largest_loop(const OverhandShape& shape, double smallest) {
  double radius = smallest;
  for (double step = shape.length; step > 1e-3 * shape.radius; step *= 0.5) {
    if (room(shape, radius + step) > 0.0) radius += step;
  }
  return radius;
}

/// A radius of the loop, and by how much the rod is then longer than asked for.
struct Try {
  double loop_radius, excess;
};

/// The rod's length grows smoothly with the loop's radius: secants.
double loop_of_right_length(const OverhandShape& shape, Try before, Try now, double spacing) {
  for (int i = 0; i < 60 && std::abs(now.excess) > 1e-3 * spacing; ++i) {
    const double loop_radius =
        (before.loop_radius * now.excess - now.loop_radius * before.excess) / (now.excess - before.excess);
    before = now;
    now = {loop_radius, rod_length(shape, loop_radius, spacing) - shape.length};
  }
  return now.loop_radius;
}

constexpr double kSmallestLoop = 2.5;  // its radius, in radii of the rod

OverhandShape with_end_to_end(const OverhandShape& shape, double end_to_end) {
  OverhandShape out = shape;
  out.end_to_end = end_to_end;
  return out;
}

/// The largest excess of the rod's length over its end-to-end distance, with the largest loop that has room [m].
double longest_knot(const OverhandShape& shape, double spacing) {
  return rod_length(shape, largest_loop(shape, kSmallestLoop * shape.radius), spacing) - shape.end_to_end;
}

/// The end-to-end distances that a rod of this length may have lie above `narrowest`; at `widest` its knot is smallest.
[[noreturn]] void refuse_end_to_end(const OverhandShape& shape, double narrowest, double widest, double spacing) {
  if (!(widest > narrowest))
    throw InvalidInput("specimen.length", text(shape.length),
                       "more than " + least_text(shape.length + narrowest - widest) +
                           " m, which the smallest knot and its ends take up");
  // The larger the distance, the more excess length a knot has room for.
  double low = narrowest, high = widest;
  while (high - low > 1e-4 * high) {
    const double middle = 0.5 * (low + high);
    const bool fits = shape.length - middle <= longest_knot(with_end_to_end(shape, middle), spacing);
    (fits ? high : low) = middle;
  }
  throw InvalidInput(
      "specimen.end_to_end", text(shape.end_to_end),
      limits_text(high, widest) + " m, for a knot in a rod of specimen.length, " + text(shape.length) + " m");
}

/// The radius of the loop with which the rod has its length.
double fitting_loop(const OverhandShape& shape, double spacing) {
  const double smallest = kSmallestLoop * shape.radius;
  if (!std::isfinite(shape.end_to_end)) throw InvalidInput("specimen.end_to_end", text(shape.end_to_end), "a number");
  const double narrowest = -room(with_end_to_end(shape, 0.0), smallest);
  const OverhandShape tight = with_end_to_end(shape, std::max(shape.end_to_end, narrowest));
  const double shortest = rod_length(tight, smallest, spacing) - tight.end_to_end, widest = shape.length - shortest;
  if (!(shape.end_to_end > narrowest && shape.end_to_end <= widest))
    refuse_end_to_end(shape, narrowest, widest, spacing);
  const double longest = longest_knot(shape, spacing);
  if (shape.length - shape.end_to_end > longest) refuse_end_to_end(shape, narrowest, widest, spacing);
  return loop_of_right_length(shape, {smallest, shortest + shape.end_to_end - shape.length},
                              {largest_loop(shape, smallest), longest + shape.end_to_end - shape.length}, spacing);
}

}  // namespace

Centreline overhand(const OverhandShape& shape) {
  check_overhand(shape);
  const double spacing = sketch_spacing(shape.radius, shape.edge_length);
  const Path path = sketch_overhand(shape, fitting_loop(shape, spacing), spacing);
  Centreline centreline;
  centreline.points = Resampled(path, smoothed(path, shape.radius, spacing), grading(shape, path.length())).points;
  check_no_overlap(centreline, shape.radius, "specimen.end_to_end", text(shape.end_to_end));
  return centreline;
}

namespace {

/// knot: overhand.
class OverhandKnot final : public Knot {
 public:
  OverhandKnot() {
    about_.name = "overhand";
    about_.title = "Overhand knot";
    about_.keys = {"turns", "length", "end_to_end", "refinement"};
    about_.knots = 1;
  }

  SpecimenOptions defaults(double h) const override {
    const double r = h / kPaperRadius;
    SpecimenOptions out;
    out.edge_length = kPaperKnottedEdge * r;
    out.length = kLength * r;
    out.end_to_end = kEndToEnd * out.length;
    return out;
  }

  void suit(const SpecimenOptions& known, double, double h, SpecimenOptions& out) const override {
    const double r = h / kPaperRadius, length = known.length, least = least_excess(known.turns, h);
    const double loose = (1.0 - kEndToEnd) * length;
    out.end_to_end = loose >= least ? kEndToEnd * length : length - least;
    const double end_to_end = known.end_to_end;
    const bool is_default = end_to_end == kEndToEnd * kLength * r;  // this value is adapted above, the length is not
    if (!is_default && kLength * r - end_to_end < least)
      out.length = end_to_end + std::max((1.0 - kEndToEnd) * kLength * r, least);
  }

  double pull(const SpecimenOptions& specimen, double) const override { return specimen.length / 10.0; }

  void check(const SpecimenOptions& specimen, double) const override {
    if (specimen.end_to_end >= specimen.length)
      throw InvalidInput("specimen.end_to_end", format_number(specimen.end_to_end),
                         "less than length, " + format_number(specimen.length) + " m");
    check_edges_of_length(specimen);
  }

  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override {
    OverhandShape shape;
    shape.radius = material.radius;
    shape.turns = specimen.turns;
    shape.length = specimen.length;
    shape.end_to_end = specimen.end_to_end;
    shape.edge_length = specimen.edge_length;
    shape.refinement = mounting.refinement;
    return overhand(shape);
  }
};

}  // namespace

std::unique_ptr<const Knot> overhand_knot() { return std::make_unique<OverhandKnot>(); }

}  // namespace knot_utm
