// R13: a ring on a shaft, dragged along it, rolls as an O-ring does.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <string>

#include "knot_utm/rod/bending.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "reference.hpp"
#include "sim/capstan.hpp"

namespace knot_utm {
namespace {

struct RingOptions {
  double radius = 0.1;   ///< h
  double natural = 1.0;  ///< kappa_0, in the plane of the ring
  double friction = 0.5;
  double rolling = 0.0;  ///< mu_r
  double tension = 200.0;
  int edges_a_turn = 120;
};

/// A ring around a fixed shaft along x. Lengths in units of its centreline's radius R = 1, bending stiffness 1.
///
/// The surface of the shaft is straight along x and touches the ring at h from its centreline, so that the ring's way
/// is h phi, whatever R is. Its sections then stand at phi to their natural plane, and its energy is
///
///   pi R k_b [(1/R - kappa_0 cos phi)^2 + (kappa_0 sin phi)^2] = const - 2 pi k_b kappa_0 cos phi.
///
/// The solver has no closed rods, so the ring is an arc of nearly a whole turn, whose ends are just so far apart that
/// they do not touch. Every piece of a ring is like every other one. So all forces of the ring are those of the arc
/// times 2 pi/Theta, Theta being what the arc turns by at all nodes that bend: nothing else turns its sections. This
/// is exact on any mesh if both ends stay as they would in the ring. There is no twist in it, so the spins of all
/// edges are free, those at the ends too. The bending moment is borne by clamps, which hold two nodes at each end and
/// move along the shaft with the rest. All nodes between them are held along the shaft by stiff springs, as by a pusher
/// of the ring's shape, and are free across it. The rod is shorter at rest than the arc, so that tension presses it
/// onto the shaft.
///
/// Pressure and rolling are the same everywhere and the couple is along the rod. So this sees neither twist nor the
/// part of a couple that bends.
struct Ring {
  static constexpr double kSpring = 1e6, kSpeed = 0.1;
  RingOptions options;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;
  Points begin;
  double turned = 0.0;  // Theta
  double way = 0.0, time = 0.0;

  explicit Ring(const RingOptions& ring_options) : options(ring_options) {
    const double angle = 2.0 * M_PI / options.edges_a_turn;
    const int gap = static_cast<int>(std::ceil(4.0 * options.radius / angle));
    const int nodes = options.edges_a_turn - gap + 1;
    turned = (nodes - 2) * angle;
    Material material;
    material.radius = options.radius;
    material.density = 1.0;
    material.bending_stiffness = 1.0;
    material.twisting_stiffness = 1.0;
    material.stretching_stiffness = 100.0 * options.tension;
    StepSettings settings = capstan_settings(material, options.tension, 1e-3, 1e-8);
    settings.roller_friction = MemoryFriction{options.friction, 1e-4 * options.radius};
    settings.friction_couple = 1.0;
    settings.rolling = {options.rolling, options.radius, 1e-4 * options.radius};
    settings.spin_inertia = false;

    const double at = 1.0 - settings.pressure_law.overlap_at(options.tension);
    RodState state;
    state.position.resize(3, nodes);
    state.velocity = Points::Zero(3, nodes);
    for (int i = 0; i < nodes; ++i) state.position.col(i) << 0.0, at * std::sin(angle * i), at * std::cos(angle * i);
    initialise_frames(&state);
    begin = state.position;
    const Points edges = begin.rightCols(nodes - 1) - begin.leftCols(nodes - 1);
    const double strain = options.tension / material.stretching_stiffness;
    RodProperties rod = make_rod(material, edges.colwise().norm().transpose() / (1.0 + strain));
    state.natural_curvature.resize(2, nodes - 2);
    for (int i = 1; i + 1 < nodes; ++i) {
      const auto directors = [&](int edge) {
        return material_directors(edges.col(edge).normalized(), state.reference_director.col(edge), 0.0);
      };
      const Eigen::Vector2d curvature =
          material_curvature(edges.col(i - 1), edges.col(i), directors(i - 1), directors(i));
      state.natural_curvature.col(i - 1) = options.natural * rod.voronoi_length[i] * curvature.normalized();
    }
    stepper = TimeStep::make(rod, state, settings);

    Roller shaft;
    shaft.axis = Vec3::UnitX();
    shaft.radius = 1.0 - options.radius;
    boundary.rollers = {shaft};
    for (const int node : {0, 1, nodes - 2, nodes - 1}) boundary.fixed_nodes.push_back({node, begin.col(node)});
    for (int i = 2; i + 2 < nodes; ++i)
      boundary.holds.push_back({i, begin.col(i), kSpring * Vec3::UnitX() * Vec3::UnitX().transpose()});
  }

  /// Drags the ring along the shaft until its way is `to`, in steps in which a rolling ring turns by 0.05.
  void drag(double to) {
    StepControl::Options control_options;
    control_options.longest = control_options.first = 0.05 * options.radius / kSpeed;
    control_options.motion = control_options.slip = 1e3;
    run_to(to / kSpeed, *stepper, time, control_options, [&](double now) -> const Boundary& {
      for (FixedNode& held : boundary.fixed_nodes) held.position[0] = kSpeed * now;
      for (SpringHold& held : boundary.holds) held.place[0] = kSpeed * now;
      return boundary;
    });
    way = to;
  }

  /// Axial force of the whole ring on the shaft.
  double force() const { return stepper->readings().roller_force(0)[0] * 2.0 * M_PI / turned; }
  /// That of the pusher and the clamps on the ring.
  double pushed() const {
    double sum = 0.0;
    for (const FixedNode& held : boundary.fixed_nodes) sum += stepper->readings().reaction(held.node)[0];
    for (const SpringHold& held : boundary.holds) sum += held.force(stepper->state().position.col(held.node))[0];
    return sum * 2.0 * M_PI / turned;
  }
  /// What friction can bear.
  double limit() const {
    const NodeRange all{0, static_cast<int>(stepper->rod().nodes()) - 1};
    return options.friction * stepper->readings().roller_normal_force(all) * 2.0 * M_PI / turned;
  }
  /// By how much the sections have rolled, the mean and the range [rad].
  double rolled() const { return std::abs(stepper->state().twist.mean()); }
  double uneven() const { return stepper->state().twist.maxCoeff() - stepper->state().twist.minCoeff(); }
};

/// dE/d(h phi)
double rolling_force(const RingOptions& options, double phi) {
  return 2.0 * M_PI * options.natural * std::sin(phi) / options.radius;
}

// The mesh has no error in this. The ring runs inside of R by the contact's overlap, 0.0003 R, which shortens the lever
// of friction by as much. So the way h phi turns it by more than phi, by that share. At phi = 4 that is 0.12 % of the
// force.
constexpr double kGate = 2e-3;

class R13ORing : public testing::TestWithParam<double> {};

TEST_P(R13ORing, RollsAgainstItsNaturalCurvatureWhateverTheFriction) {
  RingOptions options;
  options.friction = GetParam();
  Ring ring(options);
  // Beyond half a turn the ring pulls forward.
  for (const double phi : {0.3, 0.5 * M_PI, 2.5, 4.0}) {
    ring.drag(options.radius * phi);
    hold_against(formatted("R13 O-ring, mu = %.1f, phi = %.2f: axial force [k_b/R^2]", options.friction, phi),
                 rolling_force(options, phi), ring.force(), kGate);
    hold_against(formatted("R13 O-ring, mu = %.1f, phi = %.2f: rolled by [rad]", options.friction, phi), phi,
                 ring.rolled(), kGate);
    EXPECT_LT(ring.uneven(), kGate * phi) << "all sections alike";
    EXPECT_NEAR(ring.pushed(), ring.force(), 1e-4 * std::abs(ring.force())) << "as the pusher feels it";
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, R13ORing, testing::Values(0.2, 0.5, 1.0),
                         [](const auto& mu) { return "Mu" + std::to_string(std::lround(100.0 * mu.param)); });

/// The surface of the shaft is straight along it, so that a thick ring rolls by the same way h phi as a thin one.
TEST(R13ORingOfAnyThickness, RollsByItsOwnRadius) {
  for (const double radius : {0.02, 0.3}) {
    for (const double natural : {0.5, 2.0}) {
      RingOptions options;
      options.radius = radius;
      options.natural = natural;
      options.tension = 40.0 / radius;
      Ring ring(options);
      ring.drag(options.radius);
      hold_against(formatted("R13 O-ring, h = %.2f R, kappa_0 = %.1f/R: axial force [k_b/R^2]", radius, natural),
                   rolling_force(options, 1.0), ring.force(), kGate);
    }
  }
}

TEST(R13ORingStraightAtRest, RollsForNothingWhateverTheFriction) {
  for (const double mu : {0.1, 1.0}) {
    RingOptions options;
    options.natural = 0.0;
    options.friction = mu;
    Ring ring(options);
    ring.drag(3.0 * options.radius);
    hold_below(formatted("R13 O-ring that is straight at rest, mu = %.1f: force over what friction can bear", mu), 1e-6,
               std::abs(ring.force()) / ring.limit());
    EXPECT_NEAR(ring.rolled(), 3.0, 3.0 * kGate);
  }
}

/// Its line of contact runs around the shaft, and it turns about nothing else: the couple mu_r h p of every piece
/// resists, which takes the force mu_r p at the surface, h away.
TEST(R13ORingThatResistsRolling, ResistsInFull) {
  RingOptions options;
  options.natural = 0.0;
  options.rolling = 0.1;
  Ring ring(options);
  ring.drag(2.0 * options.radius);
  hold_against("R13 O-ring that resists rolling: axial force [k_b/R^2]",
               options.rolling * ring.limit() / options.friction, ring.force(), kGate);
  EXPECT_NEAR(ring.rolled(), 2.0, 2.0 * kGate);
}

TEST(R13ORingBeyondFriction, SlidesAndRollsNoFurther) {
  RingOptions options;
  options.friction = 0.025;
  Ring ring(options);
  ring.drag(2.0 * options.radius);
  hold_against("R13 O-ring beyond what friction can bear: axial force [k_b/R^2]", ring.limit(), ring.force(), kGate);
  hold_against("R13 O-ring beyond what friction can bear: rolled by [rad]",
               std::asin(ring.limit() / rolling_force(options, 0.5 * M_PI)), ring.rolled(), kGate);
}

}  // namespace
}  // namespace knot_utm
