#include <algorithm>

#include "knot_utm/contact/closest_points.hpp"
#include "knot_utm/contact/tunnelling.hpp"

namespace knot_utm {
namespace {

// Fractions of the extent of a pair.
constexpr double kMeeting = 1e-6;        // nearer than this is a meeting; closest points are good to 1e-8
constexpr double kFootRounding = 1e-12;  // more than what rounding does to n.g

/// g_00 and the edges; g_10 = p + a, g_01 = p - b, g_11 = p + a - b.
struct Gaps {
  Vec3 p, a, b;

  explicit Gaps(const EdgePair& edges) : p(edges.a0 - edges.b0), a(edges.a1 - edges.a0), b(edges.b1 - edges.b0) {}
  Gaps(const Gaps& start, const Gaps& end, double tau)
      : p(start.p + tau * (end.p - start.p)),
        a(start.a + tau * (end.a - start.a)),
        b(start.b + tau * (end.b - start.b)) {}

  double extent() const { return p.norm() + a.norm() + b.norm(); }
};

/// Smallest of p + {0, a} - {0, b}, of numbers.
double least(double p, double a, double b) { return p + std::min(a, 0.0) - std::max(b, 0.0); }

/// The pair at one time.
struct Instant {
  double tau;
  Gaps gaps;
  ClosestPoints at;
  Vec3 n;    // of the shortest gap, unit
  double d;  // its length [m]

  Instant(double tau_, const Gaps& gaps_, double regularisation)
      : tau(tau_), gaps(gaps_), at(closest_points(gaps.p, gaps.a, Vec3::Zero(), gaps.b, regularisation)) {
    n = gaps.p + at.t * gaps.a - at.u * gaps.b;
    d = n.norm();
    n /= d;
  }
  EdgeMeeting meeting() const { return {at.t, at.u}; }
};

class Search {
 public:
  Search(const EdgePair& start, const EdgePair& end) : start_(start), end_(end) {
    const double extent = start_.extent() + end_.extent();
    meeting_ = kMeeting * extent;
    rounding_ = kFootRounding * extent;
    // An edge of no length has a nearest point as well.
    regularisation_ = rounding_ * rounding_;
    const Vec3 p = end_.p - start_.p, a = end_.a - start_.a, b = end_.b - start_.b;
    shortest_ = 0.25 * meeting_ / (p.norm() + a.norm() + b.norm());
  }

  std::optional<EdgeMeeting> run() const {
    const Instant start(0.0, start_, regularisation_), end(1.0, end_, regularisation_);
    for (const Instant* now : {&start, &end})
      if (!(now->d > meeting_)) return now->meeting();
    return within(start, end);
  }

 private:
  /// Both ends of the time are apart. A time too short to move by what they are apart is separated by the plane of
  /// either end, so the halving ends.
  std::optional<EdgeMeeting> within(const Instant& from, const Instant& to) const {
    if (apart(from, to)) return std::nullopt;
    const Instant between(0.5 * (from.tau + to.tau), Gaps(start_, end_, 0.5 * (from.tau + to.tau)), regularisation_);
    if (!(between.d > meeting_) || to.tau - from.tau < shortest_) return between.meeting();
    const std::optional<EdgeMeeting> sooner = within(from, between);
    return sooner ? sooner : within(between, to);
  }

  bool apart(const Instant& from, const Instant& to) const {
    const Gaps &g = from.gaps, &h = to.gaps;
    auto along = [](const Vec3& n, const Gaps& gaps) { return least(n.dot(gaps.p), n.dot(gaps.a), n.dot(gaps.b)); };
    const double crosswise =
        least(from.n.dot(h.p) + to.n.dot(g.p), from.n.dot(h.a) + to.n.dot(g.a), from.n.dot(h.b) + to.n.dot(g.b));
    return along(from.n, g) > rounding_ && crosswise > rounding_ && along(to.n, h) > rounding_;
  }

  Gaps start_, end_;
  double meeting_, rounding_, regularisation_;
  double shortest_;  // time in which the gaps change by a part of `meeting_` only
};

}  // namespace

std::optional<EdgeMeeting> meeting(const EdgePair& start, const EdgePair& end) { return Search(start, end).run(); }

}  // namespace knot_utm
