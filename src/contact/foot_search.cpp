#include "knot_utm/contact/foot_search.hpp"

#include <algorithm>

namespace knot_utm {
namespace {

constexpr std::size_t kAbreast = 4;

/// Four cubics c0 + c1 u + c2 u^2 + c3 u^3.
struct Cubics {
  Lanes c0, c1, c2, c3;
  Lanes value(const Lanes& u) const { return c0 + u * (c1 + u * (c2 + u * c3)); }
  Lanes slope(const Lanes& u) const { return c1 + u * (2.0 * c2 + u * 3.0 * c3); }

  /// One step of Halley's method.
  Lanes halley_step(const Lanes& u) const {
    const Lanes here = value(u), steepness = slope(u);
    return -1.0 * here * steepness / (steepness * steepness - here * (c2 + u * 3.0 * c3));
  }

  /// The roots in [low, high], where they rise from below zero to zero or above: Halley's method, kept inside. A step
  /// of less than the cube root of double precision is the last: the error after it is its cube. One that halves the
  /// bracket never is: a foot by a joint of two segments would turn the force as it changes over.
  Lanes rising_roots(Lanes low, Lanes high, LanesMask wanted) const {
    constexpr double kLastStep = 5e-6;
    const Lanes begin = value(low), end = value(high);
    Lanes u = low + (high - low) * begin / (begin - end);
    for (int i = 0; i < 40; ++i) {
      // Fewer than three are never enough.
      if (i > 2 && !any(wanted)) break;
      const Lanes here = value(u), steepness = slope(u);
      const LanesMask below = here < 0.0;
      low = select(below, u, low);
      high = select(below, high, u);
      const Lanes eased = steepness * steepness - here * (c2 + u * 3.0 * c3);  // F'^2 - F F''/2
      const Lanes next = u - here * steepness / eased;
      const LanesMask inside = (steepness > 0.0) & (eased > 0.0) & (next >= low) & (next <= high);
      const Lanes step = select(inside, next, 0.5 * (low + high)) - u;
      u = select(wanted, u + step, u);
      wanted &= ~(inside & (step < kLastStep) & (step > -kLastStep));
    }
    return u;
  }
};

/// Where F' rises through zero in [0, 1): one place as a rule; two, or one more between places where it falls, on a
/// segment that bends around the point. c3 >= 0, so F' rises, falls and rises at most.
struct RisingRoots {
  Lanes root[2];
  LanesMask found[2];  // the second root only where there is a first

  explicit RisingRoots(const Cubics& f) {
    constexpr Lanes kBegin = {0.0, 0.0, 0.0, 0.0}, kEnd = {1.0, 1.0, 1.0, 1.0};
    const Lanes discriminant = f.c2 * f.c2 - 3.0 * f.c1 * f.c3;
    const LanesMask turns = (discriminant > 0.0) & (f.c3 > 0.0);
    const Lanes half = square_root(larger(discriminant, kBegin)) / (3.0 * f.c3), middle = -f.c2 / (3.0 * f.c3);
    const Lanes falls = select(turns, smaller(middle - half, kEnd), kEnd);
    const Lanes rises = select(turns, larger(middle + half, kBegin), kEnd);
    const LanesMask before = (kBegin < falls) & (f.value(kBegin) < 0.0) & (f.value(falls) >= 0.0);
    const LanesMask after = (rises < kEnd) & (f.value(rises) < 0.0) & (f.value(kEnd) >= 0.0);
    found[0] = before | after;
    found[1] = before & after;
    root[0] = f.rising_roots(select(before, kBegin, rises), select(before, falls, kEnd), found[0]);
    if (any(found[1])) root[1] = f.rising_roots(rises, kEnd, found[1]);
  }
};

}  // namespace

/// Four pairs side by side; where there are fewer, the last one fills up.
struct FootSearch::Four {
  const SegmentParabola* segment[kAbreast];
  const Lanes* point[kAbreast];

  /// From the segments' first places to the points [m]
  FourVectors gap() const {
    return FourVectors::of(*point[0] - segment[0]->m, *point[1] - segment[1]->m, *point[2] - segment[2]->m,
                           *point[3] - segment[3]->m);
  }
  FourVectors vectors(Lanes SegmentParabola::*v) const {
    return FourVectors::of(segment[0]->*v, segment[1]->*v, segment[2]->*v, segment[3]->*v);
  }
  Lanes numbers(double SegmentParabola::*v) const {
    return Lanes{segment[0]->*v, segment[1]->*v, segment[2]->*v, segment[3]->*v};
  }
};

FootSearch::Four FootSearch::four(const Pair* pairs, std::size_t count) const {
  Four out;
  for (std::size_t l = 0; l < kAbreast; ++l) {
    const Pair& pair = pairs[std::min(l, count - 1)];
    out.segment[l] = &parabola_[static_cast<std::size_t>(pair.segment)];
    out.point[l] = &points_[static_cast<std::size_t>(pair.point)];
  }
  return out;
}

FootSearch::FootSearch(Eigen::Index nodes, double reach)
    : reach_(reach), sieve_(nodes), parabola_(static_cast<std::size_t>(nodes)) {}

void FootSearch::begin(const Points& position, const std::vector<int>& segments) {
  pairs_.clear();
  sieve_.set_centreline(position);
  begin_to_follow(position, segments);
}

void FootSearch::begin_to_follow(const Points& position, const std::vector<int>& segments) {
  points_.clear();
  for (const int i : segments) {
    const double* x = position.data() + 3 * (i - 1);
    parabola_[static_cast<std::size_t>(i)].set(to_lanes(x), to_lanes(x + 3), to_lanes(x + 6));
  }
}

void FootSearch::add(const Lanes& first, const Lanes& second) {
  points_.push_back(first);
  points_.push_back(second);
}

void FootSearch::look(const Lanes& first, const Lanes& second, const Candidates::Run* begin,
                      const Candidates::Run* end) {
  sieve_.sieve(first, second, begin, end);
  const int number = static_cast<int>(points_.size());
  add(first, second);
  for (int p = 0; p < 2; ++p)
    for (const int* segment = sieve_.begin(p); segment != sieve_.end(p); ++segment)
      pairs_.push_back({number + p, *segment});
}

void FootSearch::find() {
  leave_near_ones();
  feet_.clear();
  for (std::size_t i = 0; i < pairs_.size(); i += kAbreast)
    find_feet(&pairs_[i], std::min(pairs_.size() - i, kAbreast));
}

bool FootSearch::follow() {
  for (std::size_t i = 0; i < feet_.size(); i += kAbreast)
    if (!follow_feet(&feet_[i], std::min(feet_.size() - i, kAbreast))) return false;
  return true;
}

bool FootSearch::follow_feet(Foot* feet, std::size_t count) {
  Pair pairs[kAbreast];
  Lanes u = {};
  for (std::size_t l = 0; l < kAbreast; ++l) {
    const Foot& foot = feet[std::min(l, count - 1)];
    pairs[l] = {foot.point, foot.segment};
    u[static_cast<int>(l)] = foot.u;
  }
  const Four four = this->four(pairs, kAbreast);
  const FourVectors r = four.gap(), t = four.vectors(&SegmentParabola::t), k = four.vectors(&SegmentParabola::k);
  const Cubics slope({-dot(r, t), dot(t, t) - dot(r, k), 1.5 * dot(t, k), 0.5 * dot(k, k)});
  for (int i = 0; i < 2; ++i) u += slope.halley_step(u);
  if (any(~((slope.slope(u) > 0.0) & (u >= 0.0) & (u < 1.0)))) return false;
  const FourVectors gap = r - u * (t + (0.5 * u) * k);
  Lanes x[4] = {gap.x, gap.y, gap.z, square_root(dot(gap, gap))};
  transpose(x[0], x[1], x[2], x[3]);
  for (std::size_t l = 0; l < count; ++l) {
    feet[l].x = x[l];
    feet[l].u = u[static_cast<int>(l)];
  }
  return true;
}

void FootSearch::leave_near_ones() {
  std::size_t left = 0;
  const std::size_t count = pairs_.size();
  for (std::size_t i = 0; i < count; i += kAbreast) {
    const Four four = this->four(&pairs_[i], std::min(count - i, kAbreast));
    const FourVectors r = four.gap(), chord = four.vectors(&SegmentParabola::chord);
    // Further away from the chord than the segment and the reach together: all of it is beyond.
    const Lanes along = dot(r, chord), farthest = reach_ + four.numbers(&SegmentParabola::bulge);
    const LanesMask near = (dot(r, r) - farthest * farthest) * dot(chord, chord) < along * along;
    for (std::size_t l = 0; l < std::min(count - i, kAbreast); ++l) {
      // Hard to foretell: written down in any case, counted where it is near.
      pairs_[left] = pairs_[i + l];
      left += static_cast<std::size_t>(near[l] & 1);
    }
  }
  pairs_.resize(left);
}

void FootSearch::find_feet(const Pair* pairs, std::size_t count) {
  const Four four = this->four(pairs, count);
  const FourVectors r = four.gap(), t = four.vectors(&SegmentParabola::t), k = four.vectors(&SegmentParabola::k);
  const RisingRoots roots({-dot(r, t), dot(t, t) - dot(r, k), 1.5 * dot(t, k), 0.5 * dot(k, k)});
  const std::size_t most = any(roots.found[1]) ? 2 : 1;
  Lanes x[2][kAbreast];
  LanesMask within[2];
  for (std::size_t i = 0; i < most; ++i) {
    const Lanes& u = roots.root[i];
    const FourVectors gap = r - u * (t + (0.5 * u) * k);
    const Lanes d2 = dot(gap, gap);
    within[i] = roots.found[i] & (d2 < reach_ * reach_);
    x[i][0] = gap.x;
    x[i][1] = gap.y;
    x[i][2] = gap.z;
    x[i][3] = square_root(d2);
    transpose(x[i][0], x[i][1], x[i][2], x[i][3]);
  }
  for (std::size_t l = 0; l < count; ++l)
    for (std::size_t i = 0; i < most; ++i)
      if (within[i][l]) feet_.push_back({x[i][l], roots.root[i][l], pairs[l].point, pairs[l].segment});
}

}  // namespace knot_utm
