#include "knot_utm/contact/smooth_contact.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "knot_utm/contact/centreline_curve.hpp"

namespace knot_utm {

namespace {

constexpr double kUnknown = -1.0;     // share of a contact that recalls none yet
constexpr double kSharpest = 1.0;     // turn of the centreline at a node that is no longer resolved [rad]
constexpr double kReachMargin = 0.3;  // contacts are kept, forceless, up to this gap [fraction of radius]

/// Arclength at rest of parameter u on a segment: from the middle of one edge to the middle of the next.
double arclength_at(const Eigen::VectorXd& arclength, int segment, double u) {
  const double begin = 0.5 * (arclength[segment - 1] + arclength[segment]);
  const double end = 0.5 * (arclength[segment] + arclength[segment + 1]);
  return begin + u * (end - begin);
}

/// A cubic c0 + c1 u + c2 u^2 + c3 u^3.
struct Cubic {
  double c0, c1, c2, c3;
  double value(double u) const { return c0 + u * (c1 + u * (c2 + u * c3)); }
  double slope(double u) const { return c1 + u * (2.0 * c2 + u * 3.0 * c3); }

  /// The root in [low, high], where it rises from below zero to zero or above: Halley's method, kept inside. A step of
  /// less than the cube root of double precision is the last: the error after it is its cube. One that halves the
  /// bracket never is: a foot by a joint of two segments would turn the force as it changes over.
  double rising_root(double low, double high) const {
    constexpr double kLastStep = 5e-6;
    const double begin = value(low), end = value(high);
    double u = low + (high - low) * begin / (begin - end);
    for (int i = 0; i < 40; ++i) {
      const double here = value(u), steepness = slope(u);
      (here < 0.0 ? low : high) = u;
      const double eased = steepness * steepness - here * (c2 + u * 3.0 * c3);  // F'^2 - F F''/2
      double next = u - here * steepness / eased;
      const bool halves = !(steepness > 0.0 && eased > 0.0 && next >= low && next <= high);
      if (halves) next = 0.5 * (low + high);
      const double step = std::abs(next - u);
      u = next;
      if (!halves && step < kLastStep) break;
    }
    return u;
  }
};

/// Where F' rises through zero in [0, 1): one place as a rule; two, or one more between places where it falls, on a
/// segment that bends around the point. c3 >= 0, so F' rises, falls and rises at most.
struct RisingRoots {
  double root[2];
  int count = 0;

  explicit RisingRoots(const Cubic& f) {
    const double discriminant = f.c2 * f.c2 - 3.0 * f.c1 * f.c3;
    if (discriminant <= 0.0 || f.c3 <= 0.0) {
      search(f, 0.0, 1.0);
      return;
    }
    const double half = std::sqrt(discriminant) / (3.0 * f.c3), middle = -f.c2 / (3.0 * f.c3);
    search(f, 0.0, std::min(middle - half, 1.0));
    search(f, std::max(middle + half, 0.0), 1.0);
  }

 private:
  void search(const Cubic& f, double low, double high) {
    if (low < high && f.value(low) < 0.0 && f.value(high) >= 0.0) root[count++] = f.rising_root(low, high);
  }
};

/// Number of a point of integration along the rod.
std::size_t number(int segment, int point) {
  return 2 * static_cast<std::size_t>(segment) + static_cast<std::size_t>(point);
}

/// max(0, g) of x against the curve at parameter u of a segment: g = 1 - x.c''/|c'|^2 of the segment itself at its
/// middle, the smaller of the two that meet at its ends, linear between.
double least_curvature_share(const Points& nodes, int segment, double u, const Vec3& x, double length2) {
  const int last = static_cast<int>(nodes.cols()) - 2;
  const double own = 1.0 - x.dot(second_difference(nodes, segment)) / length2;
  const int other = u < 0.5 ? std::max(segment - 1, 1) : std::min(segment + 1, last);
  const double end = std::min(own, 1.0 - x.dot(second_difference(nodes, other)) / length2);
  const double towards_end = 2.0 * std::abs(u - 0.5);
  return std::max(0.0, own + towards_end * (end - own));
}

}  // namespace

/// A point of integration where it stands now.
struct SmoothContact::StrandPoint {
  int segment, point;
  PointWeights weights;
  Vec3 a;

  StrandPoint(int segment_, int point_, double outwards, const Points& position)
      : segment(segment_),
        point(point_),
        weights(kIntegrationPoints[point_], outwards),
        a(combine(weights.value, position, segment_)) {}
};

SmoothContact::SmoothContact(const RodProperties& rod, const NormalLaw& normal, const Friction& friction, double margin,
                             double catch_up)
    : normal_(normal),
      friction_(friction),
      diameter_(2.0 * rod.material.radius),
      window_(1.0 * rod.material.radius),
      reach_((2.0 + kReachMargin) * rod.material.radius),
      arclength_(rod.arclength()),
      voronoi_(rod.voronoi_length),
      // Strands closer than a half turn around themselves (pi h) bend, they do not touch.
      candidates_(rod, reach_, margin, 5.0 * rod.material.radius),
      sieve_(rod.nodes()),
      catch_up_time_(catch_up) {
  const Eigen::Index nodes = rod.nodes();
  accepted_.begin.assign(2 * static_cast<std::size_t>(nodes) + 1, 0);
  iterate_ = accepted_;
  edge_middle_.resize(3, nodes - 1);
  edge_.resize(3, nodes - 1);
  parabola_.resize(static_cast<std::size_t>(nodes));
  outwards_ = Eigen::VectorXd::Constant(nodes, PointWeights::kWholeShare);
}

void SmoothContact::begin_step() {
  iterate_ = accepted_;
  first_evaluation_ = true;
}

void SmoothContact::evaluate(const Points& position, const Points& start, double dt) {
  if (!first_evaluation_) remember(nullptr, iterate_);
  first_evaluation_ = false;
  contacts_.clear();
  recalled_.assign(iterate_.entries.size(), 0);
  friction_scale_ = friction_.scale(dt);
  catch_up_ = dt / (dt + catch_up_time_);
  if (candidates_.segments().empty()) return;
  const Eigen::Index edges = position.cols() - 1;
  edge_.noalias() = position.rightCols(edges) - position.leftCols(edges);
  edge_middle_.noalias() = 0.5 * (position.rightCols(edges) + position.leftCols(edges));
  sieve_.set_centreline(edge_middle_, edge_);
  for (const int i : candidates_.segments())
    parabola_[static_cast<std::size_t>(i)].set(edge_middle_.col(i - 1), edge_.col(i - 1), edge_.col(i));
  for (const int segment : candidates_.segments()) {
    const StrandPoint points[2] = {{segment, 0, outwards_[segment], position},
                                   {segment, 1, outwards_[segment], position}};
    sieve_.sieve(points[0].a, points[1].a, candidates_.begin(segment), candidates_.end(segment));
    for (const StrandPoint& point : points) {
      const std::size_t first = contacts_.size();
      find_feet(point);
      recall(number(segment, point.point), first);
      for (std::size_t c = first; c < contacts_.size(); ++c) complete(contacts_[c], position, start);
    }
  }
}

void SmoothContact::find_feet(const StrandPoint& point) {
  for (const int* foot = sieve_.begin(point.point); foot != sieve_.end(point.point); ++foot) {
    const SegmentParabola& c = parabola_[static_cast<std::size_t>(*foot)];
    const Vec3 r = point.a - c.m;
    const double rt = r.dot(c.t), rk = r.dot(c.k);
    // Further away from the chord than the segment and the reach together: all of it is beyond.
    const double farthest = reach_ + c.bulge, along = rt + 0.5 * rk;
    if ((r.squaredNorm() - farthest * farthest) * c.chord2 >= along * along) continue;
    // F'(u) = -(a - c).c' is a cubic.
    const RisingRoots feet({-rt, c.tt - rk, 1.5 * c.tk, 0.5 * c.kk});
    for (int i = 0; i < feet.count; ++i) add_contact(point, *foot, feet.root[i], r);
  }
}

void SmoothContact::add_contact(const StrandPoint& point, int foot, double u, const Vec3& r) {
  const SegmentParabola& c = parabola_[static_cast<std::size_t>(foot)];
  const Vec3 x = r - u * (c.t + 0.5 * u * c.k);
  const double d2 = x.squaredNorm();
  if (d2 >= reach_ * reach_) return;
  const double arclength_a = arclength_at(arclength_, point.segment, kIntegrationPoints[point.point]);
  const double arclength_b = arclength_at(arclength_, foot, u);
  if (std::abs(arclength_a - arclength_b) < candidates_.exclusion()) return;
  ContactPoint& contact = contacts_.emplace_back();
  contact.x = x;
  contact.d = std::sqrt(d2);
  contact.arclength_a = arclength_a;
  contact.arclength_b = arclength_b;
  contact.share = kUnknown;
  contact.a0 = point.segment - 1;
  contact.point = point.point;
  contact.b0 = foot - 1;
  const SegmentWeights wb(u);
  for (int k = 0; k < 3; ++k) {
    contact.c[k] = point.weights.value[k];
    contact.c[3 + k] = -wb.value[k];
    contact.beta[3 + k] = wb.derivative[k];
  }
  contact.n = contact.x / contact.d;
  contact.overlap = diameter_ - contact.d;
  contact.begins = normal_.begin();
  contact.db = c.t + u * c.k;
  const double length2 = contact.db.squaredNorm();
  // At a minimum G >= 0; it vanishes where the foot is about to jump, and there omega does too.
  contact.inverse_g = 1.0 / std::max(length2 - contact.x.dot(c.k), 1e-3 * length2);
}

void SmoothContact::recall(std::size_t q, std::size_t first) {
  const int begin = iterate_.begin[q], end = iterate_.begin[q + 1];
  // Nearest pairs first, each memory to one contact only: of two feet of a point one may be new.
  for (int pass = begin; pass < end; ++pass) {
    double nearest = window_;
    const Memory* memory = nullptr;
    ContactPoint* contact = nullptr;
    for (int m = begin; m < end; ++m) {
      const Memory& candidate = iterate_.entries[static_cast<std::size_t>(m)];
      if (recalled_[static_cast<std::size_t>(m)]) continue;
      for (std::size_t c = first; c < contacts_.size(); ++c) {
        const double away = std::abs(candidate.arclength_b - contacts_[c].arclength_b);
        if (contacts_[c].share >= 0.0 || away >= nearest) continue;
        nearest = away;
        memory = &candidate;
        contact = &contacts_[c];
      }
    }
    if (!contact) break;
    recalled_[static_cast<std::size_t>(memory - iterate_.entries.data())] = 1;
    contact->share = memory->share;
    contact->estimate = memory->pressure;
    contact->memory = memory->slip;
  }
}

void SmoothContact::complete(ContactPoint& contact, const Points& position, const Points& start) {
  if (contact.share < 0.0) contact.share = share(contact, position);
  contact.weight = 0.5 * voronoi_[contact.a0 + 1] * contact.share;
  if (!contact.active()) return;
  if (friction_.on()) {
    contact.slip = contact.memory;
    for (int k = 0; k < 3; ++k) {
      contact.slip += contact.c[k] * (position.col(contact.a0 + k) - start.col(contact.a0 + k));
      const Vec3 moved = position.col(contact.b0 + k) - start.col(contact.b0 + k);
      contact.slip += contact.c[3 + k] * moved;
      contact.turn += contact.beta[3 + k] * moved;
    }
  }
  evaluate_force(normal_, friction_, friction_scale_, contact);
}

ContactMotion SmoothContact::motion(const ContactPoint& contact, const Points& position, const Points& start) const {
  ContactMotion out;
  Vec3 turn = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    out.slip += contact.c[k] * (position.col(contact.a0 + k) - start.col(contact.a0 + k));
    const Vec3 moved = position.col(contact.b0 + k) - start.col(contact.b0 + k);
    out.slip += contact.c[3 + k] * moved;
    turn += contact.beta[3 + k] * moved;
  }
  // From today's foot, which was near the nearest place then.
  const Vec3 x = contact.x - out.slip;
  const double uphill = x.dot(contact.db - turn);
  const double d2 = x.squaredNorm() - uphill * uphill * contact.inverse_g;
  out.overlap_before = diameter_ - std::sqrt(std::max(d2, 0.0));
  return out;
}

double SmoothContact::share(const ContactPoint& contact, const Points& position) const {
  const int segment = contact.a0 + 1, foot = contact.b0 + 1;
  // Of the weights' derivatives the last is the parameter itself.
  const double ua = kIntegrationPoints[contact.point];
  const double ub = contact.beta[5];
  const Vec3 da = combine(SegmentWeights(ua).derivative, position, segment);
  const double g_b = least_curvature_share(position, foot, ub, contact.x, contact.db.squaredNorm());
  const double g_a = least_curvature_share(position, segment, ua, -contact.x, da.squaredNorm());
  const double a4 = g_a * g_a * g_a * g_a, b4 = g_b * g_b * g_b * g_b;
  // Where each strand stands in the other's centre of curvature neither side has a foot that means anything.
  constexpr double kBlind = 1e-4;
  return b4 / (a4 + b4 + kBlind);
}

void SmoothContact::remember(const Points* accepted, MemoryList& list) const {
  list.entries.clear();
  std::size_t done = 0;
  for (const ContactPoint& contact : contacts_) {
    const std::size_t q = number(contact.a0 + 1, contact.point);
    while (done <= q) list.begin[done++] = static_cast<int>(list.entries.size());
    if (accepted) {
      const bool sticks = friction_.on() && friction_.remembers() && contact.touches();
      const double now = contact.share + catch_up_ * (share(contact, *accepted) - contact.share);
      list.entries.push_back(
          {contact.arclength_b, now, contact.pressure, sticks ? Vec3(friction_.presliding * contact.z) : Vec3::Zero()});
    } else {
      list.entries.push_back({contact.arclength_b, contact.share, contact.estimate, contact.memory});
    }
  }
  while (done < list.begin.size()) list.begin[done++] = static_cast<int>(list.entries.size());
}

void SmoothContact::put_outwards(const Points& position) {
  for (int i = 1; i + 1 < static_cast<int>(position.cols()); ++i) {
    const double turn2 = second_difference(position, i).squaredNorm() / (voronoi_[i] * voronoi_[i]);
    const double left = std::max(0.0, 1.0 - turn2 / (kSharpest * kSharpest));
    outwards_[i] = PointWeights::kWholeShare * left * left;
  }
}

void SmoothContact::commit(const Points& position) {
  put_outwards(position);
  remember(&position, accepted_);
}

void SmoothContact::Memory::state(Archive& archive) { archive(arclength_b, share, pressure, slip); }

void SmoothContact::MemoryList::state(Archive& archive) {
  archive.list(entries);
  archive(begin);
  const bool rows = begin.front() == 0 && begin.back() == static_cast<int>(entries.size()) &&
                    std::is_sorted(begin.begin(), begin.end());
  archive.require(rows, "rows of contacts", std::to_string(entries.size()) + " entries");
}

void SmoothContact::state(Archive& archive) {
  archive.section("SMTH");
  archive(outwards_, candidates_, accepted_);
}

}  // namespace knot_utm
