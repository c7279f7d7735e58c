#include "knot_utm/topology/overhand_strand.hpp"

#include <algorithm>

namespace knot_utm {
namespace {

// A turn counts once the strand has come back from it by so much; a coil is longer than that however tight [h].
constexpr double kTurn = 1.5;

}  // namespace

OverhandStrand OverhandStrand::follow(const Points& points, std::size_t k, Eigen::Index standing, const Vec3& axis,
                                      double radius, int windings, int passed_over) {
  const Eigen::Index step = k == 0 ? -1 : 1;
  const double turn = kTurn * radius;
  const auto height = [&](Eigen::Index i) { return static_cast<double>(step) * points.col(i).dot(axis); };
  OverhandStrand strand;
  strand.begin = strand.top = standing;
  strand.cut = strand.end = k == 0 ? 0 : points.cols() - 1;
  double lowest = height(standing), highest = lowest, bottom = lowest, leaving = 0.0;
  const int rises = std::max(own_rises(windings), passed_over);  // of the coil
  int aslant = rises;                                            // that may still come
  enum { kRising, kFalling, kLeaving } part = kRising;
  for (Eigen::Index i = standing; i != strand.end + step; i += step) {
    const double z = height(i);
    if (part == kRising) {
      const bool rose = highest > lowest + turn;
      if (z > highest) {
        highest = z;
        strand.top = i;
      } else if (z < highest - turn && rose) {
        part = kFalling;
        bottom = z;
      } else if (z < lowest && !rose) {
        lowest = highest = z;
        strand.begin = strand.top = i;
      }
    } else if (part == kFalling) {
      bottom = std::min(bottom, z);
      if (z > bottom + turn) {
        part = kLeaving;
        leaving = z;
        strand.cut = i;
      }
    } else {
      if (z > leaving) {
        leaving = z;
        strand.cut = i;
      }
      if (z > highest + radius && passed_over <= 0) break;
      if (z < leaving - turn) {
        if (aslant-- == 0) break;
        if (passed_over-- > 0) highest = std::max(highest, leaving);
        part = kFalling;
        bottom = z;
      }
    }
  }
  strand.coil_found = part == kLeaving || aslant < rises;
  strand.level = std::max(highest + radius, height(strand.cut));
  return strand;
}

}  // namespace knot_utm
