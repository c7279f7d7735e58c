#include "knot_utm/specimen/centreline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "knot_utm/rod/invalid_input.hpp"

namespace knot_utm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string text(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

/// A path drawn as points that are dense along curves; arclength as it grows.
class Path {
 public:
  explicit Path(double spacing) : spacing_(spacing) {}

  void add(const Vec3& point) {
    if (!points_.empty()) {
      const double step = (point - points_.back()).norm();
      if (step < 1e-9 * spacing_) return;
      length_ += step;
    }
    points_.push_back(point);
    arclength_.push_back(length_);
  }

  /// Adds curve(0) to curve(1), about `length` long.
  template <typename Curve>
  void add_curve(double length, Curve curve) {
    const int pieces = std::max(8, static_cast<int>(std::ceil(length / spacing_)));
    for (int i = 0; i <= pieces; ++i) add(curve(static_cast<double>(i) / pieces));
  }

  double length() const { return length_; }
  const std::vector<Vec3>& points() const { return points_; }

  Vec3 at(double s) const {
    const auto next = std::upper_bound(arclength_.begin(), arclength_.end(), s);
    const auto i =
        std::clamp<std::ptrdiff_t>(next - arclength_.begin(), 1, static_cast<std::ptrdiff_t>(points_.size()) - 1);
    const auto j = static_cast<std::size_t>(i);
    const double t = (s - arclength_[j - 1]) / (arclength_[j] - arclength_[j - 1]);
    return points_[j - 1] + t * (points_[j] - points_[j - 1]);
  }

 private:
  double spacing_;
  double length_ = 0.0;
  std::vector<Vec3> points_;
  std::vector<double> arclength_;
};

/// The path smoothed along its arclength by a Gaussian, sampled evenly: column i was at arclength i length/(columns-1).
/// Beyond its ends the path goes on straight, so ends with a straight piece stay where they are.
Points smoothed(const Path& path, double deviation, double spacing) {
  const auto pieces = static_cast<Eigen::Index>(std::ceil(path.length() / spacing));
  const double step = path.length() / static_cast<double>(pieces);
  const auto reach = static_cast<Eigen::Index>(std::ceil(5.0 * deviation / step));
  Points raw(3, pieces + 1 + 2 * reach);
  for (Eigen::Index i = 0; i < raw.cols(); ++i) raw.col(i) = path.at(static_cast<double>(i - reach) * step);
  Eigen::VectorXd weight(2 * reach + 1);
  for (Eigen::Index i = -reach; i <= reach; ++i) {
    const double x = static_cast<double>(i) * step / deviation;
    weight[i + reach] = std::exp(-0.5 * x * x);
  }
  weight /= weight.sum();
  Points smooth(3, pieces + 1);
  for (Eigen::Index i = 0; i <= pieces; ++i) smooth.col(i).noalias() = raw.middleCols(i, 2 * reach + 1) * weight;
  return smooth;
}

/// Lays equal chords along a polyline.
class ChordWalk {
 public:
  explicit ChordWalk(const Points& points) : points_(points) {
    arclength_.push_back(0.0);
    for (Eigen::Index i = 1; i < points.cols(); ++i) {
      arclength_.push_back(arclength_.back() + (points.col(i) - points.col(i - 1)).norm());
    }
  }

  double length() const { return arclength_.back(); }

  /// How many chords of this length fit, the rest of the last one as a fraction of it. `visit` gets every node that
  /// the chords reach, and where it lies along the polyline.
  template <typename Visit>
  double walk(double chord, Visit visit) const {
    Vec3 from = points_.col(0);
    Eigen::Index segment = 0;
    double along = 0.0;  // of `from` on the segment
    double chords = 0.0;
    const double chord2 = chord * chord;
    while (true) {
      while (segment + 1 < points_.cols() - 1 && (points_.col(segment + 1) - from).squaredNorm() < chord2) {
        ++segment;
        along = 0.0;
      }
      const Vec3 base = points_.col(segment);
      const Vec3 edge = points_.col(segment + 1) - base;
      if ((base + edge - from).squaredNorm() < chord2) return chords + (base + edge - from).norm() / chord;
      // |base + t edge - from| = chord; the polyline leaves the ball in this segment, by the larger root.
      const double a = edge.squaredNorm();
      const double b = edge.dot(base - from);
      const double c = (base - from).squaredNorm() - chord2;
      along = std::clamp((-b + std::sqrt(std::max(0.0, b * b - a * c))) / a, along, 1.0);
      from = base + along * edge;
      chords += 1.0;
      visit(from, arclength_[static_cast<std::size_t>(segment)] + along * std::sqrt(a));
    }
  }

 private:
  const Points& points_;
  std::vector<double> arclength_;
};

double clamp01(double x) { return std::clamp(x, 0.0, 1.0); }

/// Squared distance of the segments p, p + u and q, q + v.
double segment_distance2(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
  const Vec3 r = p - q;
  const double a = u.squaredNorm();
  const double e = v.squaredNorm();
  const double b = u.dot(v);
  const double c = u.dot(r);
  const double f = v.dot(r);
  const double denominator = a * e - b * b;
  double s = denominator > 1e-12 * a * e ? clamp01((b * f - c * e) / denominator) : 0.0;
  const double t = clamp01((b * s + f) / e);
  s = clamp01((b * t - c) / a);
  return (r + s * u - t * v).squaredNorm();
}

void check_edge_length(double edge_length, double radius) {
  if (!(edge_length >= 0.05 * radius && edge_length <= 2.0 * radius)) {
    throw InvalidInput("specimen.edge_length", text(edge_length),
                       text(0.05 * radius) + " to " + text(2.0 * radius) + " m (at most the rod's diameter)");
  }
}

void check_radius(double radius) {
  if (!(radius > 0.0 && radius < 1.0)) throw InvalidInput("material.radius", text(radius), "above 0, below 1 m");
}

/// Spacing at which curves are drawn before they are resampled.
double drawing_spacing(double radius, double edge_length) { return std::min(radius, edge_length) / 16.0; }

/// Resamples a smoothed path and carries arclengths of the path over to the resampled rod.
class Resampled {
 public:
  Resampled(const Path& path, const Points& smooth, double edge_length) : path_length_(path.length()) {
    arclength_.push_back(0.0);
    for (Eigen::Index i = 1; i < smooth.cols(); ++i) {
      arclength_.push_back(arclength_.back() + (smooth.col(i) - smooth.col(i - 1)).norm());
    }
    points = resample_evenly(smooth, edge_length, &node_position_);
  }

  /// Arclength on the rod of the place that was at arclength s of the path.
  double operator()(double s) const {
    const double fine = interpolate(arclength_, s / path_length_ * static_cast<double>(arclength_.size() - 1));
    const auto next = std::upper_bound(node_position_.begin() + 1, node_position_.end() - 1, fine);
    const auto i = static_cast<std::size_t>(next - node_position_.begin());
    const double t = (fine - node_position_[i - 1]) / (node_position_[i] - node_position_[i - 1]);
    return (static_cast<double>(i - 1) + clamp01(t)) * (points.col(1) - points.col(0)).norm();
  }

  Points points;

 private:
  static double interpolate(const std::vector<double>& values, double at) {
    const double last = static_cast<double>(values.size() - 1);
    const double x = std::clamp(at, 0.0, last);
    const auto i = std::min(static_cast<std::size_t>(x), values.size() - 2);
    return values[i] + (x - static_cast<double>(i)) * (values[i + 1] - values[i]);
  }

  double path_length_;
  std::vector<double> arclength_;
  std::vector<double> node_position_;
};

/// One overhand of the fisherman's loop, in lengths.
struct Coil {
  double strand;  ///< a, of standing part and threaded strand from the axis
  double tail;    ///< b
  double radius;  ///< R
  double half;    ///< w, half its axial length
  double outer;   ///< of its outermost point from its middle
  double inner;   ///< of its innermost point
};

/// Radius to draw with so that a circle smoothed by a Gaussian ends up with the given one.
double before_smoothing(double radius, double deviation) {
  return radius * std::exp(0.5 * std::pow(deviation / radius, 2));
}

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
    throw InvalidInput("specimen.looseness", text(shape.looseness), "3.9 to 8 (radius of the coil over the rod's)");
  }
  if (!(shape.tail >= 2.0 * shape.radius && shape.tail <= 10.0)) {
    throw InvalidInput("specimen.tail", text(shape.tail), text(2.0 * shape.radius) + " to 10 m");
  }
  if (!(shape.end_to_end > 0.0 && shape.end_to_end <= 100.0)) {
    throw InvalidInput("specimen.end_to_end", text(shape.end_to_end), "above 0, up to 100 m");
  }
}

}  // namespace

double Centreline::edge_length() const { return (points.col(1) - points.col(0)).norm(); }

double Centreline::length() const { return static_cast<double>(points.cols() - 1) * edge_length(); }

Points resample_evenly(const Points& points, double edge_length, std::vector<double>* position) {
  const ChordWalk walk(points);
  const double count = std::max(1.0, std::round(walk.length() / edge_length));
  // Chords are shorter than their arcs: the number that fits falls with their length, and is bisected for.
  double low = 0.5 * (points.rightCols(1) - points.leftCols(1)).norm() / count;
  double high = walk.length() / count * (1.0 + 1e-9);
  const auto ignore = [](const Vec3&, double) {};
  for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (walk.walk(middle, ignore) > count ? low : high) = middle;
  }
  const auto edges = static_cast<Eigen::Index>(count);
  Points nodes(3, edges + 1);
  std::vector<double> along(static_cast<std::size_t>(edges) + 1, walk.length());
  nodes.col(0) = points.col(0);
  along[0] = 0.0;
  Eigen::Index next = 1;
  walk.walk(high, [&](const Vec3& node, double s) {
    if (next >= edges) return;
    nodes.col(next) = node;
    along[static_cast<std::size_t>(next)] = s;
    ++next;
  });
  nodes.col(edges) = points.rightCols(1);
  if (position) *position = std::move(along);
  return nodes;
}

double smallest_distance(const Points& points, double exclusion, bool closed) {
  const Eigen::Index edges = points.cols() - 1;
  const Points edge = points.rightCols(edges) - points.leftCols(edges);
  const Points middle = 0.5 * (points.rightCols(edges) + points.leftCols(edges));
  const Eigen::VectorXd length = edge.colwise().norm();
  Eigen::VectorXd begin(edges + 1);
  begin[0] = 0.0;
  for (Eigen::Index i = 0; i < edges; ++i) begin[i + 1] = begin[i] + length[i];
  const double total = begin[edges];
  double best = kInfinity;
  for (Eigen::Index i = 0; i < edges; ++i) {
    for (Eigen::Index j = i + 1; j < edges; ++j) {
      if (begin[j] - begin[i + 1] < exclusion) continue;
      if (closed && total - begin[j + 1] + begin[i] < exclusion) continue;
      const double reach = best + 0.5 * (length[i] + length[j]);
      if ((middle.col(i) - middle.col(j)).squaredNorm() >= reach * reach) continue;
      best = std::min(best, std::sqrt(segment_distance2(points.col(i), edge.col(i), points.col(j), edge.col(j))));
    }
  }
  return best;
}

void check_no_overlap(const Centreline& centreline, double radius, const char* key, const std::string& value) {
  const double distance = smallest_distance(centreline.points, 1.5 * M_PI * radius, centreline.closed);
  if (distance < 2.0 * radius) {
    throw InvalidInput(
        key, value,
        "a shape whose strands keep a diameter apart (" + text(2.0 * radius) + " m); here " + text(distance) + " m");
  }
}

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
  const double rho = before_smoothing(rolled, h);

  // The knots clear each other; their strands reach the rollers; their coils clear the rollers.
  const double c = 0.5 * shape.knot_distance;
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
                       text(2.0 * c_min) + " to " + text(2.0 * c_max) + " m for this rod and these rollers");
  }

  // Standing parts lie at +-u from the axis. Opposite-handed tails lie on either side of the loop's plane, so u lies in
  // the plane; the axis is then set off so that the inner strand runs straight to its roller.
  const bool same = shape.handedness == Handedness::kSame;
  const Vec3 u = same ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 v = same ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 origin(same ? rho : rho + coil.strand, 0.0, middle);
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
  path.add(Vec3(rho, upper_y, shape.end_to_end));
  const double upper_begin = path.length();
  path.add_curve(M_PI * rho, [&](double t) {
    return Vec3(rho * std::cos(M_PI * t), upper_y * (1.0 - ease(t)), shape.end_to_end + rho * std::sin(M_PI * t));
  });
  const double upper_apex = 0.5 * (upper_begin + path.length());
  path.add(Vec3(-rho, 0.0, 0.0));
  const double lower_begin = path.length();
  path.add_curve(M_PI * rho, [&](double t) {
    return Vec3(-rho * std::cos(M_PI * t), lower_y * ease(t), -rho * std::sin(M_PI * t));
  });
  const double lower_apex = 0.5 * (lower_begin + path.length());
  path.add(lower.at(coil.strand, M_PI, c + past));
  path.add(lower.at(coil.strand, M_PI, 0.0));
  const double second_middle = path.length();
  draw_knot(upper, coil, c, h, shape.tail, path);

  const Resampled rod(path, smoothed(path, h, spacing), shape.edge_length);
  Centreline centreline;
  centreline.points = rod.points;
  centreline.closed_by_tails = true;
  centreline.upper_apex = rod(upper_apex);
  centreline.lower_apex = rod(lower_apex);
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

namespace {

/// Length of the braid: the loose knot's own, but never so short that its strands would overlap.
double braid_length(double radius, int turns, double loop_radius) {
  const double full_turns = 0.5 * (2 * turns + 1);
  const double turn = 2.0 * M_PI * std::pow(12.0, 0.25) * std::sqrt(radius * loop_radius);
  return full_turns * std::max(turn, 4.0 * M_PI * radius);
}

/// The overhand with a loop of the given radius, before smoothing; straight tails reach the ends.
Path draw_overhand(const OverhandShape& shape, double loop_radius, double spacing) {
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

}  // namespace

Centreline overhand(const OverhandShape& shape) {
  check_radius(shape.radius);
  check_edge_length(shape.edge_length, shape.radius);
  if (shape.turns < 1 || shape.turns > 4) throw InvalidInput("specimen.turns", std::to_string(shape.turns), "1 to 4");
  if (!(shape.length > 0.0 && shape.length <= 100.0)) {
    throw InvalidInput("specimen.length", text(shape.length), "above 0, up to 100 m");
  }
  if (!(shape.end_to_end > 0.0 && shape.end_to_end < shape.length)) {
    throw InvalidInput("specimen.end_to_end", text(shape.end_to_end), "above 0, below specimen.length");
  }
  const double h = shape.radius;
  const double spacing = drawing_spacing(h, shape.edge_length);
  const auto rod_length = [&](double loop_radius) {
    const Path path = draw_overhand(shape, loop_radius, spacing);
    const Points smooth = smoothed(path, h, spacing);
    return (smooth.rightCols(smooth.cols() - 1) - smooth.leftCols(smooth.cols() - 1)).colwise().norm().sum();
  };
  // The smallest loop, and the largest that leaves straight tails of 4 h at both ends.
  const double smallest = 2.5 * h;
  const auto room = [&](double loop_radius) {
    return shape.end_to_end - braid_length(h, shape.turns, loop_radius) - 8.0 * h;
  };
  const double shortest = rod_length(smallest) - shape.end_to_end;
  double high = smallest;
  for (double step = shape.length; step > 1e-3 * h; step *= 0.5) {
    if (room(high + step) > 0.0) high += step;
  }
  const double longest = rod_length(high) - shape.end_to_end;
  if (!(room(smallest) > 0.0) || !(shape.length - shape.end_to_end >= shortest) ||
      shape.length - shape.end_to_end > longest) {
    throw InvalidInput("specimen.end_to_end", text(shape.end_to_end),
                       "such that specimen.length exceeds it by " + text(shortest) + " to " + text(longest) +
                           " m, and at least " + text(braid_length(h, shape.turns, smallest) + 8.0 * h) + " m");
  }
  // The rod's length grows smoothly with the loop's radius: false position with a bracket (Illinois).
  double low = smallest;
  double below = shortest + shape.end_to_end - shape.length;
  double above = longest + shape.end_to_end - shape.length;
  double loop_radius = high;
  for (int i = 0; i < 60 && above > below; ++i) {
    loop_radius = (low * above - high * below) / (above - below);
    const double excess = rod_length(loop_radius) - shape.length;
    if (std::abs(excess) < 1e-3 * spacing) break;
    if (excess > 0.0) {
      high = loop_radius;
      above = excess;
      below *= 0.5;
    } else {
      low = loop_radius;
      below = excess;
      above *= 0.5;
    }
  }
  const Path path = draw_overhand(shape, loop_radius, spacing);
  Centreline centreline;
  centreline.points = Resampled(path, smoothed(path, h, spacing), shape.edge_length).points;
  check_no_overlap(centreline, h, "specimen.end_to_end", text(shape.end_to_end));
  return centreline;
}

Centreline straight(double length, double radius, double edge_length) {
  check_radius(radius);
  check_edge_length(edge_length, radius);
  if (!(length >= 4.0 * edge_length && length <= 100.0)) {
    throw InvalidInput("specimen.length", text(length), text(4.0 * edge_length) + " to 100 m (at least four edges)");
  }
  const auto edges = static_cast<Eigen::Index>(std::round(length / edge_length));
  Centreline centreline;
  centreline.points = Points::Zero(3, edges + 1);
  centreline.points.row(2).setLinSpaced(0.0, length);
  return centreline;
}

Centreline from_points(const Points& points, bool closed, double radius, double edge_length) {
  check_radius(radius);
  check_edge_length(edge_length, radius);
  if (!points.allFinite()) throw InvalidInput("specimen.file", "a point that is not finite", "finite numbers [m]");
  if (points.cols() < (closed ? 3 : 2)) {
    throw InvalidInput("specimen.file", std::to_string(points.cols()) + " points",
                       closed ? "three or more" : "two or more");
  }
  const bool add_first = closed && points.leftCols(1) != points.rightCols(1);
  Points way(3, points.cols() + (add_first ? 1 : 0));
  way.leftCols(points.cols()) = points;
  if (add_first) way.rightCols(1) = points.leftCols(1);
  for (Eigen::Index i = 1; i < way.cols(); ++i) {
    if (way.col(i) == way.col(i - 1)) {
      throw InvalidInput("specimen.file", "points " + std::to_string(i) + " and " + std::to_string(i + 1) + " coincide",
                         "points that differ from their neighbours");
    }
  }
  const double length = ChordWalk(way).length();
  if (!(length >= 4.0 * edge_length)) {
    throw InvalidInput("specimen.file", "a line of " + text(length) + " m",
                       "at least four edges (" + text(4.0 * edge_length) + " m)");
  }
  Centreline centreline;
  centreline.closed = closed;
  centreline.points = resample_evenly(way, edge_length);
  check_no_overlap(centreline, radius, "specimen.file", "the centreline");
  return centreline;
}

}  // namespace knot_utm
