#include "knot_utm/specimen/knot_drawing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "path.hpp"

namespace knot_utm {
namespace {

constexpr double kStraightToGrip = 4.0;  // least length of a held strand between its last point and its grip [h]
constexpr double kSame = 1.0 + 1e-6;     // ratio of lengths up to which they are equal but for rounding in a method
constexpr double kMayCut = 0.99;  // least distance from a post over that at touch: edges cut the corners of a bend

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The centripetal Catmull-Rom curve through four points at parameter `t`, 0 at the second point and 1 at the third, by
/// the recursion of Barry and Goldman.
Vec3 catmull_rom(const Vec3 (&p)[4], double t) {
  double knot[4] = {0.0};
  for (int i = 1; i < 4; ++i) knot[i] = knot[i - 1] + std::sqrt((p[i] - p[i - 1]).norm());
  const double u = knot[1] + t * (knot[2] - knot[1]);
  const auto between = [&](const Vec3& a, const Vec3& b, int i, int j) -> Vec3 {
    return ((knot[j] - u) * a + (u - knot[i]) * b) / (knot[j] - knot[i]);
  };
  const Vec3 a = between(p[0], p[1], 0, 1), b = between(p[1], p[2], 1, 2), c = between(p[2], p[3], 2, 3);
  return between(between(a, b, 0, 2), between(b, c, 1, 3), 1, 2);
}

struct SketchedStrand {
  Points points;
  std::vector<double> places;  // arclengths along its edges of the points of the drawing [m]
};

/// Sketches the strands of a drawing in metres, with the lower grip at z = 0.
class Sketcher {
 public:
  Sketcher(const KnotDrawing& drawing, const SketchSize& size)
      : drawing_(drawing), size_(size), origin_(height_of_origin(drawing, size)) {}

  /// `part`: radius and edge length of the strand over those of the thickest one.
  SketchedStrand strand(const KnotDrawing::Strand& strand, double part) const {
    const double spacing = sketch_spacing(part * size_.radius, part * size_.edge_length / size_.refinement);
    std::vector<Vec3> points;
    for (const Vec3& point : strand.points) points.push_back(placed(point));
    const Vec3 begin = run_out(strand.ends[0], points[0], points[1]),
               end = run_out(strand.ends[1], points.back(), points[points.size() - 2]);
    Path path(spacing);
    path.add(begin);
    std::vector<double> places{(points[0] - begin).norm()};
    const std::size_t last = points.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
      // Beyond its ends the strand runs on straight.
      const Vec3 p[4] = {i == 0 ? ahead(points[0], begin, points[1]) : points[i - 1], points[i], points[i + 1],
                         i + 1 == last ? ahead(points[last], end, points[last - 1]) : points[i + 2]};
      path.add_curve((p[2] - p[1]).norm(), [&](double t) { return catmull_rom(p, t); });
      places.push_back(path.length());
    }
    path.add(end);
    const EdgeGrading even{part * size_.edge_length / size_.refinement, {}};
    const Resampled rod(path, smoothed(path, size_.radius, spacing), even);
    for (double& place : places) place = rod(place);
    return {rod.points, std::move(places)};
  }

  Vec3 placed(const Vec3& point) const { return size_.radius * point + origin_ * Vec3::UnitZ(); }

  /// The end of a strand beyond its last point, which follows `before`.
  Vec3 run_out(const std::string& end, const Vec3& last, const Vec3& before) const {
    switch (drawing_.held(end)) {
      case KnotDrawing::End::kLower:
        return {last[0], last[1], 0.0};
      case KnotDrawing::End::kUpper:
        return {last[0], last[1], size_.end_to_end};
      case KnotDrawing::End::kFree:
        break;
    }
    return last + size_.tail * (last - before).normalized();
  }

 private:
  /// The point in the direction from `from` to `towards` whose distance is that of `other`.
  static Vec3 ahead(const Vec3& from, const Vec3& towards, const Vec3& other) {
    return from + (other - from).norm() * (towards - from).normalized();
  }

  const KnotDrawing& drawing_;
  const SketchSize& size_;
  double origin_;
};

void check_posts(const KnotDrawing& drawing, const SketchSize& size, const Centreline& rod) {
  const double h = size.radius;
  const Vec3 origin(0.0, 0.0, height_of_origin(drawing, size));
  for (std::size_t k = 0; k < drawing.posts.size(); ++k) {
    const Roller post = roller_of(drawing.posts[k], h, origin);
    const auto distance = [&](Eigen::Index i) { return beside(post, rod.points.col(i)).x.norm(); };
    Eigen::Index nearest = 0;
    for (Eigen::Index i = 1; i < rod.points.cols(); ++i)
      if (distance(i) < distance(nearest)) nearest = i;
    const double least = post.radius + h;
    if (distance(nearest) < kMayCut * least)
      throw InvalidInput::sentence("specimen.knot", "specimen.knot " + shown(drawing.name) + ": at " +
                                                        place_text((rod.points.col(nearest) - origin) / h) +
                                                        " a strand comes as near as " + text(distance(nearest) / h) +
                                                        " radii to the middle of posts." + std::to_string(k) +
                                                        ", but must stay " + text(least / h) + " radii away from it");
  }
}

/// A rod cannot bend with a radius below its own.
void check_bends(const KnotDrawing& drawing, double radius, const Points& strand) {
  for (Eigen::Index i = 1; i + 1 < strand.cols(); ++i) {
    const Vec3 before = strand.col(i) - strand.col(i - 1), after = strand.col(i + 1) - strand.col(i);
    const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
    const double bend = 0.5 * (before.norm() + after.norm()) / turn;
    if (bend < radius)
      throw InvalidInput::sentence("specimen.knot", "specimen.knot " + shown(drawing.name) +
                                                        ": a strand bends with a radius of " + text(bend / radius) +
                                                        " radii of the rod, but must do so with at least one");
  }
}

int node_at(double place, const Points& strand) {
  const std::vector<double> at = arclengths(strand);
  const auto nearer = [&](double a, double b) { return std::abs(a - place) < std::abs(b - place); };
  return static_cast<int>(std::min_element(at.begin(), at.end(), nearer) - at.begin());
}

/// The node of an end, and its neighbour on the strand.
struct EndNode {
  int node, next;
};

/// The nodes that a drawing names.
struct NamedNodes {
  std::vector<std::pair<std::string, EndNode>> ends;
  std::vector<int> landmarks;
};

void check_room(const KnotDrawing& drawing, const SketchSize& size) {
  const double least = least_end_to_end(drawing, size.radius);
  if (!(size.end_to_end >= least))
    throw InvalidInput("specimen.end_to_end", text(size.end_to_end),
                       "at least " + least_text(least) + " m for knot: " + drawing.name);
  if (drawing.lower.empty() && drawing.upper.empty() && size.end_to_end > kSame * least)
    throw InvalidInput("specimen.end_to_end", text(size.end_to_end),
                       "auto, " + text(least) + " m, which its posts are apart, for knot: " + drawing.name);
}

/// Joins strands to one rod by cut edges, and finds the nodes that the drawing names.
NamedNodes join(const KnotDrawing& drawing, const std::vector<SketchedStrand>& strands, Centreline& out) {
  NamedNodes named;
  named.landmarks.resize(drawing.landmarks.size());
  Eigen::Index nodes = 0;
  for (const SketchedStrand& strand : strands) nodes += strand.points.cols();
  out.points.resize(3, nodes);
  int begin = 0;
  for (std::size_t k = 0; k < strands.size(); ++k) {
    const Points& points = strands[k].points;
    const int end = begin + static_cast<int>(points.cols());
    out.points.middleCols(begin, points.cols()) = points;
    for (std::size_t i = 0; i < named.landmarks.size(); ++i)
      if (const KnotDrawing::Landmark& landmark = drawing.landmarks[i]; landmark.strand == k)
        named.landmarks[i] = begin + node_at(strands[k].places[landmark.point], points);
    if (k > 0) out.cuts.push_back(begin - 1);
    named.ends.push_back({drawing.strands[k].ends[0], {begin, begin + 1}});
    named.ends.push_back({drawing.strands[k].ends[1], {end - 1, end - 2}});
    begin = end;
  }
  return named;
}

/// Which nodes are held, pulled, loaded by weights, and read.
void name_nodes(const KnotDrawing& drawing, const NamedNodes& named, Centreline& out) {
  for (const auto& [name, at] : named.ends) {
    if (contains(drawing.lower, name)) out.held_lower.push_back({at.node, at.next});
    if (contains(drawing.upper, name)) out.held_upper.push_back({at.node, at.next});
    if (drawing.held(name) == KnotDrawing::End::kFree) out.free_ends.push_back(at.node);
  }
  const auto pulled = [&](const std::vector<KnotDrawing::Pull>& pulls) {
    std::vector<PulledEnd> found;
    for (const KnotDrawing::Pull& pull : pulls)
      for (const auto& [name, at] : named.ends)
        if (name == pull.end && drawing.held(name) != KnotDrawing::End::kFree)
          found.push_back({at.node, Vec3::UnitZ(), pull.fraction, at.next});
        else if (name == pull.end)
          found.push_back({at.node, (out.points.col(at.node) - out.points.col(at.next)).normalized(), pull.fraction});
    return found;
  };
  for (const std::vector<KnotDrawing::Pull>& together : drawing.tie) out.pull_groups.push_back(pulled(together));
  for (const KnotDrawing::Pull& weight : drawing.weights) {
    for (const auto& [name, at] : named.ends)
      if (name == weight.end) out.weights.push_back({at.node, weight.fraction});
    for (std::size_t i = 0; i < named.landmarks.size(); ++i)
      if (drawing.landmarks[i].name == weight.end) out.weights.push_back({named.landmarks[i], weight.fraction});
  }
  for (const KnotDrawing::Reading& reading : drawing.readings)
    out.readings.push_back({reading.kind, named.landmarks[reading.first], named.landmarks[reading.second]});
}

}  // namespace

KnotDrawing::End KnotDrawing::held(const std::string& end) const {
  if (contains(lower, end)) return End::kLower;
  return contains(upper, end) ? End::kUpper : End::kFree;
}

const KnotDrawing::Post* KnotDrawing::post_of(bool upper_grip) const {
  const auto found = std::find_if(posts.begin(), posts.end(), [&](const Post& one) { return one.upper == upper_grip; });
  return (upper_grip ? upper : lower).empty() && found != posts.end() ? &*found : nullptr;
}

Vec3 KnotDrawing::point_in_lower_grip() const {
  for (const Strand& strand : strands) {
    if (held(strand.ends[0]) == End::kLower) return strand.points.front();
    if (held(strand.ends[1]) == End::kLower) return strand.points.back();
  }
  return Vec3::Zero();
}

double KnotDrawing::bottom() const {
  if (const Post* post = post_of(false)) return post->through[2];
  double least = std::numeric_limits<double>::infinity();
  for (const Strand& strand : strands)
    for (const Vec3& point : strand.points) least = std::min(least, point[2]);
  return least;
}

double KnotDrawing::top() const {
  if (const Post* post = post_of(true)) return post->through[2];
  double most = -std::numeric_limits<double>::infinity();
  for (const Strand& strand : strands)
    for (const Vec3& point : strand.points) most = std::max(most, point[2]);
  return most;
}

double least_end_to_end(const KnotDrawing& drawing, double radius) {
  const double lower = drawing.lower.empty() ? 0.0 : kStraightToGrip,
               upper = drawing.upper.empty() ? 0.0 : kStraightToGrip;
  return (drawing.top() - drawing.bottom() + lower + upper) * radius;
}

double height_of_origin(const KnotDrawing& drawing, const SketchSize& size) {
  if (drawing.lower.empty()) return -drawing.bottom() * size.radius;
  if (drawing.upper.empty()) return size.end_to_end - drawing.top() * size.radius;
  return 0.5 * (size.end_to_end - (drawing.top() + drawing.bottom()) * size.radius);
}

Roller roller_of(const KnotDrawing::Post& post, double radius, const Vec3& origin) {
  Roller out;
  out.centre = radius * post.through + origin;
  out.axis = post.along;
  out.radius = radius * post.radius;
  out.ring = radius * post.ring;
  return out;
}

Centreline sketch(const KnotDrawing& drawing, const SketchSize& size) {
  check_radius(size.radius);
  check_edge_length(size.edge_length, size.radius);
  check_room(drawing, size);
  const Sketcher sketcher(drawing, size);
  std::vector<SketchedStrand> strands;
  for (const KnotDrawing::Strand& strand : drawing.strands) {
    const double part = strands.empty() ? size.first : size.others;
    strands.push_back(sketcher.strand(strand, part));
    check_bends(drawing, part * size.radius, strands.back().points);
  }
  Centreline out;
  name_nodes(drawing, join(drawing, strands, out), out);
  std::vector<double> radii;
  if (size.first != size.others) {
    radii.assign(strands.size(), size.others * size.radius);
    radii.front() = size.first * size.radius;
  }
  const Vec3 origin(0.0, 0.0, height_of_origin(drawing, size));
  check_no_overlap(out, size.radius, "specimen.knot", drawing.name, radii, &origin);
  check_posts(drawing, size, out);
  return out;
}

namespace {

constexpr double kStrandToGrip = 20.0;  // straight strand between a knot and each grip [h]
constexpr double kSketchedTail = 30.0;  // [h]
constexpr double kSketchedPull = 80.0;  // of a pull: by then a sketched knot is tight, and slides if it does [h]
constexpr double kSketchedCoil = 4.0;   // radius of the bends of a sketched knot [h]

/// A knot that a file describes, of one or more ropes (knot_drawing.hpp). The grips hold ends of its ropes; pulling at
/// the free ones ties it.
class SketchedKnot final : public Knot {
 public:
  SketchedKnot() {
    about_.name = "a file of config/knots/";
    about_.title = "Knot from a file";
    about_.keys = {"end_to_end", "tail", "preload", "refinement", "natural_curvature"};
    about_.any_shape = true;
    about_.tied_by_ends = true;
    about_.sketched_coil = kSketchedCoil;
    about_.error_study = ErrorStudy::kSketchedKnot;
  }

  SpecimenOptions defaults(double h) const override {
    SpecimenOptions out;
    out.edge_length = kPaperKnottedEdge * (h / kPaperRadius);
    out.tail = kSketchedTail * h;
    return out;
  }

  void suit(const SpecimenOptions& known, double, double h, SpecimenOptions& out) const override {
    const bool on_posts = known.drawing->lower.empty() && known.drawing->upper.empty();
    out.end_to_end = least_end_to_end(*known.drawing, h) + (on_posts ? 0.0 : 2.0 * kStrandToGrip * h);
  }

  double pull(const SpecimenOptions&, double h) const override { return kSketchedPull * h; }
  void check(const SpecimenOptions&, double) const override {}

  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override {
    return sketch(*specimen.drawing, size_of(specimen, material, mounting.refinement));
  }

  Supports supports(const SpecimenOptions& specimen, const Material& material) const override {
    Supports out;
    const double h = thickest(material);
    const Vec3 origin(0.0, 0.0, height_of_origin(*specimen.drawing, size_of(specimen, material, 1.0)));
    for (const KnotDrawing::Post& post : specimen.drawing->posts)
      (post.upper ? out.pins : out.posts).push_back(roller_of(post, h, origin));
    return out;
  }

 private:
  static SketchSize size_of(const SpecimenOptions& specimen, const Material& material, double refinement) {
    const double h = thickest(material), others = material.other ? material.other->radius : material.radius;
    return {h, specimen.end_to_end, specimen.tail, specimen.edge_length, material.radius / h, others / h, refinement};
  }
};

}  // namespace

std::unique_ptr<const Knot> sketched_knot() { return std::make_unique<SketchedKnot>(); }

}  // namespace knot_utm
