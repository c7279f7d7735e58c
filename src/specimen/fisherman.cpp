#include "knot_utm/specimen/fisherman.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/rod/invalid_input.hpp"
#include "path.hpp"
#include "shape_checks.hpp"

namespace knot_utm {

namespace {

/// One overhand of the fisherman's loop, in lengths.
struct Coil {
  double strand;  ///< a, of standing part and threaded strand from the axis
  double tail;    ///< b
  double radius;  ///< R
  double half;    ///< w, half its axial length
  double outer;   ///< of its outermost point from its middle
  double inner;   ///< of its innermost point
};

/// A knot's own strand from its middle plane of the loop to the end of its tail. The axis passes `origin` along
/// `outwards`, z' = 0 there; the knot's middle is at z' = c; angles run from `u` (standing part) to `v` (tail).
struct KnotFrame {
  Vec3 origin, u, v, outwards;
  Vec3 at(double r, double angle, double z) const {
    return origin + r * (std::cos(angle) * u + std::sin(angle) * v) + z * outwards;
  }
};

struct KnotMarks {
  double standing_begin, coil_middle, tail_exit, tail_end;  ///< along the knot's own strand from z' = 0
};

KnotMarks draw_knot(const KnotFrame& frame, const Coil& coil, double c, double radius, double tail, Path& path) {
  constexpr double kWrap = 2.5 * M_PI;
  KnotMarks marks{};
  marks.standing_begin = c - 5.0 * radius;
  path.add(frame.at(coil.strand, 0.0, 0.0));
  path.add(frame.at(coil.strand, 0.0, c + coil.half));
  const double turn_out = 0.5 * (coil.radius - coil.strand);
  path.add_curve(M_PI * turn_out, [&](double t) {
    return frame.at(coil.strand + turn_out * (1.0 - std::cos(M_PI * t)), 0.0,
                    c + coil.half + turn_out * std::sin(M_PI * t));
  });
  const double coil_begin = path.length();
  path.add_curve(kWrap * coil.radius,
                 [&](double t) { return frame.at(coil.radius, kWrap * t, c + coil.half * (1.0 - 2.0 * t)); });
  marks.coil_middle = 0.5 * (coil_begin + path.length());
  const double turn_in = 0.5 * (coil.radius - coil.tail);
  path.add_curve(M_PI * turn_in, [&](double t) {
    return frame.at(coil.tail + turn_in * (1.0 + std::cos(M_PI * t)), kWrap,
                    c - coil.half - turn_in * std::sin(M_PI * t));
  });
  path.add(frame.at(coil.tail, kWrap, c + coil.outer));
  marks.tail_exit = path.length();
  path.add(frame.at(coil.tail, kWrap, c + coil.outer + tail));
  marks.tail_end = path.length();
  return marks;
}

void check_fisherman(const FishermanShape& shape) {
  check_radius(shape.radius);
  check_edge_length(shape.edge_length, shape.radius);
  if (!(shape.looseness >= 3.9 && shape.looseness <= 8.0)) {
    throw InvalidInput("specimen.looseness", text(shape.looseness), "3.9 to 8 radii of the rod");
  }
  if (!(shape.tail >= 2.0 * shape.radius && shape.tail <= 10.0)) {
    throw InvalidInput("specimen.tail", text(shape.tail), text(2.0 * shape.radius) + " to 10 m");
  }
  if (!(shape.end_to_end > 0.0 && shape.end_to_end <= 100.0)) {
    throw InvalidInput("specimen.end_to_end", text(shape.end_to_end), "above 0 and at most 100 m");
  }
}

}  // namespace

Centreline fisherman_loop(const FishermanShape& shape) {
  check_fisherman(shape);
  const double h = shape.radius;
  Coil coil{};
  coil.strand = (2.0 - std::sqrt(3.0)) * shape.looseness * h;
  coil.radius = before_smoothing(shape.looseness * h, h);
  coil.tail = shape.looseness * h - 2.0 * coil.strand;
  coil.half = 2.0 * h;
  coil.outer = coil.half + 0.5 * (coil.radius - coil.strand);
  coil.inner = coil.half + 0.5 * (coil.radius - coil.tail);

  // Distance of the rod on a roller from the roller's axis, and where to draw it. A coil must clear the far side.
  const double rolled = shape.roller_radius + h;
  if (!(rolled >= 0.5 * (coil.radius + 2.5 * h) && shape.roller_radius <= 10.0)) {
    throw InvalidInput("machine.roller_diameter", text(2.0 * shape.roller_radius),
                       text(coil.radius + 0.5 * h) + " to 20 m");
  }

  // The knots clear each other; their strands reach the rollers; their coils clear the rollers.
  const double c = 0.5 * (shape.knot_distance - shape.outward_shift);
  const double middle = 0.5 * shape.end_to_end;
  const double past = coil.outer + 2.0 * h;
  const double beside_axis = std::max(0.0, rolled - coil.radius);
  const double roller_reach = coil.radius > rolled ? rolled : std::sqrt(rolled * rolled - beside_axis * beside_axis);
  const double c_min = coil.inner + 1.25 * h;
  const double c_max = middle - std::max(past + h, coil.outer + h + roller_reach);
  if (!(c_max > c_min)) {
    throw InvalidInput("specimen.end_to_end", text(shape.end_to_end),
                       "at least " + text(2.0 * (c_min + middle - c_max)) + " m for this rod and these rollers");
  }
  if (!(c >= c_min && c <= c_max)) {
    throw InvalidInput("specimen.knot_distance", text(shape.knot_distance),
                       text(2.0 * c_min + shape.outward_shift) + " to " + text(2.0 * c_max + shape.outward_shift) +
                           " m for this rod and these rollers");
  }

  // Both ends of the near side are drawn further out where the straight strands ask for it, and the half circles
  // narrower.
  const double narrowest = std::min(rolled, 0.5 * (coil.radius + 2.5 * h));
  const double wanted = std::max(shape.end_to_end, 2.0 * (c + shape.straight));
  const double drawn = std::min(wanted, shape.end_to_end + M_PI * (rolled - narrowest));
  const double narrow = rolled - (drawn - shape.end_to_end) / M_PI;
  const double rho = before_smoothing(narrow, h);
  const double near = rolled + rho - narrow, far = near - 2.0 * rho, centre = near - rho;
  const double bottom = middle - 0.5 * drawn, top = middle + 0.5 * drawn;

  // Standing parts lie at +-u from the axis. Opposite-handed tails lie on either side of the loop's plane, so u lies in
  // the plane; the axis is then set off so that the inner strand runs straight to its roller.
  const bool same = shape.handedness == Handedness::kSame;
  const Vec3 u = same ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 v = same ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 origin(same ? near : near + coil.strand, 0.0, middle);
  const KnotFrame lower{origin, -u, same ? v : Vec3(-v), -Vec3::UnitZ()};
  const KnotFrame upper{origin, u, v, Vec3::UnitZ()};
  // Where strands meet their rollers, along y: away from the neighbouring tail, back into the plane around the roller.
  const double upper_y = same ? -coil.strand : 0.0;
  const double lower_y = coil.strand;
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };

  const double spacing = drawing_spacing(h, shape.edge_length);
  Path knot_path(spacing);
  const KnotMarks marks = draw_knot(lower, coil, c, h, shape.tail, knot_path);
  Path path(spacing);
  for (auto point = knot_path.points().rbegin(); point != knot_path.points().rend(); ++point) path.add(*point);
  const double first_middle = path.length();
  path.add(upper.at(coil.strand, M_PI, c + past));
  path.add(Vec3(near, upper_y, top));
  const double upper_begin = path.length();
  path.add_curve(M_PI * rho, [&](double t) {
    return Vec3(centre + rho * std::cos(M_PI * t), upper_y * (1.0 - ease(t)), top + rho * std::sin(M_PI * t));
  });
  const double upper_end = path.length();
  const double upper_apex = 0.5 * (upper_begin + upper_end);
  path.add(Vec3(far, 0.0, bottom));
  const double lower_begin = path.length();
  path.add_curve(M_PI * rho, [&](double t) {
    return Vec3(centre - rho * std::cos(M_PI * t), lower_y * ease(t), bottom - rho * std::sin(M_PI * t));
  });
  const double lower_end = path.length();
  const double lower_apex = 0.5 * (lower_begin + lower_end);
  path.add(lower.at(coil.strand, M_PI, c + past));
  path.add(lower.at(coil.strand, M_PI, 0.0));
  const double second_middle = path.length();
  draw_knot(upper, coil, c, h, shape.tail, path);

  // Each knot's own strand, and between it and its roller the strand that the other knot holds.
  const double fine = shape.edge_length / shape.refinement;
  EdgeGrading grading;
  grading.coarse = std::min(shape.coarsening * shape.edge_length, 2.0 * h);
  grading.zones = {{first_middle - marks.tail_exit, first_middle - marks.standing_begin, fine},
                   {second_middle + marks.standing_begin, second_middle + marks.tail_exit, fine},
                   {0.0, upper_begin, shape.edge_length},
                   {lower_end, path.length(), shape.edge_length}};
  const Resampled rod(path, smoothed(path, h, spacing), grading);
  Centreline centreline;
  centreline.points = rod.points;
  centreline.upper_apex = rod(upper_apex);
  centreline.lower_apex = rod(lower_apex);
  centreline.loop = {drawn, narrow, rod(upper_end), rod(lower_begin)};
  KnotLandmarks first{};
  first.tail_end = 0.0;
  first.tail_exit = rod(first_middle - marks.tail_exit);
  first.coil_middle = rod(first_middle - marks.coil_middle);
  first.standing_begin = rod(first_middle - marks.standing_begin);
  first.threaded = rod(second_middle - c);
  KnotLandmarks second{};
  second.tail_end = rod(path.length());
  second.tail_exit = rod(second_middle + marks.tail_exit);
  second.coil_middle = rod(second_middle + marks.coil_middle);
  second.standing_begin = rod(second_middle + marks.standing_begin);
  second.threaded = rod(first_middle + c);
  centreline.knots = {first, second};
  check_no_overlap(centreline, h, "specimen.knot_distance", text(shape.knot_distance));
  return centreline;
}

}  // namespace knot_utm
