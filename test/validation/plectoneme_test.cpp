#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/rod/rod.hpp"
#include "reference.hpp"
#include "sim/twisted_rod.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 1.0;  // h
constexpr double kLength = 300.0;

/// A rod whose twisted ends were brought so near that it winds around itself, free of friction: a plectoneme, two
/// strands as a double helix with a loop at its end. It begins as a line with a slight bend.
///
/// The energy of a rod of plectoneme and straight tails is least, over the plectoneme's length and alpha, where
///
///     F R^2/B = sin^3 a (cos a tan 2a - sin a/2) = sin^4 a (1/2 + 1/cos 2a),   M R/B = 2 cos a sin^3 a/cos 2a.
///
/// Source: Clauvelin, Audoly, Neukirch 2008.
struct Plectoneme {
  TwistedRod rod;
  double edge;

  Plectoneme(double edge_length, double turn)
      : rod(kRadius, 1.0, static_cast<int>(std::lround(kLength / edge_length)), edge_length), edge(edge_length) {
    rod.settings.pressure_law = NormalLaw{0.5, 0.05 * kRadius, 0.02 * kRadius};
    rod.settings.drag = 0.02;
    rod.settings.residual = 1e-6;
    rod.settings.newton_cap = 0.2 * kRadius;
    rod.settings.motion_limit = 0.8 * kRadius;
    rod.settings.overlap_limit = 0.5 * kRadius;
    rod.settings.candidate_margin = 0.5 * kRadius;
    rod.begin(10.0, 15.0);
    constexpr double kShortening = 0.6 * kLength, kMotion = 0.2 * kRadius;
    // In tension by its twist before its ends are brought nearer: compressed, it would wind up at both of them.
    rod.move_to(rod.shortening, 70.0, 1e4, 10.0, kMotion);
    rod.move_to(kShortening, turn, 4e4, 10.0, kMotion);
    rod.move_to(kShortening, turn, 4e4, 200.0, kMotion);
  }

  /// Means over the middle half of the double helix.
  struct Helix {
    double radius = 0.0, angle = 0.0;  // R of the centreline, alpha between tangent and axis
    double length = 0.0;               // of one strand of the whole helix
    bool one_piece = false;
  };

  /// Two opposite points of the helix are the nearest of its two strands, 2 R apart, and their tangents, one of which
  /// runs back, make the angle pi - 2 alpha. The near points are middles of edges, which the smooth centreline meets.
  Helix helix() const {
    struct Opposite {
      double arclength, distance, angle;
    };
    std::vector<Opposite> found;
    const Points& x = rod.step->state().position;
    const int last = static_cast<int>(x.cols()) - 2;
    for (int i = 1; i <= last; ++i) {
      const SegmentWeights begin(0.0);
      const Vec3 here = combine(begin.value, x, i), along = combine(begin.derivative, x, i).normalized();
      Opposite nearest{i * edge, std::numeric_limits<double>::infinity(), 0.0};
      // The near strand ahead of it: the loop at the end is far longer than what is left out.
      for (int j = i + static_cast<int>(10.0 * kRadius / edge); j <= last; ++j) {
        constexpr int kParts = 20;
        for (int part = 0; part < kParts; ++part) {
          const SegmentWeights w(part / static_cast<double>(kParts));
          const double distance = (here - combine(w.value, x, j)).norm();
          if (distance >= nearest.distance) continue;
          nearest.distance = distance;
          nearest.angle = 0.5 * std::acos(-along.dot(combine(w.derivative, x, j).normalized()));
        }
      }
      if (nearest.distance < 2.0 * kRadius) found.push_back(nearest);
    }
    Helix out;
    const std::size_t quarter = found.size() / 4;
    if (quarter == 0) return out;
    out.length = found.back().arclength - found.front().arclength;
    out.one_piece = out.length < (static_cast<double>(found.size()) - 0.5) * edge;
    const double count = static_cast<double>(found.size() - 2 * quarter);
    for (std::size_t k = quarter; k + quarter < found.size(); ++k) {
      out.radius += 0.5 * found[k].distance / count;
      out.angle += found[k].angle / count;
    }
    return out;
  }
};

class R7_Plectoneme : public testing::TestWithParam<double> {};

TEST_P(R7_Plectoneme, TensionAndMomentAgainstItsHelixAngle) {
  const Plectoneme plectoneme(0.6 * kRadius, GetParam());
  const Plectoneme::Helix helix = plectoneme.helix();
  const double a = helix.angle, tension = plectoneme.rod.tension(), moment = plectoneme.rod.moment();
  EXPECT_LT(plectoneme.rod.fastest(), 1e-3) << "it should be at rest";
  EXPECT_TRUE(helix.one_piece);
  EXPECT_GT(helix.length, 50.0 * kRadius);
  RecordProperty("radius", std::to_string(helix.radius));
  RecordProperty("degrees", std::to_string(a * 180.0 / M_PI));
  const std::string what = "R7 plectoneme of " + std::to_string(std::lround(GetParam())) + " rad";
  hold_against(what + ": F R^2/B", std::pow(std::sin(a), 3.0) * (std::cos(a) * std::tan(2.0 * a) - 0.5 * std::sin(a)),
               tension * helix.radius * helix.radius, 0.05);
  hold_against(what + ": M R/B", 2.0 * std::cos(a) * std::pow(std::sin(a), 3.0) / std::cos(2.0 * a),
               moment * helix.radius, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Turns, R7_Plectoneme, testing::Values(125.0, 160.0),
                         [](const auto& turn) { return "Of" + std::to_string(std::lround(turn.param)) + "rad"; });

}  // namespace
}  // namespace knot_utm
