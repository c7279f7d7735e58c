// Where along the rod contact begins and ends: strands touch from half a turn around their own radius on, and a strand
// that slips over the end of another one loses its force before it does. Lengths in radii of the rod.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/strands.hpp"
#include "knot_utm/contact/edge_contact.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kEdge = 0.2;
constexpr NormalLaw kNormal = {1.0, 0.01};
constexpr double kMargin = 0.5;

/// Two straight legs joined by half a turn, with their centrelines `apart`.
Points hairpin(double apart) {
  const double radius = 0.5 * apart, turn = kPi * radius;
  const int turning = static_cast<int>(std::round(turn / kEdge)), leg = 40;
  Points out(3, 2 * leg + turning + 1);
  for (int i = 0; i < out.cols(); ++i) {
    const int on_turn = std::clamp(i - leg, 0, turning), before = std::max(leg - i, 0),
              behind = std::max(i - leg - turning, 0);
    const double angle = kPi * on_turn / turning;
    out.col(i) = Vec3(-radius * std::cos(angle), radius * std::sin(angle) - kEdge * (before + behind), 0.0);
  }
  return out;
}

/// Arclengths between the places that press on each other, ascending.
template <typename Contact>
std::vector<double> pressing_loops(const Points& x) {
  Material material;
  material.radius = 1.0;
  const Eigen::Index edges = x.cols() - 1;
  Contact contact(make_rod(material, (x.rightCols(edges) - x.leftCols(edges)).colwise().norm()), kNormal, Friction(),
                  kMargin);
  contact.begin(x);
  contact.evaluate(x, x, 1.0);
  std::vector<double> out;
  for (const ContactPoint& point : contact.contacts())
    if (point.force.norm() > 0.0) out.push_back(std::abs(point.arclength_b - point.arclength_a));
  std::sort(out.begin(), out.end());
  return out;
}

/// The nearest places that press lie on the legs' first edges.
template <typename Contact>
void expect_from_half_a_turn_on() {
  EXPECT_TRUE(pressing_loops<Contact>(hairpin(2.05)).empty());
  const std::vector<double> loops = pressing_loops<Contact>(hairpin(1.98));
  ASSERT_FALSE(loops.empty());
  EXPECT_GE(loops.front(), kPi);
  EXPECT_LE(loops.front(), kPi + 2.0 * kEdge);
}

TEST(SmoothContact, BeginsHalfATurnAlongTheRod) { expect_from_half_a_turn_on<SmoothContact>(); }
TEST(EdgeContact, BeginsHalfATurnAlongTheRod) { expect_from_half_a_turn_on<EdgeContact>(); }

/// A strand along z that ends, and one along x that lies across it and slides towards its end and over it.
class SlidingOver {
 public:
  SlidingOver()
      : strands_(straight_strand(Vec3(-3.0, 1.99, 0.0), Vec3::UnitX(), std::vector(30, kEdge)),
                 straight_strand(Vec3(0.0, 0.0, -20.0), Vec3::UnitZ(), std::vector(100, kEdge))),
        contact_(strands_.rod, kNormal, Friction(), kMargin) {}

  /// Force of the points of the crossing strand on their feet, once it rests with so much of the other one's spline
  /// beyond it. That strand's own points press on their feet as before.
  double force_with_left(double left) {
    const double end = -0.5 * kEdge;  // of the spline: the middle of the last edge
    Points position = strands_.position;
    position.leftCols(strands_.second - 1).row(2).array() += end - left;
    for (int step = 0; step < 2; ++step) {  // the second one begins with what the first one leaves
      contact_.begin(position);
      contact_.evaluate(position, position, 1e3);
      contact_.commit(position);
    }
    double out = 0.0;
    for (const ContactPoint& point : contact_.contacts())
      if (point.b0 >= strands_.second - 1) out += point.force.y();
    return out;
  }

 private:
  TwoStrandsOfARod strands_;
  SmoothContact contact_;
};

TEST(SmoothContact, LosesItsForceBeforeAStrandSlipsOverAnEnd) {
  SlidingOver over;
  const double whole = over.force_with_left(2.0);
  ASSERT_GT(whole, 0.0);
  double before = whole;
  for (const double left : {0.1, 0.05, 0.02, 1e-3, 1e-6}) {
    const double now = over.force_with_left(left);
    EXPECT_LT(now, before) << left;
    before = now;
  }
  EXPECT_LT(before, 1e-5 * whole);
  EXPECT_EQ(over.force_with_left(-1e-6), 0.0);
}

}  // namespace
}  // namespace knot_utm
