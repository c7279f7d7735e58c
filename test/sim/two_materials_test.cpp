// Ropes of two materials in one rod.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "sim/balance.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdgesOfRope = 12;

/// A rope through the given points, one behind the other.
struct LaidRopes {
  Points position;
  std::vector<int> cuts;

  void add(const Vec3& begin, const Vec3& edge, int edges = kEdgesOfRope) {
    const Eigen::Index before = position.cols();
    if (before > 0) cuts.push_back(static_cast<int>(before) - 1);
    position.conservativeResize(3, before + edges + 1);
    for (int i = 0; i <= edges; ++i) position.col(before + i) = begin + i * edge;
  }
  Eigen::VectorXd lengths() const {
    const Eigen::Index edges = position.cols() - 1;
    return (position.rightCols(edges) - position.leftCols(edges)).colwise().norm();
  }
  RodState state() const {
    RodState out;
    out.position = position;
    out.velocity = Points::Zero(3, position.cols());
    return out;
  }
};

Material soft_cord(double radius) {
  Material out = braided_rope();
  out.radius = radius;
  out.density *= 0.5;
  out.stretching_stiffness *= 0.2;
  out.bending_stiffness *= 0.05;
  out.twisting_stiffness *= 0.05;
  return out;
}

StepSettings settings_of(const Material& material, double mu_between, double mu_others) {
  StepSettings out = closed_form_settings(material);
  const double presliding = 1e-3 * material.radius;
  out.others = {{out.pressure_law, MemoryFriction{mu_between, presliding}},
                {out.pressure_law, MemoryFriction{mu_others, presliding}},
                {out.pressure_law, out.roller_friction},
                {},
                {}};
  return out;
}

TEST(TwoMaterials, TheSameOneTwiceIsOneToTheLastBit) {
  const Material material = braided_rope();
  const double h = material.radius;
  LaidRopes ropes;
  ropes.add(Vec3(-6.0 * h, 0.0, 0.0), Vec3(h, 0.0, 0.0));
  ropes.add(Vec3(0.0, -6.0 * h, 1.9 * h), Vec3(0.0, h, 0.0));
  for (const bool twist : {false, true}) {
    RodState state = ropes.state();
    if (twist) initialise_frames(&state);
    StepSettings one = closed_form_settings(material);
    one.friction = MemoryFriction{0.4, 1e-3 * h};
    if (twist) {
      one.friction_couple = 1.0;
      one.rolling = {0.2, h, 1e-3 * h};
    }
    StepSettings two = one;
    two.others = {{one.pressure_law, one.friction},
                  {one.pressure_law, one.friction},
                  {one.pressure_law, one.roller_friction},
                  one.rolling,
                  one.rolling};
    const auto as_one = TimeStep::make(make_rod(material, ropes.lengths(), ropes.cuts), state, one);
    const auto as_two = TimeStep::make(make_rod(material, material, ropes.lengths(), ropes.cuts), state, two);
    double pressed = 0.0;
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(as_one->step({}, 1e-5).accepted());
      ASSERT_TRUE(as_two->step({}, 1e-5).accepted());
      pressed = std::max(pressed, as_one->readings().contact().normal_force);
    }
    EXPECT_GT(pressed, 0.0);
    EXPECT_EQ(as_one->state().position, as_two->state().position);
    EXPECT_EQ(as_one->state().twist, as_two->state().twist);
  }
}

/// Under a dead load F each rope is longer by F l/k_s of its own.
TEST(TwoMaterials, EachRopeStretchesByItsOwnStiffness) {
  const Material rope = braided_rope(), cord = soft_cord(0.5 * rope.radius);
  const double h = rope.radius, load = 10.0, length = kEdgesOfRope * h;
  LaidRopes ropes;
  ropes.add(Vec3::Zero(), Vec3(h, 0.0, 0.0));
  ropes.add(Vec3(0.0, 100.0 * h, 0.0), Vec3(h, 0.0, 0.0));
  StepSettings settings = settings_of(rope, 0.0, 0.0);
  settings.motion_limit = settings.newton_cap = 1.0;
  const auto step = TimeStep::make(make_rod(rope, cord, ropes.lengths(), ropes.cuts), ropes.state(), settings);
  Boundary boundary;
  for (const int first : {0, kEdgesOfRope + 1}) {
    boundary.fixed_nodes.push_back({first, ropes.position.col(first)});
    boundary.forces.push_back({first + kEdgesOfRope, load * Vec3::UnitX()});
  }
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(step->step(boundary, 1.0).accepted());
  const auto longer = [&](int last) { return step->state().position(0, last) - length; };
  // The residual, 1e-8 N and 1e-9 of the load, over the load.
  EXPECT_NEAR(longer(kEdgesOfRope) / (load * length / rope.stretching_stiffness), 1.0, 1e-6);
  EXPECT_NEAR(longer(2 * kEdgesOfRope + 1) / (load * length / cord.stretching_stiffness), 1.0, 1e-6);
  const ElasticEnergy energy = elastic_energy(step->rod(), step->state());
  const double expected =
      0.5 * load * load * length * (1.0 / rope.stretching_stiffness + 1.0 / cord.stretching_stiffness);
  EXPECT_NEAR(energy.stretching / expected, 1.0, 1e-6);
}

/// Three ropes lie along each other: the first one is drawn along its axis between the other two, which are of another
/// material, or is at rest while one of these is drawn along the other. What slides bears mu times the normal force.
TEST(TwoMaterials, RopesSlideAtTheFrictionOfTheirPair) {
  constexpr double kBetween = 0.2, kOthers = 0.7;
  const Material rope = braided_rope(), cord = soft_cord(0.5 * rope.radius);
  const double h = rope.radius, pressed = 1e-3 * h;
  const StepSettings settings = settings_of(rope, kBetween, kOthers);
  for (const bool others : {false, true}) {
    LaidRopes ropes;
    const double z = rope.radius + cord.radius - pressed, far = others ? 50.0 * h : 0.0;
    ropes.add(Vec3(-3.0 * h, far, 0.0), Vec3(0.5 * h, 0.0, 0.0));
    ropes.add(Vec3(-3.0 * h, 0.0, z), Vec3(0.5 * h, 0.0, 0.0));
    ropes.add(Vec3(-3.0 * h, 0.0, others ? z + 2.0 * cord.radius - pressed : -z), Vec3(0.5 * h, 0.0, 0.0));
    const auto step = TimeStep::make(make_rod(rope, cord, ropes.lengths(), ropes.cuts), ropes.state(), settings);
    const int drawn = others ? 1 : 0, nodes = kEdgesOfRope + 1;
    Boundary boundary;
    for (int i = 0; i < ropes.position.cols(); ++i) boundary.fixed_nodes.push_back({i, ropes.position.col(i)});
    for (int k = 0; k < 20; ++k) {
      for (int i = drawn * nodes; i < (drawn + 1) * nodes; ++i)
        boundary.fixed_nodes[static_cast<std::size_t>(i)].position[0] += 0.01 * h;
      ASSERT_TRUE(step->step(boundary, 1.0).accepted());
    }
    double drag = 0.0;
    for (int i = drawn * nodes; i < (drawn + 1) * nodes; ++i) drag += step->readings().reaction(i)[0];
    const double normal = step->readings().contact().normal_force;
    EXPECT_GT(normal, 1.0);
    EXPECT_NEAR(drag / normal, others ? kOthers : kBetween, 1e-9);
  }
}

/// A limp cord lies half around a thick rope that is held: T2/T1 = exp(mu pi), mu that of the pair.
TEST(TwoMaterials, ALimpCordOnAThickRopeIsACapstan) {
  constexpr double kMu = 0.25, kTail = 20.0;
  Material rope = braided_rope(), cord = rope;
  cord.radius = 0.1 * rope.radius;
  cord.density = 100.0;
  cord.bending_stiffness = 1e-4 * kTail * cord.radius * cord.radius;
  cord.twisting_stiffness = cord.bending_stiffness;
  cord.stretching_stiffness = 1e4 * kTail;
  const double h = rope.radius, rho = h + cord.radius, edge = 0.1 * rho;
  LaidRopes ropes;
  ropes.add(Vec3(0.0, -6.0 * h, 0.0), Vec3(0.0, h, 0.0));
  const int around = static_cast<int>(std::ceil(M_PI * rho / edge)), straight = 20;
  ropes.add(Vec3::Zero(), Vec3::UnitX(), around + 2 * straight);
  for (int i = 0; i <= around + 2 * straight; ++i) {
    const double angle = std::clamp(M_PI * (i - straight) / around, 0.0, M_PI),
                 below = edge * std::max({0, straight - i, i - straight - around});
    ropes.position.col(13 + i) = Vec3(-rho * std::cos(angle), 0.0, rho * std::sin(angle) - below);
  }
  StepSettings settings = settings_of(cord, kMu, 0.0);
  // It presses with T/rho or more, and so sinks in by a hundredth of its radius.
  settings.pressure_law = {100.0 * kTail / (rho * cord.radius), 1e-3 * cord.radius};
  settings.others->between.normal = settings.others->own.normal = settings.pressure_law;
  settings.residual = 1e-6 * kTail;
  settings.residual_of_tension = 0.0;
  settings.drag = 100.0;
  Eigen::VectorXd rest = ropes.lengths();
  rest.tail(around + 2 * straight) /= 1.0 + kTail / cord.stretching_stiffness;  // it begins under its load
  const auto step = TimeStep::make(make_rod(rope, cord, rest, ropes.cuts), ropes.state(), settings);
  Boundary boundary;
  for (int i = 0; i <= kEdgesOfRope; ++i) boundary.fixed_nodes.push_back({i, ropes.position.col(i)});
  const int first = 13, last = static_cast<int>(ropes.position.cols()) - 1;
  boundary.forces = {{first, -kTail * Vec3::UnitZ()}};
  boundary.fixed_nodes.push_back({last, ropes.position.col(last)});
  const Vec3 from = ropes.position.col(last);
  double time = 0.0, sum = 0.0, span = 0.0;
  StepControl::Options options;
  options.longest = 0.05;
  options.motion = 0.5 * settings.motion_limit;
  StepControl control(options);
  // Three edges until it slides all along, then one more.
  const std::string gave_up = control.advance(
      *step, time, 4.0,
      [&](double, double to) -> const Boundary& {
        boundary.fixed_nodes.back().position = from - to * edge * Vec3::UnitZ();
        return boundary;
      },
      [&](double to, double dt, const StepSummary&) {
        if (to <= 3.0) return;
        sum += dt * step->readings().reaction(last).norm();
        span += dt;
      });
  ASSERT_EQ(gave_up, "");
  // Edges of a tenth of rho: second order in their length.
  EXPECT_NEAR(sum / span / kTail, std::exp(kMu * M_PI), 0.01 * std::exp(kMu * M_PI));
}

/// Two ropes of different radii and materials collide and roll on each other with friction at their surfaces: forces
/// and moments sum to nothing, and work is accounted for.
TEST(TwoMaterials, ForcesMomentsAndWorkBalance) {
  const Material rope = braided_rope(), cord = soft_cord(0.5 * rope.radius);
  const double h = rope.radius, touching = rope.radius + cord.radius;
  LaidRopes ropes;
  ropes.add(Vec3(-6.0 * h, 0.0, 0.0), Vec3(h, 0.0, 0.0));
  ropes.add(Vec3(0.2 * h, -6.0 * cord.radius, 0.99 * touching), Vec3(0.3 * h, cord.radius, 0.0));
  RodState state = ropes.state();
  state.velocity.rightCols(kEdgesOfRope + 1).colwise() = Vec3(0.02, 0.01, -0.05);
  initialise_frames(&state);
  StepSettings settings = settings_of(rope, 0.4, 0.2);
  settings.friction_couple = 1.0;
  settings.spin_inertia = false;
  settings.others->between.normal = settings.others->own.normal = settings.pressure_law =
      NormalLaw{300.0 * rope.bending_stiffness / std::pow(h, 4.0), 0.05 * h};
  Balance balance(TimeStep::make(make_rod(rope, cord, ropes.lengths(), ropes.cuts), state, settings), settings, 1e-3);
  const Boundary free;
  double largest = 0.0, friction = 0.0;
  balance.run(
      0.1, [&](double) -> const Boundary& { return free; },
      [&] {
        const double normal = balance.stepper().readings().contact().normal_force;
        largest = std::max(largest, normal);
        EXPECT_LT(balance.force().norm(), balance.force_bound() + 1e-9 * normal);
        EXPECT_LT(balance.moment().norm(), balance.moment_bound() + 1e-9 * normal * h);
      });
  friction = balance.sum().friction;
  EXPECT_GT(largest, 0.0);
  EXPECT_GT(friction, 0.0);
  EXPECT_LT(std::abs(balance.gap()), balance.rounding());
}

constexpr int kEdges = 12;  // of each rope

/// A rope of braided cord that falls from a held end, begun with an arc so that it bends, stretches and turns.
Points arc(double x) {
  Points out(3, kEdges + 1);
  const double h = braided_rope().radius, radius = 8.0 * h;
  for (int i = 0; i <= kEdges; ++i) {
    const double angle = h * i / radius;
    out.col(i) = Vec3(x + radius * (1.0 - std::cos(angle)), 0.2 * h * i, radius * std::sin(angle));
  }
  return out;
}

Eigen::VectorXd lengths(const Points& points) {
  const Eigen::Index edges = points.cols() - 1;
  return 1.01 * (points.rightCols(edges) - points.leftCols(edges)).colwise().norm().transpose();
}

/// Some ropes, joined to one rod, each held at its first node.
struct Ropes {
  RodProperties rod;
  RodState state;
  Boundary boundary;

  Ropes(const std::vector<double>& places, bool twist) {
    std::vector<int> cuts;
    state.position.resize(3, static_cast<Eigen::Index>(places.size()) * (kEdges + 1));
    for (std::size_t k = 0; k < places.size(); ++k) {
      const int first = static_cast<int>(k) * (kEdges + 1);
      if (k > 0) cuts.push_back(first - 1);
      state.position.middleCols(first, kEdges + 1) = arc(places[k]);
      boundary.fixed_nodes.push_back({first, state.position.col(first)});
    }
    rod = make_rod(braided_rope(), lengths(state.position), cuts);
    state.velocity = Points::Zero(3, state.position.cols());
    if (twist) initialise_frames(&state);
  }
};

StepSettings falling() {
  StepSettings out = closed_form_settings(braided_rope());
  out.gravity = Vec3(0.0, 0.0, -9.81);
  return out;
}

class CutRod : public ::testing::TestWithParam<bool> {};

TEST_P(CutRod, MovesAsItsRopesDoByThemselves) {
  const double apart = 100.0 * braided_rope().radius;
  Ropes both({0.0, apart}, GetParam()), first({0.0}, GetParam()), second({apart}, GetParam());
  const auto fall = [](Ropes& ropes) {
    std::unique_ptr<TimeStep> step = TimeStep::make(ropes.rod, ropes.state, falling());
    for (int i = 0; i < 40; ++i) EXPECT_TRUE(step->step(ropes.boundary, 1e-4).accepted());
    return step;
  };
  const auto joined = fall(both), one = fall(first), other = fall(second);
  const Points& x = joined->state().position;
  // The nodes moved by some millimetres; the residual moves them by less than a nanometre.
  EXPECT_GT((x.leftCols(kEdges + 1) - arc(0.0)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_NEAR((x.leftCols(kEdges + 1) - one->state().position).cwiseAbs().maxCoeff(), 0.0, 1e-9);
  EXPECT_NEAR((x.rightCols(kEdges + 1) - other->state().position).cwiseAbs().maxCoeff(), 0.0, 1e-9);
  const Energies sum = joined->readings().energies(), of_one = one->readings().energies(),
                 of_other = other->readings().energies();
  EXPECT_NEAR(sum.stretching, of_one.stretching + of_other.stretching, 1e-6 * sum.stretching);
  EXPECT_NEAR(sum.bending, of_one.bending + of_other.bending, 1e-6 * sum.bending);
  EXPECT_NEAR(sum.kinetic, of_one.kinetic + of_other.kinetic, 1e-6 * sum.kinetic);
  EXPECT_EQ(joined->tension()[kEdges], 0.0);
}

/// As two strands that were both drawn upwards, one below the other: a turn by half a circle has no curvature.
TEST_P(CutRod, MayBeJoinedByALinkThatLiesBackAlongItsRopes) {
  const double h = braided_rope().radius;
  const auto strand = [&](double from) {
    Points x = Points::Zero(3, kEdges + 1);
    for (int i = 0; i <= kEdges; ++i) x.col(i) = Vec3(0.0, 0.0, from + h * i);
    return x;
  };
  const auto fallen = [&](const Points& x, const std::vector<int>& cuts) {
    Ropes ropes({0.0}, false);
    ropes.rod = make_rod(braided_rope(), lengths(x) / 1.01, cuts);
    ropes.state = {};
    ropes.state.position = x;
    ropes.state.velocity = Points::Zero(3, x.cols());
    if (GetParam()) initialise_frames(&ropes.state);
    ropes.boundary.fixed_nodes.clear();
    for (int first = 0; first < static_cast<int>(x.cols()); first += kEdges + 1)
      ropes.boundary.fixed_nodes.push_back({first, x.col(first)});
    StepSettings settings = falling();
    settings.gravity = Vec3(9.81, 0.0, 0.0);
    const std::unique_ptr<TimeStep> step = TimeStep::make(ropes.rod, ropes.state, settings);
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(step->step(ropes.boundary, 1e-4).accepted());
    return step->state().position;
  };
  const Points upper = strand(0.0);
  Points both(3, 2 * upper.cols());
  both << upper, strand(-3.0 * kEdges * h);
  const Points x = fallen(both, {kEdges}), one = fallen(upper, {});
  EXPECT_GT(one.row(0).maxCoeff(), 1e-6);
  EXPECT_NEAR((x.leftCols(kEdges + 1) - one).cwiseAbs().maxCoeff(), 0.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(WithoutAndWithTwist, CutRod, ::testing::Bool());

TEST(CutRod, HasTheMassLengthAndEnergyOfItsRopes) {
  const double apart = 100.0 * braided_rope().radius;
  const Ropes both({0.0, apart}, true), one({0.0}, true);
  EXPECT_NEAR(both.rod.length(), 2.0 * one.rod.length(), 1e-12);
  EXPECT_NEAR(both.rod.mass.sum(), 2.0 * one.rod.mass.sum(), 1e-12);
  const ElasticEnergy sum = elastic_energy(both.rod, both.state), half = elastic_energy(one.rod, one.state);
  EXPECT_NEAR(sum.stretching, 2.0 * half.stretching, 1e-9 * sum.stretching);
  EXPECT_NEAR(sum.bending, 2.0 * half.bending, 1e-9 * sum.bending);
  EXPECT_EQ(sum.twisting, 0.0);
}

TEST(CutRod, IsMeasuredAlongItsRopesOneBehindTheOther) {
  const RodProperties rod = Ropes({0.0, 1.0}, false).rod;
  const Eigen::VectorXd arclength = rod.arclength();
  const double half = 0.5 * rod.length();
  EXPECT_GT(arclength[kEdges + 1], 1.5 * arclength[kEdges]);
  EXPECT_NEAR(rod.place(arclength[kEdges]), half, 1e-12);
  EXPECT_NEAR(rod.place(arclength[kEdges + 1]), half, 1e-12);
  EXPECT_NEAR(rod.place(kEdges + 1, 0.5), half + 0.5 * rod.rest_length[kEdges + 1], 1e-12);
  EXPECT_NEAR(rod.place(rod.edges() - 1, 1.0), rod.length(), 1e-12);
}

TEST(CutRod, ItsRopesPressOnEachOtherAndItsCutEdgeOnNothing) {
  // The second rope lies across the first one, a tenth of a radius too near; the cut edge runs through both.
  const double h = braided_rope().radius;
  Points x(3, 2 * (kEdges + 1));
  for (int i = 0; i <= kEdges; ++i) {
    x.col(i) = Vec3(h * (i - 0.5 * kEdges), 0.0, 0.0);
    x.col(kEdges + 1 + i) = Vec3(0.0, h * (i - 0.5 * kEdges), 1.9 * h);
  }
  RodState state;
  state.position = x;
  state.velocity = Points::Zero(3, x.cols());
  Eigen::VectorXd rest = Eigen::VectorXd::Constant(x.cols() - 1, h);
  const RodProperties rod = make_rod(braided_rope(), rest, {kEdges});
  const std::unique_ptr<TimeStep> step = TimeStep::make(rod, state, closed_form_settings(braided_rope()));
  ASSERT_TRUE(step->step({}, 1e-5).accepted());
  EXPECT_GT(step->readings().contact().normal_force, 0.0);
  const Vec3 up = step->state().position.rightCols(kEdges + 1).rowwise().mean(),
             down = step->state().position.leftCols(kEdges + 1).rowwise().mean();
  EXPECT_GT(up[2], 1.9 * h);
  EXPECT_NEAR(up[2] - 1.9 * h, -down[2], 1e-9);
}

}  // namespace
}  // namespace knot_utm
