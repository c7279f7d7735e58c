#include <cmath>
#include <string>

#include "knot_utm/rod/rod.hpp"
#include "reference.hpp"
#include "sim/twisted_rod.hpp"

namespace knot_utm {
namespace {

constexpr double kLength = 30.0;
constexpr int kEdges = 400;
constexpr double kTwistingStiffness = 1.0;

/// A long rod under tension T and moment M = m sqrt(B T), m < 2, buckled into a helix whose amplitude dies away on both
/// sides. With theta between tangent and axis and s from the middle,
///
///     sin^2(theta/2) = (1 - m^2/4) sech^2(sqrt(1 - m^2/4) s sqrt(T/B)).
///
/// Ends that are held in place and turn bear the helix down to m^2 = 2 - 4 sqrt(1 - m^2/4)/(L sqrt(T/B)), which is m
/// = 1.38 here: below, it springs into a loop. So near to that the length of the edges decides what happens at m = 1.4.
///
/// The ends are brought to the shortening and the turn of T = 1 and m, along a way on which the rod is a bow under
/// compression at first; T and M are what the clamps then feel.
struct LocalisedHelix {
  TwistedRod rod{0.01, kTwistingStiffness, kEdges, kLength / kEdges};
  double tension = 0.0, moment = 0.0;

  explicit LocalisedHelix(double m) {
    rod.settings.drag = 1.0;
    rod.settings.residual = 1e-8;
    rod.settings.newton_cap = 0.1;
    rod.settings.motion_limit = 0.5;
    rod.settings.overlap_limit = kLength;  // nothing touches
    rod.settings.candidate_margin = 0.01;
    rod.begin(0.02, 2.0);
    const double shortening = 4.0 * std::sqrt(1.0 - 0.25 * m * m);
    const double turn = m * kLength / kTwistingStiffness + 4.0 * std::acos(0.5 * m);
    rod.move_to(0.1, 0.2 * turn, 20.0, 0.5, 0.05);
    rod.move_to(shortening, turn, 500.0, 2.0, 0.05);
    rod.move_to(shortening, turn, 800.0, 20.0, 0.05);
    tension = rod.tension();
    moment = rod.moment();
  }

  double m() const { return moment / std::sqrt(tension); }
  double share() const { return 1.0 - 0.25 * m() * m(); }  // 1 - m^2/4

  /// sin^2(theta/2) of every edge.
  Eigen::VectorXd measured() const {
    const Points& x = rod.step->state().position;
    Eigen::VectorXd out(kEdges);
    for (int j = 0; j < kEdges; ++j) out[j] = 0.5 * (1.0 - (x.col(j + 1) - x.col(j)).normalized().x());
    return out;
  }

  /// Largest difference from the closed form, over its peak.
  double difference_of_shape() const {
    const Eigen::VectorXd found = measured();
    const Eigen::VectorXd s = (kLength / kEdges) * Eigen::VectorXd::LinSpaced(kEdges, 0.5, kEdges - 0.5);
    const double middle = found.dot(s) / found.sum();
    double largest = 0.0;
    for (int j = 0; j < kEdges; ++j) {
      const double sech = 1.0 / std::cosh(std::sqrt(share() * tension) * (s[j] - middle));
      largest = std::max(largest, std::abs(found[j] - share() * sech * sech));
    }
    return largest / share();
  }
};

class R6_LocalisedHelix : public testing::TestWithParam<double> {};

TEST_P(R6_LocalisedHelix, ShapeAndEndShorteningUnderTensionAndMoment) {
  const LocalisedHelix helix(GetParam());
  EXPECT_LT(helix.rod.fastest(), 1e-4) << "it should be at rest";
  EXPECT_NEAR(helix.tension, 1.0, 0.05);
  EXPECT_NEAR(helix.m(), GetParam(), 0.05);
  const std::string what = formatted("R6 localised helix, m = %.1f", GetParam());
  hold_against(what + ": end shortening sqrt(T/B)", 4.0 * std::sqrt(helix.share()),
               helix.rod.shortening * std::sqrt(helix.tension), 0.01);
  hold_against(what + ": largest sin^2(theta/2)", helix.share(), helix.measured().maxCoeff(), 0.01);
  hold_below(what + ": shape, largest difference over the peak", 0.01, helix.difference_of_shape());
  hold_against(what + ": turn of the ends",
               helix.moment * kLength / kTwistingStiffness + 4.0 * std::acos(0.5 * helix.m()), helix.rod.turn, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Moments, R6_LocalisedHelix, testing::Values(1.5, 1.6, 1.8),
                         [](const auto& m) { return "m" + std::to_string(std::lround(10.0 * m.param)); });

}  // namespace
}  // namespace knot_utm
