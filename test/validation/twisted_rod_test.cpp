// R6 and R7: what a straight rod becomes whose ends are turned and brought nearer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "reference.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// A straight rod of bending stiffness 1 and mass 1 per length along x with its middle at the origin, clamped at both
/// ends (two nodes and the frame of the edge between them). The clamps are brought nearer, each by half, and the far
/// one is turned about x. Twist has no inertia, so it is even at all times.
struct TwistedRod {
  RodProperties rod;
  StepSettings settings;
  Boundary boundary;
  std::unique_ptr<TimeStep> step;
  double shortening = 0.0, turn = 0.0;  // of the ends [m], of the far clamp [rad]

  TwistedRod(double radius, double twisting_stiffness, int edges, double edge_length) {
    RodMaterial material;
    material.radius = radius;
    material.density = 1.0 / (M_PI * radius * radius);
    material.bending_stiffness = 1.0;
    material.twisting_stiffness = twisting_stiffness;
    material.stretching_stiffness = 1e5;
    rod = make_rod(material, Eigen::VectorXd::Constant(edges, edge_length));
    settings.spin_inertia = false;
    settings.pressure_law = NormalLaw{1.0, 0.05 * radius};
    settings.max_iterations = 40;
  }

  /// Begins with a bend in its middle, `amplitude` high and about `size` long; no edge is strained.
  void begin(double amplitude, double size) {
    RodState state;
    const Eigen::Index nodes = rod.nodes();
    const double edge = rod.rest_length[0];
    state.position = Points::Zero(3, nodes);
    for (Eigen::Index i = 2; i + 2 < nodes; ++i) {
      const double s = (edge * static_cast<double>(i) - 0.5 * rod.length()) / size;
      state.position.col(i).tail<2>() = amplitude / std::cosh(s) * Eigen::Vector2d(std::cos(s), std::sin(s));
    }
    for (Eigen::Index i = 1; i < nodes; ++i) {
      const double across2 = (state.position.col(i) - state.position.col(i - 1)).tail<2>().squaredNorm();
      state.position(0, i) = state.position(0, i - 1) + std::sqrt(edge * edge - across2);
    }
    shortening = rod.length() - state.position(0, nodes - 1);
    state.position.row(0).array() -= 0.5 * state.position(0, nodes - 1);
    state.velocity = Points::Zero(3, nodes);
    initialise_frames(&state);
    step = TimeStep::make(rod, state, settings);
    const int last = static_cast<int>(nodes) - 1;
    for (const int node : {0, 1, last - 1, last}) boundary.fixed_nodes.push_back({node, state.position.col(node)});
    boundary.fixed_twists = {{0, 0.0}, {last - 1, 0.0}};
  }

  /// Moves the clamps within `time`, from rest to rest: a sudden start would compress the rod.
  void move_to(double new_shortening, double new_turn, double time, double longest_step, double motion) {
    StepControl::Options options;
    options.longest = longest_step;
    options.motion = motion;
    const double from = shortening, turned = turn;
    double now = 0.0;
    run_to(time, *step, now, options, [&](double to) -> const Boundary& {
      const double t = to / time, way = t * t * (3.0 - 2.0 * t);
      shortening = from + (new_shortening - from) * way;
      turn = turned + (new_turn - turned) * way;
      place_clamps();
      return boundary;
    });
  }

  /// Force along the rod at the far clamp, and moment about it.
  double tension() const {
    return step->readings().reaction(last_node() - 1).x() + step->readings().reaction(last_node()).x();
  }
  double moment() const { return step->readings().reaction_torque(last_node() - 1); }
  double fastest() const { return step->state().velocity.colwise().norm().maxCoeff(); }

 private:
  int last_node() const { return static_cast<int>(rod.nodes()) - 1; }

  void place_clamps() {
    const double end = 0.5 * (rod.length() - shortening), inner = end - rod.rest_length[0];
    const double places[] = {-end, -inner, inner, end};
    for (std::size_t k = 0; k < 4; ++k) boundary.fixed_nodes[k].position.x() = places[k];
    boundary.fixed_twists[1].angle = turn;
  }
};

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

constexpr double kRadius = 1.0;  // h
constexpr double kLongRod = 300.0;

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
      : rod(kRadius, 1.0, static_cast<int>(std::lround(kLongRod / edge_length)), edge_length), edge(edge_length) {
    rod.settings.pressure_law = NormalLaw{0.5, 0.05 * kRadius, 0.02 * kRadius};
    rod.settings.drag = 0.02;
    rod.settings.residual = 1e-6;
    rod.settings.newton_cap = 0.2 * kRadius;
    rod.settings.motion_limit = 0.8 * kRadius;
    rod.settings.overlap_limit = 0.5 * kRadius;
    rod.settings.candidate_margin = 0.5 * kRadius;
    rod.begin(10.0, 15.0);
    constexpr double kShortening = 0.6 * kLongRod, kMotion = 0.2 * kRadius;
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
