// R1 to R3: an inextensible cantilever under its own weight or under a load at its tip.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "reference.hpp"
#include "rod/static_rod.hpp"

namespace knot_utm {
namespace {

/// Stiff enough for the strain to stay below 1e-6 at the largest load here.
constexpr double kNearlyInextensible = 1e7;

enum class Clamp { kMiddleOfEdge, kInnerNode };

/// A cantilever of unit length and stiffness along +x. Its first edge is held; the clamp, x = 0, is in its middle or
/// at its inner node.
struct Cantilever {
  Cantilever(Eigen::Index n, Clamp clamp, StaticRod::Path path)
      : edges(n),
        held_part(clamp == Clamp::kMiddleOfEdge ? 0.5 : 1.0),
        l(1.0 / (static_cast<double>(n) - held_part)),
        rod(unit_rod(n, l, kNearlyInextensible), straight_line(n, l, -held_part * l), path) {
    rod.hold_node(0);
    rod.hold_node(1);
    rod.hold(StaticRod::theta(0));
  }

  /// Raises the force at the tip from what it is.
  bool load_tip(double force) {
    double& load = rod.load()[StaticRod::x(edges, 2)];
    const double start = -load;
    const int steps = static_cast<int>(std::ceil((force - start) * 3.0));
    bool solved = true;
    for (int step = 1; step <= steps && solved; ++step) {
      load = -start - (force - start) * step / steps;
      solved = rod.solve();
    }
    return solved;
  }

  bool load_weight(double weight) {
    bool solved = true;
    constexpr int kSteps = 24;
    for (int step = 1; step <= kSteps && solved; ++step) {
      const double now = weight * std::pow(static_cast<double>(step) / kSteps, 3.0);
      for (Eigen::Index i = 2; i <= edges; ++i) {
        rod.load()[StaticRod::x(i, 2)] = -now * (i == edges ? 0.5 : 1.0) * l;
      }
      solved = rod.solve();
    }
    return solved;
  }

  double drop() const { return -rod.position()(2, edges); }
  double shortening() const { return 1.0 - rod.position()(0, edges); }

  Eigen::Index edges;
  double held_part;
  double l;
  StaticRod rod;
};

struct Elastica {
  double force, drop, shortening;
};
constexpr std::array<Elastica, 4> kElastica = {
    {{1.0, 0.301721, 0.056433}, {2.0, 0.493457, 0.160642}, {5.0, 0.713792, 0.387628}, {10.0, 0.810609, 0.554996}}};

/// Largest relative error of the drop and the shortening over the four loads.
double elastica_error(Eigen::Index n, Clamp clamp, StaticRod::Path path) {
  Cantilever cantilever(n, clamp, path);
  double worst = 0.0;
  for (const Elastica& expected : kElastica) {
    EXPECT_TRUE(cantilever.load_tip(expected.force)) << "n = " << n << ", force " << expected.force;
    worst = std::max({worst, std::abs(cantilever.drop() / expected.drop - 1.0),
                      std::abs(cantilever.shortening() / expected.shortening - 1.0)});
  }
  return worst;
}

double observed_order(double coarse, double fine) { return std::log2(coarse / fine); }

TEST(R1_Cantilever, TipLoadBendsItAsTheElastica) {
  for (const auto path : {StaticRod::Path::kTwistFree, StaticRod::Path::kFull}) {
    Cantilever cantilever(64, Clamp::kMiddleOfEdge, path);
    const std::string frames = path == StaticRod::Path::kFull ? ", with frames" : ", without frames";
    for (const Elastica& expected : kElastica) {
      ASSERT_TRUE(cantilever.load_tip(expected.force)) << "force " << expected.force;
      const std::string what = formatted("R1 cantilever, P L^2/B = %g", expected.force) + frames;
      hold_against(what + ": drop/L", expected.drop, cantilever.drop(), 1e-3);
      hold_against(what + ": shortening/L", expected.shortening, cantilever.shortening(), 1e-3);
    }
  }
}

TEST(R2_HeavyCantilever, DropOverProjection) {
  const std::vector<std::array<double, 2>> expected = {{0.1, 0.012500},  {1.0, 0.124562}, {5.0, 0.585721},
                                                       {10.0, 1.066802}, {50.0, 3.70556}, {100.0, 5.88811},
                                                       {1000.0, 21.3354}};
  for (const auto& [weight, ratio] : expected) {
    // The bend next to the clamp has the length weight^(-1/3) and must be resolved.
    const Eigen::Index n = weight > 100.0 ? 160 : 80;
    Cantilever cantilever(n, Clamp::kMiddleOfEdge, StaticRod::Path::kTwistFree);
    ASSERT_TRUE(cantilever.load_weight(weight)) << "weight " << weight;
    const double found = cantilever.drop() / (1.0 - cantilever.shortening());
    hold_against(formatted("R2 heavy cantilever, w L^3/B = %g: drop over projection", weight), ratio, found, 0.01);
  }
}

TEST(R3_Clamp, InTheMiddleOfItsEdgeIsSecondOrder) {
  const double coarse = elastica_error(16, Clamp::kMiddleOfEdge, StaticRod::Path::kTwistFree);
  const double middle = elastica_error(32, Clamp::kMiddleOfEdge, StaticRod::Path::kTwistFree);
  const double fine = elastica_error(64, Clamp::kMiddleOfEdge, StaticRod::Path::kTwistFree);
  EXPECT_GT(observed_order(coarse, middle), 1.8);
  hold_against("R3 clamp in the middle of its edge: order", 2.0, observed_order(middle, fine), 0.1);
}

TEST(R3_Clamp, AtTheInnerNodeIsFirstOrderOnly) {
  const double coarse = elastica_error(32, Clamp::kInnerNode, StaticRod::Path::kTwistFree);
  const double fine = elastica_error(64, Clamp::kInnerNode, StaticRod::Path::kTwistFree);
  hold_against("R3 clamp at the inner node: order", 1.0, observed_order(coarse, fine), 0.15);
}

}  // namespace
}  // namespace knot_utm
