#include "knot_utm/topology/knot_invariants.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "knot_utm/topology/modular.hpp"

namespace knot_utm {
namespace {

/// A rotation whose third row is the viewing direction; the nth of a fixed, generic set.
Mat3 generic_view(int n) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  const double height = 1.0 - 2.0 * std::fmod(0.3137 + golden * n, 1.0);
  const double azimuth = 0.7391 + 2.0 * M_PI * std::fmod(golden * golden * n + 0.117 * n, 1.0);
  const double ring = std::sqrt(1.0 - height * height);
  const Vec3 view(ring * std::cos(azimuth), ring * std::sin(azimuth), height);
  const Vec3 side = view.unitOrthogonal();
  Mat3 rotation;
  rotation.row(0) = side;
  rotation.row(1) = view.cross(side);
  rotation.row(2) = view;
  return rotation;
}

/// The Wirtinger relation of a crossing at t as a row of the matrix, without the last column.
modular::Row relation(const Crossing& crossing, std::size_t k, std::size_t over_arc, std::size_t n, std::uint64_t t) {
  const std::size_t in = crossing.positive ? k : k + 1, out = crossing.positive ? k + 1 : k;
  modular::Row terms = {{over_arc, modular::subtract(1, t)}, {in, t}, {out, modular::subtract(0, 1)}};
  std::sort(terms.begin(), terms.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
  modular::Row row;
  for (const modular::Entry& term : terms) {
    if (term.column + 1 == n) continue;
    if (!row.empty() && row.back().column == term.column)
      row.back().value = modular::add(row.back().value, term.value);
    else
      row.push_back(term);
  }
  row.erase(std::remove_if(row.begin(), row.end(), [](const modular::Entry& entry) { return entry.value == 0; }),
            row.end());
  return row;
}

/// Empty where the crossings are not those of a knot.
KnotPolynomial polynomial_of(std::vector<Crossing> crossings) {
  if (crossings.size() < 3) return {1};
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.under != b.under ? a.under < b.under : a.under_fraction < b.under_fraction;
  });
  const std::size_t n = crossings.size();
  // Arc k runs from under-crossing k - 1 to under-crossing k; the over-strand of a crossing is the arc it lies on.
  std::vector<std::size_t> over_arc(n);
  for (std::size_t k = 0; k < n; ++k) {
    const auto next = std::lower_bound(
        crossings.begin(), crossings.end(), crossings[k], [](const Crossing& under, const Crossing& place) {
          return under.under != place.over ? under.under < place.over : under.under_fraction < place.over_fraction;
        });
    over_arc[k] = static_cast<std::size_t>(next - crossings.begin()) % n;
  }
  std::vector<std::uint64_t> values;
  for (std::uint64_t t = 1; t <= n; ++t) {
    std::vector<modular::Row> rows;
    for (std::size_t k = 0; k + 1 < n; ++k) rows.push_back(relation(crossings[k], k, over_arc[k], n, t));
    values.push_back(modular::determinant(std::move(rows)));
  }
  KnotPolynomial coefficients;
  std::int64_t sum = 0;
  for (const std::uint64_t value : modular::interpolate(values)) {
    coefficients.push_back(value > modular::kPrime / 2 ? -static_cast<std::int64_t>(modular::kPrime - value)
                                                       : static_cast<std::int64_t>(value));
    sum += coefficients.back();
  }
  if (sum != 1 && sum != -1) return {};
  while (coefficients.back() == 0) coefficients.pop_back();
  while (coefficients.front() == 0) coefficients.erase(coefficients.begin());
  for (std::int64_t& coefficient : coefficients) coefficient *= sum;
  return coefficients;
}

Points joined(const std::vector<Vec3>& points) {
  Points result(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = points[i];
  return result;
}

/// A distance far larger than the rod.
double far_away(const Points& points) {
  return 10.0 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

}  // namespace

KnotPolynomial alexander_polynomial(const Points& polygon) {
  constexpr int kViews = 6;
  constexpr int kMostViews = 12;
  std::vector<std::vector<Crossing>> views;
  for (int n = 0; n < kMostViews; ++n) {
    views.push_back(crossings_of(polygon, generic_view(n)));
    if (n + 1 < kViews && views.back().size() > 16) continue;
    // Begins with the projection that has the fewest crossings. One that gives no knot is degenerate.
    std::sort(views.begin(), views.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    for (std::vector<Crossing>& view : views) {
      KnotPolynomial polynomial = polynomial_of(std::move(view));
      if (!polynomial.empty()) return polynomial;
    }
    views.clear();
  }
  throw std::runtime_error("the rod runs through itself: no projection is that of a knot");
}

std::int64_t knot_determinant(const KnotPolynomial& polynomial) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < polynomial.size(); ++i) sum += i % 2 == 0 ? polynomial[i] : -polynomial[i];
  return std::abs(sum);
}

int linking_number(const Points& first, const Points& second) {
  int over = 0;  // the crossings where the first lies over the second already count the linking number
  for (const Crossing& crossing : crossings_between(first, second, generic_view(0)))
    if (crossing.first_over) over += crossing.positive ? 1 : -1;
  return over;
}

Points closed_far_away(const Points& open, const Vec3& axis) {
  const double distance = far_away(open);
  const Vec3 along = axis.normalized();
  const Vec3 aside = along.unitOrthogonal();
  Points closed(3, open.cols() + 4);
  closed.leftCols(open.cols()) = open;
  const Vec3 last = open.rightCols(1) + distance * along;
  const Vec3 first = open.leftCols(1) - distance * along;
  closed.col(open.cols()) = last;
  closed.col(open.cols() + 1) = last + distance * aside;
  closed.col(open.cols() + 2) = first + distance * aside;
  closed.col(open.cols() + 3) = first;
  return closed;
}

bool LoopTopology::Reading::same_knot(const Reading& other) const {
  return polynomial == other.polynomial && linking == other.linking && same_overhands(other);
}

bool LoopTopology::Reading::same_overhands(const Reading& other) const {
  return overhand_determinant == other.overhand_determinant && coil_found == other.coil_found;
}

namespace {

/// Directions and lengths by which the ends of a loop are joined.
struct LoopAxes {
  Vec3 axis;  ///< from the lower grip to the upper one
  Vec3 away;  ///< normal to it, from the loop's far side to the knots
  Vec3 side;
  double distance;      ///< larger than anything in the scene
  Eigen::Index middle;  ///< a node of the far side

  Vec3 outwards(std::size_t k) const { return k == 0 ? Vec3(-axis) : axis; }
};

LoopAxes axes_of(const Points& points, const std::array<OverhandStrand, 2>& strands, const Vec3& axis) {
  LoopAxes out;
  out.axis = axis;
  out.middle = points.cols() / 2;
  out.distance = far_away(points);
  const Vec3 knots = 0.5 * (points.col(strands[0].begin) + points.col(strands[1].begin));
  const Vec3 away = knots - points.col(out.middle);
  out.away = (away - away.dot(axis) * axis).normalized();
  out.side = axis.cross(out.away);
  return out;
}

/// The node at which the strand that knot k holds, the other knot's own, passes the level of the cut, or comes nearest
/// to it.
Eigen::Index threaded_at_cut(const Points& points, const std::array<OverhandStrand, 2>& strands, const LoopAxes& axes,
                             std::size_t k) {
  const Vec3 outwards = axes.outwards(k);
  const auto height = [&](Eigen::Index i) { return points.col(i).dot(outwards); };
  const double level = strands[k].level;
  const Eigen::Index back = k == 0 ? -1 : 1;
  // Once the knots have slid together, its standing part may begin beyond the level. The search then goes back to its
  // coil.
  Eigen::Index pass = strands[1 - k].begin;
  const Eigen::Index other_end = strands[1 - k].end;
  while (pass != other_end && std::min(height(pass), height(pass - back)) >= level) pass -= back;
  for (Eigen::Index j = pass; j != axes.middle; j += back) {
    if (height(j) > height(pass)) pass = j;
    if (height(pass) >= level) break;
  }
  return pass;
}

/// The closure of tail k from its cut to far away. `followed`: the angle theta at the reading before, which becomes
/// that at this one.
std::vector<Vec3> closure_of_tail(const Points& points, const std::array<OverhandStrand, 2>& strands,
                                  const LoopAxes& axes, std::size_t k, double& followed) {
  const OverhandStrand& strand = strands[k];
  const Vec3 outwards = axes.outwards(k);
  const Vec3 cut = points.col(strand.cut);
  const Vec3 offset = cut - points.col(threaded_at_cut(points, strands, axes, k));
  const double x = offset.dot(axes.away);
  const double y = offset.dot(axes.side);
  const double apart = std::hypot(x, y);
  followed += std::remainder(std::atan2(y, x) - followed, 2.0 * M_PI);

  std::vector<Vec3> closure;
  const Vec3 level_cut = cut + (strand.level - cut.dot(outwards)) * outwards;
  const Vec3 hub = level_cut - x * axes.away - y * axes.side;
  closure.push_back(level_cut);
  // A spiral that widens as it unwinds, so that several turns do not meet each other nor the way out.
  const int pieces = static_cast<int>(std::ceil(std::abs(followed) / (M_PI / 12.0)));
  for (int piece = pieces - 1; piece >= 0; --piece) {
    const double angle = followed * piece / pieces;
    const double wider = 1.0 + 0.02 * std::abs(followed - angle);
    closure.push_back(hub + wider * apart * (std::cos(angle) * axes.away + std::sin(angle) * axes.side));
  }
  closure.push_back(hub + axes.distance * axes.away);
  return closure;
}

/// The loop with both closures, from far away to far away.
Points whole_loop(const Points& points, const std::array<OverhandStrand, 2>& strands,
                  const std::array<std::vector<Vec3>, 2>& closures) {
  std::vector<Vec3> loop(closures[0].rbegin(), closures[0].rend());
  for (Eigen::Index i = strands[0].cut; i <= strands[1].cut; ++i) loop.emplace_back(points.col(i));
  loop.insert(loop.end(), closures[1].begin(), closures[1].end());
  return joined(loop);
}

/// One half of the loop, closed on its own. The halves part in the middle of the far side. From there each goes away
/// from the knots and around the end of the loop to the closure of its tail. Where they cross behind the far side, that
/// of the lower knot passes in front.
Points half_of_loop(const Points& points, const OverhandStrand& strand, const std::vector<Vec3>& closure,
                    const LoopAxes& axes, std::size_t k) {
  const double distance = axes.distance, sign = k == 0 ? -1.0 : 1.0;
  std::vector<Vec3> half;
  if (k == 0) {
    for (Eigen::Index i = axes.middle; i >= strand.cut; --i) half.emplace_back(points.col(i));
  } else {
    for (Eigen::Index i = axes.middle + 1; i <= strand.cut; ++i) half.emplace_back(points.col(i));
  }
  half.insert(half.end(), closure.begin(), closure.end());
  half.push_back(half.back() + distance * axes.outwards(k));
  half.push_back(half.back() - 2.0 * distance * axes.away + sign * 0.5 * distance * axes.side);
  half.push_back(half.front() - distance * axes.away + sign * 0.5 * distance * axes.side);
  half.push_back(half.front() - 0.5 * distance * axes.away);
  return joined(half);
}

std::int64_t determinant_of_overhand(const Points& points, const OverhandStrand& strand, const Vec3& axis) {
  const Eigen::Index from = std::min(strand.begin, strand.cut), to = std::max(strand.begin, strand.cut);
  return knot_determinant(alexander_polynomial(closed_far_away(points.middleCols(from, to - from + 1), axis)));
}

}  // namespace

LoopTopology::LoopTopology(Eigen::Index lower_standing, Eigen::Index upper_standing, double radius, int windings)
    : standing_{lower_standing, upper_standing}, radius_(radius), windings_(windings) {}

LoopTopology::Reading LoopTopology::read_as(const Reading& known, const Points& points, const Vec3& load_axis) {
  const std::array<double, 2> before = angle_;
  Reading found = read(points, load_axis);
  const PassedOver passed = passed_over(known, found, points, load_axis.normalized());
  if (passed != PassedOver{}) {
    angle_ = before;
    found = read(points, load_axis, passed);
  }
  if (found.same_knot(known) || !found.same_overhands(known)) return found;
  const std::array<double, 2> followed = angle_;
  for (const int most : {1, 2})
    for (int lower = -most; lower <= most; ++lower)
      for (int upper = -most; upper <= most; ++upper) {
        if (std::max(std::abs(lower), std::abs(upper)) < most) continue;  // tried before
        angle_ = {followed[0] + 2.0 * M_PI * lower, followed[1] + 2.0 * M_PI * upper};
        Reading turned = read(points, load_axis, passed);
        if (turned.same_knot(known)) return turned;
      }
  angle_ = followed;
  return found;
}

OverhandStrand LoopTopology::follow(const Points& points, const Vec3& axis, std::size_t k, int passed_over) const {
  return OverhandStrand::follow(points, k, standing_[k], axis, radius_, windings_, passed_over);
}

LoopTopology::PassedOver LoopTopology::passed_over(const Reading& known, const Reading& found, const Points& points,
                                                   const Vec3& axis) const {
  PassedOver out{};
  for (std::size_t k = 0; k < 2; ++k) {
    if (found.overhand_determinant[k] == known.overhand_determinant[k]) continue;
    for (int passed = 1; passed <= std::max(1, OverhandStrand::own_rises(windings_)) && out[k] == 0; ++passed) {
      const OverhandStrand strand = follow(points, axis, k, passed);
      if (determinant_of_overhand(points, strand, axis) == known.overhand_determinant[k]) out[k] = passed;
    }
  }
  return out;
}

LoopTopology::Reading LoopTopology::read(const Points& points, const Vec3& load_axis, const PassedOver& passed_over) {
  const Vec3 axis = load_axis.normalized();
  const std::array<OverhandStrand, 2> strands{follow(points, axis, 0, passed_over[0]),
                                              follow(points, axis, 1, passed_over[1])};
  const LoopAxes axes = axes_of(points, strands, axis);
  Reading reading;
  std::array<std::vector<Vec3>, 2> closures;
  for (std::size_t k = 0; k < 2; ++k) {
    closures[k] = closure_of_tail(points, strands, axes, k, angle_[k]);
    reading.coil_found[k] = strands[k].coil_found;
    reading.overhand_determinant[k] = determinant_of_overhand(points, strands[k], axis);
  }
  reading.polynomial = alexander_polynomial(whole_loop(points, strands, closures));
  reading.determinant = knot_determinant(reading.polynomial);
  reading.linking = linking_number(half_of_loop(points, strands[0], closures[0], axes, 0),
                                   half_of_loop(points, strands[1], closures[1], axes, 1));
  return reading;
}

}  // namespace knot_utm
