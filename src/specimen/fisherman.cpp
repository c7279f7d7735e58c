#include "knot_utm/specimen/fisherman.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "path.hpp"

namespace knot_utm {
namespace {

constexpr double kFineBeyondCoil = 3.0;   // length of fine edges on the threaded strand beyond the coil [h]
constexpr double kHalfOfCoil = 2.0;       // half the axial length of a coil of one winding [h]
constexpr double kBeyondWindings = 0.25;  // turns of a coil beyond its windings, from standing part to tail
constexpr double kLeastDistance = 12.0;   // of the two knots: room for the coils themselves [h]

/// By how much a coil of so many windings exceeds one of a single winding, to either side of its middle, at the same
/// pitch.
double longer_coil(int windings, double h) { return kHalfOfCoil / (1.0 + kBeyondWindings) * (windings - 1) * h; }

/// Dimensions of one overhand of the fisherman's loop, in cylindrical coordinates about the knots' axis [m].
struct Coil {
  double strand;  ///< a, radius at which standing part and threaded strand run
  double tail;    ///< b, radius at which the tail runs
  double radius;  ///< R, of the coil
  double half;    ///< w, half its axial length
  double wrap;    ///< angle of the coil [rad]
  double outer;   ///< axial distance of the outermost point of the overhand from its middle
  double inner;   ///< the same of its innermost point
};

/// Cylindrical coordinates of a knot's own strand. The axis passes through `origin`, z' = 0, in the direction
/// `outwards`; the knot's middle is at z' = c; angles run from `u` (standing part) to `v` (tail).
struct KnotFrame {
  Vec3 origin, u, v, outwards;
  Vec3 at(double r, double angle, double z) const {
    return origin + r * (std::cos(angle) * u + std::sin(angle) * v) + z * outwards;
  }
};

/// Arclengths along a knot's own strand from z' = 0 [m].
struct KnotMarks {
  double standing_begin, coil_middle, tail_exit, tail_end;
};

KnotMarks sketch_knot(const KnotFrame& frame, const Coil& coil, double c, double radius, double tail, Path& path) {
  KnotMarks marks{};
  marks.standing_begin = c - 3.0 * radius - coil.half;
  path.add(frame.at(coil.strand, 0.0, 0.0));
  path.add(frame.at(coil.strand, 0.0, c + coil.half));
  const double turn_out = 0.5 * (coil.radius - coil.strand);
  path.add_curve(M_PI * turn_out, [&](double t) {
    return frame.at(coil.strand + turn_out * (1.0 - std::cos(M_PI * t)), 0.0,
                    c + coil.half + turn_out * std::sin(M_PI * t));
  });
  const double coil_begin = path.length();
  path.add_curve(coil.wrap * coil.radius,
                 [&](double t) { return frame.at(coil.radius, coil.wrap * t, c + coil.half * (1.0 - 2.0 * t)); });
  marks.coil_middle = 0.5 * (coil_begin + path.length());
  const double turn_in = 0.5 * (coil.radius - coil.tail);
  path.add_curve(M_PI * turn_in, [&](double t) {
    return frame.at(coil.tail + turn_in * (1.0 + std::cos(M_PI * t)), coil.wrap,
                    c - coil.half - turn_in * std::sin(M_PI * t));
  });
  path.add(frame.at(coil.tail, coil.wrap, c + coil.outer));
  marks.tail_exit = path.length();
  path.add(frame.at(coil.tail, coil.wrap, c + coil.outer + tail));
  marks.tail_end = path.length();
  return marks;
}

void check_fisherman(const FishermanShape& shape) {
  check_radius(shape.radius);
  check_edge_length(shape.edge_length, shape.radius);
  if (!(shape.looseness >= 3.9 && shape.looseness <= 8.0))
    throw InvalidInput("specimen.looseness", text(shape.looseness), "3.9 to 8 radii of the rod");
  if (!(shape.tail >= 2.0 * shape.radius))
    throw InvalidInput("specimen.tail", text(shape.tail),
                       "at least the diameter of the rod, " + least_text(2.0 * shape.radius) + " m");
  if (!(shape.end_to_end > 0.0 && shape.end_to_end <= 100.0))
    throw InvalidInput("specimen.end_to_end", text(shape.end_to_end), "above 0 and at most 100 m");
}

/// The coil that leaves equal gaps between standing part, threaded strand, tail and coil.
Coil coil_of(const FishermanShape& shape) {
  const double h = shape.radius;
  Coil coil{};
  coil.strand = (2.0 - std::sqrt(3.0)) * shape.looseness * h;
  coil.radius = before_smoothing(shape.looseness * h, h);
  coil.tail = shape.looseness * h - 2.0 * coil.strand;
  coil.half = kHalfOfCoil * h + longer_coil(shape.windings, h);
  coil.wrap = 2.0 * (kBeyondWindings + shape.windings) * M_PI;
  coil.outer = coil.half + 0.5 * (coil.radius - coil.strand);
  coil.inner = coil.half + 0.5 * (coil.radius - coil.tail);
  return coil;
}

/// Half the width of the narrowest loop whose far side a coil clears.
double narrowest_loop(const Coil& coil, double h) { return 0.5 * (coil.radius + 2.5 * h); }

/// Distance of a rod on a roller from the roller's axis.
double distance_on_roller(const FishermanShape& shape, const Coil& coil) {
  const double rolled = shape.roller_radius + shape.radius;
  if (!(rolled >= narrowest_loop(coil, shape.radius)))
    throw InvalidInput("machine.roller_diameter", text(2.0 * shape.roller_radius),
                       "at least " + least_text(coil.radius + 0.5 * shape.radius) + " m for the coils of this rod");
  return rolled;
}

/// Axial distance from the middle of a knot at which the threaded strand leaves it for its roller.
double strand_leaves(const Coil& coil, double h) { return coil.outer + 2.0 * h; }

/// Distance c of each coil's middle from the middle of the loop. Checked: the knots clear each other, their strands
/// reach the rollers, and their coils clear the rollers.
double knot_height(const FishermanShape& shape, const Coil& coil, double rolled) {
  const double h = shape.radius;
  const double c = 0.5 * (shape.knot_distance - shape.outward_shift);
  const double middle = 0.5 * shape.end_to_end;
  const double beside_axis = std::max(0.0, rolled - coil.radius);
  const double roller_reach = coil.radius > rolled ? rolled : std::sqrt(rolled * rolled - beside_axis * beside_axis);
  const double c_min = coil.inner + 1.25 * h;
  const double c_max = middle - std::max(strand_leaves(coil, h) + h, coil.outer + h + roller_reach);
  if (!(c_max > c_min))
    throw InvalidInput("specimen.end_to_end", text(shape.end_to_end),
                       "at least " + least_text(2.0 * (c_min + middle - c_max)) + " m for this rod and these rollers");
  if (!(c >= c_min)) {
    const double least = std::max(kLeastDistance * h, 2.0 * c_min + shape.outward_shift);
    throw InvalidInput("specimen.knot_distance", text(shape.knot_distance),
                       "at least " + least_text(least) + " m for this rod and these rollers");
  }
  if (!(c <= c_max))
    throw InvalidInput("specimen.end_to_end", text(shape.end_to_end),
                       "at least " + least_text(shape.end_to_end + 2.0 * (c - c_max)) + " m for a knot_distance of " +
                           text(shape.knot_distance) + " m, this rod and these rollers");
  return c;
}

/// The loop without its knots: two straight sides at x = near and far, from z = bottom to top, and two half circles.
struct Outline {
  double length;  ///< of the straight sides
  double narrow;  ///< radius of the half circles after smoothing
  double rho;     ///< their radius before smoothing
  double near, far, centre;
  double bottom, top;
};

/// Where the straight strands beyond the knots are too short, both half circles are sketched further out and narrower,
/// so that the length of the rod stays the same.
Outline outline_of(const FishermanShape& shape, const Coil& coil, double rolled, double c) {
  const double narrowest = std::min(rolled, narrowest_loop(coil, shape.radius));
  const double wanted = std::max(shape.end_to_end, 2.0 * (c + shape.straight));
  Outline out{};
  out.length = std::min(wanted, shape.end_to_end + M_PI * (rolled - narrowest));
  out.narrow = rolled - (out.length - shape.end_to_end) / M_PI;
  out.rho = before_smoothing(out.narrow, shape.radius);
  out.near = rolled + out.rho - out.narrow;
  out.far = out.near - 2.0 * out.rho;
  out.centre = out.near - out.rho;
  const double middle = 0.5 * shape.end_to_end;
  out.bottom = middle - 0.5 * out.length;
  out.top = middle + 0.5 * out.length;
  return out;
}

struct KnotFrames {
  KnotFrame lower, upper;
  double lower_y, upper_y;  ///< y at which strands meet their rollers, away from the neighbouring tail
};

/// Standing parts lie at +-u from the axis. Opposite-handed tails lie on either side of the loop's plane, so that u has
/// to lie in the plane; the axis is then offset, so that the inner strand runs straight to its roller.
KnotFrames frames_of(const FishermanShape& shape, const Coil& coil, const Outline& outline) {
  const bool same = shape.handedness == Handedness::kSame;
  const Vec3 u = same ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 v = same ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 origin(same ? outline.near : outline.near + coil.strand, 0.0, 0.5 * shape.end_to_end);
  return {{origin, -u, same ? v : Vec3(-v), -Vec3::UnitZ()},
          {origin, u, v, Vec3::UnitZ()},
          coil.strand,
          same ? -coil.strand : 0.0};
}

/// The whole rod, and arclengths at which its parts begin and end.
struct LoopSketch {
  Path path;
  KnotMarks marks;                                 ///< of either knot
  double first_middle = 0.0, second_middle = 0.0;  ///< z' = 0 on the own strand of the lower and of the upper knot
  double upper_begin = 0.0, upper_end = 0.0, lower_begin = 0.0, lower_end = 0.0;  ///< half circles
};

LoopSketch sketch_loop(const FishermanShape& shape, const Coil& coil, const Outline& o, const KnotFrames& knots,
                       double c) {
  const double spacing = sketch_spacing(shape.radius, shape.edge_length);
  const double past = strand_leaves(coil, shape.radius);
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };  // back into the plane around the roller
  Path knot_path(spacing);
  LoopSketch out{Path(spacing), sketch_knot(knots.lower, coil, c, shape.radius, shape.tail, knot_path)};
  Path& path = out.path;
  for (auto point = knot_path.points().rbegin(); point != knot_path.points().rend(); ++point) path.add(*point);
  out.first_middle = path.length();
  path.add(knots.upper.at(coil.strand, M_PI, c + past));
  path.add(Vec3(o.near, knots.upper_y, o.top));
  out.upper_begin = path.length();
  path.add_curve(M_PI * o.rho, [&](double t) {
    return Vec3(o.centre + o.rho * std::cos(M_PI * t), knots.upper_y * (1.0 - ease(t)),
                o.top + o.rho * std::sin(M_PI * t));
  });
  out.upper_end = path.length();
  path.add(Vec3(o.far, 0.0, o.bottom));
  out.lower_begin = path.length();
  path.add_curve(M_PI * o.rho, [&](double t) {
    return Vec3(o.centre - o.rho * std::cos(M_PI * t), knots.lower_y * ease(t), o.bottom - o.rho * std::sin(M_PI * t));
  });
  out.lower_end = path.length();
  path.add(knots.lower.at(coil.strand, M_PI, c + past));
  path.add(knots.lower.at(coil.strand, M_PI, 0.0));
  out.second_middle = path.length();
  sketch_knot(knots.upper, coil, c, shape.radius, shape.tail, path);
  return out;
}

/// Both strands between and within the knots have fine edges, as coil and threaded strand press on each other, and the
/// coil slides along that strand towards the other knot.
EdgeGrading grading_of(const FishermanShape& shape, const Coil& coil, const LoopSketch& loop) {
  const double fine = shape.edge_length / shape.refinement;
  const KnotMarks& marks = loop.marks;
  EdgeGrading grading;
  grading.coarse = std::min(shape.coarsening * shape.edge_length, 2.0 * shape.radius);
  const double beyond = 0.5 * shape.knot_distance + coil.outer + kFineBeyondCoil * shape.radius;
  grading.zones = {{loop.first_middle - marks.tail_exit, loop.first_middle + beyond, fine},
                   {loop.second_middle - beyond, loop.second_middle + marks.tail_exit, fine},
                   {0.0, loop.upper_begin, shape.edge_length},
                   {loop.lower_end, loop.path.length(), shape.edge_length}};
  return grading;
}

/// Distance that a knot of several windings may run outwards, as it tightens, beyond that of a single winding [m]. Its
/// coils are sketched with the radius R = looseness h. Three strands run through a tight coil, each against the other
/// two: standing part, threaded strand and tail. Its centreline therefore has the radius (2 + 2/sqrt 3) h, and each
/// winding gives up
///
///     2 pi (R - (2 + 2/sqrt 3) h)
///
/// of the rod, half of it to the standing part and half to the tail, as friction is the same towards both. Where the
/// standing part is held, the knot runs outwards by its half.
double runs_out(int windings, double looseness, double h) {
  const double tight = 2.0 + 2.0 / std::sqrt(3.0);
  return M_PI * (looseness - tight) * h * (windings - 1);
}

/// `middle`: where the knot's own strand begins, which leads to its tail along the rod (`sense` 1) or against it (-1).
/// `threaded`: where this knot's coil holds the other end's strand. Arclengths of the path [m].
KnotLandmarks landmarks_of(const FishermanShape& shape, const Resampled& rod, const KnotMarks& marks, double middle,
                           double sense, double tail_end, double threaded) {
  KnotLandmarks out{};
  out.tail_end = rod(tail_end);
  out.tail_exit = rod(middle + sense * marks.tail_exit);
  out.coil_middle = rod(middle + sense * marks.coil_middle);
  out.standing_begin = rod(middle + sense * marks.standing_begin);
  out.threaded = rod(threaded);
  out.windings = shape.windings;
  out.longer = longer_coil(shape.windings, shape.radius);
  out.runs_out = runs_out(shape.windings, shape.looseness, shape.radius);
  return out;
}

}  // namespace

Centreline fisherman_loop(const FishermanShape& shape) {
  check_fisherman(shape);
  const double h = shape.radius;
  const Coil coil = coil_of(shape);
  const double rolled = distance_on_roller(shape, coil);
  const double c = knot_height(shape, coil, rolled);
  const Outline outline = outline_of(shape, coil, rolled, c);
  const LoopSketch loop = sketch_loop(shape, coil, outline, frames_of(shape, coil, outline), c);
  const Resampled rod(loop.path, smoothed(loop.path, h, sketch_spacing(h, shape.edge_length)),
                      grading_of(shape, coil, loop));
  Centreline centreline;
  centreline.points = rod.points;
  centreline.upper_apex = rod(0.5 * (loop.upper_begin + loop.upper_end));
  centreline.lower_apex = rod(0.5 * (loop.lower_begin + loop.lower_end));
  centreline.loop = {outline.length, outline.narrow, rod(loop.upper_end), rod(loop.lower_begin)};
  centreline.knots = {
      landmarks_of(shape, rod, loop.marks, loop.first_middle, -1.0, 0.0, loop.second_middle - c),
      landmarks_of(shape, rod, loop.marks, loop.second_middle, 1.0, loop.path.length(), loop.first_middle + c)};
  check_no_overlap(centreline, h, "specimen.knot_distance", text(shape.knot_distance));
  return centreline;
}

namespace {

// These are the lengths of the shipped method, for the paper's radius [m].
constexpr double kKnotDistance = 0.15, kEndToEnd = 0.25, kTail = 0.03, kRollerDiameter = 0.0381, kWay = 0.12;
constexpr double kWayOfDistance = 0.7;   // extension of a pull over e: knots far apart lock by then
constexpr double kFractionOfLoop = 0.6;  // e over L, as in the paper
constexpr double kCoarsening = 1.5;      // of edges on the far side of a loop, which touches nothing but rollers

// By how much tying moves the two knots apart. Fitted so that the four shipped materials end within 5 % of the distance
// that is asked for, with e from 0.11 to 0.19 m: `tied_knot_distance` of config/tighten.yaml with material= and
// specimen.knot_distance= set, and specimen.end_to_end=0.3, which has room for all of them.
constexpr double kGivenUp = 16.6;  // both knots run outwards by what their coils give up as they tighten [h]
// More by this for each winding after the first; the double fisherman's knots then end within 8 % of the distance [h].
constexpr double kGivenUpByWinding = 3.0;
constexpr double kGivenUpByStrain = 2.6;  // more by this where the pre-load stretches the rod [h per unit of strain]
constexpr double kRecovered = 0.075;      // of what it stretched between them, which is short again once released [-]
constexpr double kLargestTyingStrain = 1.0;  // beyond it nothing was measured, and the shift stays what it is [-]

double outward_shift(const SpecimenOptions& specimen, const Material& material, int windings) {
  const double strain = std::min(strain_under(material, tying_load(specimen, material)), kLargestTyingStrain);
  return (kGivenUp + kGivenUpByWinding * (windings - 1) + kGivenUpByStrain * strain) * material.radius -
         kRecovered * strain * specimen.knot_distance;
}

/// The least L for knots at this distance with which their coils clear the rollers, and the rollers each other.
double least_end_to_end(double knot_distance, double roller_diameter, double h) {
  const double between = knot_distance + 2.0 * (5.0 * h + std::sqrt(9.0 * h * (0.5 * roller_diameter + h)));
  return std::max(between, roller_diameter + 4.0 * h);
}

/// knot: fisherman.
class FishermanKnot : public Knot {
 public:
  FishermanKnot() {
    about_.name = "fisherman";
    about_.title = "Fisherman's knot";
    about_.keys = {"handedness", "knot_distance", "end_to_end", "tail", "preload", "refinement"};
    about_.knots = 2;
    about_.loop = true;
    about_.sketched_coil = FishermanShape().looseness;
    about_.error_study = ErrorStudy::kFisherman;
  }

  SpecimenOptions defaults(double h) const override {
    const double r = h / kPaperRadius;
    SpecimenOptions out;
    out.edge_length = kPaperKnottedEdge * r;
    out.knot_distance = kKnotDistance * r;
    out.end_to_end = kEndToEnd * r;
    out.tail = kTail * r;
    return out;
  }

  void suit(const SpecimenOptions& known, double roller_diameter, double h, SpecimenOptions& out) const override {
    const double r = h / kPaperRadius, e = known.knot_distance;
    out.knot_distance = std::min(kKnotDistance * r, kFractionOfLoop * known.end_to_end);
    // Further windings need more room: on the strands outside of both coils, and on the tails.
    const double longer = 2.0 * runs_out(windings(known), FishermanShape().looseness, h);
    const bool roomy = kEndToEnd * r >= e + 12.0 * h + longer && roller_diameter <= kRollerDiameter * r;
    if (!roomy) out.end_to_end = std::max(kEndToEnd * r, least_end_to_end(e, roller_diameter, h) + longer);
    out.tail = kTail * r * windings(known);
  }

  std::optional<double> roller_diameter(double h) const override { return kRollerDiameter * (h / kPaperRadius); }

  double pull(const SpecimenOptions& specimen, double h) const override {
    return std::max(kWay * (h / kPaperRadius), kWayOfDistance * specimen.knot_distance);
  }

  void check(const SpecimenOptions& specimen, double h) const override {
    // A coarse check: room for the coils. fisherman_loop() checks the shape itself.
    if (specimen.knot_distance < kLeastDistance * h)
      throw InvalidInput("specimen.knot_distance", format_number(specimen.knot_distance),
                         "at least 12 radii, " + least_text(kLeastDistance * h) + " m");
    if (specimen.end_to_end < specimen.knot_distance + 12.0 * h)
      throw InvalidInput(
          "specimen.end_to_end", format_number(specimen.end_to_end),
          "at least knot_distance plus 12 radii, " + least_text(specimen.knot_distance + 12.0 * h) + " m");
  }

  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override {
    FishermanShape shape;
    shape.radius = material.radius;
    shape.knot_distance = specimen.knot_distance;
    shape.windings = windings(specimen);
    if (specimen.to_be_tied && mounting.rollers)
      shape.straight = straight_strand(material.radius, runs_out(shape.windings, shape.looseness, material.radius));
    shape.outward_shift = specimen.to_be_tied ? outward_shift(specimen, material, shape.windings) : 0.0;
    shape.end_to_end = specimen.end_to_end;
    shape.roller_radius = 0.5 * mounting.roller_diameter;
    shape.tail = specimen.tail;
    shape.handedness = specimen.handedness;
    shape.edge_length = specimen.edge_length;
    shape.refinement = mounting.refinement;
    shape.coarsening = kCoarsening;
    return fisherman_loop(shape);
  }

  /// The bottom and the top of the loop.
  std::vector<HeldNode> held_lower(const Centreline& centreline, bool) const override {
    const int node = centreline.nearest_node(centreline.lower_apex);
    return {HeldNode{node, node + 1}};
  }

  std::vector<HeldNode> held_upper(const Centreline& centreline, bool) const override {
    const int node = centreline.nearest_node(centreline.upper_apex);
    return {HeldNode{node, node + 1}};
  }

 private:
  /// How often each tail is wound around.
  virtual int windings(const SpecimenOptions&) const { return 1; }
};

/// knot: multiple_fisherman. The double fisherman's knot (grapevine) and those with more windings: the loop of the
/// fisherman's knot, with each tail wound `turns` times around the other strand and itself before it goes through.
class MultipleFishermanKnot final : public FishermanKnot {
 public:
  MultipleFishermanKnot() {
    about_.name = "multiple_fisherman";
    about_.title = "Multiple fisherman's knot";
    about_.keys.insert(about_.keys.begin(), "turns");
    about_.error_study = ErrorStudy::kNone;
  }

  SpecimenOptions defaults(double h) const override {
    SpecimenOptions out = FishermanKnot::defaults(h);
    out.turns = 2;
    return out;
  }
  void check(const SpecimenOptions& specimen, double h) const override {
    if (specimen.turns < 2 || specimen.turns > 3)
      throw InvalidInput("specimen.turns", std::to_string(specimen.turns),
                         "2 or 3; knot: fisherman winds its tails once");
    FishermanKnot::check(specimen, h);
  }

 private:
  int windings(const SpecimenOptions& specimen) const override { return specimen.turns; }
};

}  // namespace

std::unique_ptr<const Knot> fisherman_knot() { return std::make_unique<FishermanKnot>(); }

std::unique_ptr<const Knot> multiple_fisherman_knot() { return std::make_unique<MultipleFishermanKnot>(); }

}  // namespace knot_utm
