// Where the work of a step goes, and that forces and moments sum to nothing.

#include "sim/balance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kGravity = OnAnIncline::kGravity;

/// A free rod in its first mode of stretching: a linear system, whose energy implicit Euler divides by 1 + (omega
/// dt)^2.
TEST(EnergyBalance, AVibratingRodLosesWhatImplicitEulerTakes) {
  const int edges = 20;
  const Material material = braided_rope();
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(edges, material.radius));
  StepSettings settings = closed_form_settings(material);
  settings.residual_of_tension = 0.0;
  RodState state = straight_state(rod);
  for (int i = 0; i <= edges; ++i) state.velocity(0, i) = std::cos(M_PI * i / edges);
  const double spring = material.stretching_stiffness / material.radius;
  const double omega = 2.0 * std::sqrt(spring / rod.mass[1]) * std::sin(0.5 * M_PI / edges);
  for (const double dt : {0.2 / omega, 0.02 / omega}) {
    settings.motion_limit = settings.newton_cap = 1.0;
    Balance balance(TimeStep::make(rod, state, settings), settings, dt);
    const Boundary free;
    const double begin = balance.stepper().readings().energies().total();
    const int steps = 40;
    balance.run(steps * dt, [&](double) -> const Boundary& { return free; });
    const double left = begin * std::pow(1.0 + omega * omega * dt * dt, -steps);
    EXPECT_NEAR(balance.stepper().readings().energies().total(), left, balance.residual_bound() + 1e-9 * begin);
    EXPECT_NEAR(balance.sum().numerical, begin - left, balance.residual_bound() + 1e-9 * begin);
    EXPECT_LT(std::abs(balance.sum().residual), balance.residual_bound());
    EXPECT_LT(std::abs(balance.gap()), balance.rounding());
  }
}

/// A rod lies on a plane that falls towards +x by `angle`, pressed in by its weight.
struct Incline : OnAnIncline {
  std::unique_ptr<Balance> balance;

  Incline(double angle, double mu)
      : OnAnIncline(angle, Vec3::UnitX(), 24, MemoryFriction{mu, 1e-3 * braided_rope().radius}),
        balance(std::make_unique<Balance>(TimeStep::make(rod, state, settings), settings, 0.01)) {}
  void run(double duration) {
    balance->run(duration, [this](double) -> const Boundary& { return boundary; });
  }
  double place() const { return balance->stepper().state().position.row(0).mean(); }
};

TEST(EnergyBalance, ASlidingRodLosesFrictionTimesWay) {
  const double mu = 0.46;
  Incline scene(1.3 * std::atan(mu), mu);
  scene.run(0.1);
  const double from = scene.place(), lost = scene.balance->sum().friction;
  scene.run(0.5);
  const double expected = mu * scene.normal_force * (scene.place() - from);
  EXPECT_GT(scene.place() - from, 0.1);
  EXPECT_NEAR(scene.balance->sum().friction - lost, expected, 1e-6 * expected);
  EXPECT_LT(std::abs(scene.balance->gap()), scene.balance->rounding());
}

enum class Kind { kStraight, kOverhand, kFallsOnARoller, kCurved };

struct Scene {
  Kind kind;
  bool twist;
  double friction;
  double couple = 0.0;  // of friction at the surface
  bool soft = false;    // sections

  bool curved() const { return kind == Kind::kCurved; }

  std::string name() const {
    static const char* const kinds[] = {"Straight", "Overhand", "FallsOnARoller", "Curved"};
    return std::string(kinds[static_cast<int>(kind)]) + (twist ? "WithTwist" : "") +
           (friction > 0.0 ? "AndFriction" : "") + (couple > 0.0 ? "AtTheSurface" : "") +
           (soft ? "OfSoftSections" : "");
  }
};

/// The scene, its boundary and how that moves: the far end or the roller at `velocity`, the last frame at `spin`.
struct Running {
  static constexpr double kStep = 2e-3;
  Boundary begin, boundary;
  std::unique_ptr<Balance> balance;
  Vec3 velocity = Vec3::Zero();
  double spin = 0.0;

  explicit Running(const Scene& scene) {
    Material material = braided_rope();
    if (scene.curved()) material.stretching_stiffness = 1e3;
    material.twisting_stiffness = material.bending_stiffness;
    if (scene.soft) {
      material.section = CrossSection::kSoft;
      material.stretching_stiffness = 40.0 * material.bending_stiffness / std::pow(material.radius, 2.0);
    }
    StepSettings settings = closed_form_settings(material);
    settings.gravity = Vec3(0.5, 0.0, -kGravity);
    settings.drag = 1.0;
    settings.friction = settings.roller_friction = MemoryFriction{scene.friction, 1e-3 * material.radius};
    settings.pressure_law =
        NormalLaw{300.0 * material.bending_stiffness / std::pow(material.radius, 4.0), 0.05 * material.radius};
    settings.friction_couple = scene.couple;
    // A spin without inertia is in equilibrium, and so is the sum of all moments.
    settings.spin_inertia = scene.curved();

    RodState state;
    RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(40, material.radius));
    if (scene.kind == Kind::kOverhand) {
      const DrawnOverhand drawn(material);
      rod = drawn.rod;
      state = drawn.state;
      settings.drag = 20.0;
    } else {
      state = straight_state(rod);
    }
    if (scene.curved())
      state.natural_curvature = Eigen::Matrix<double, 2, Eigen::Dynamic>::Constant(2, rod.nodes() - 2, 0.02);
    if (scene.twist) initialise_frames(&state);

    const int last = static_cast<int>(rod.nodes()) - 1;
    Vec3 way;  // in a step
    if (scene.kind == Kind::kFallsOnARoller) {
      boundary.rollers = {plane_below(material.radius)};
      boundary.rollers[0].axis = Vec3::UnitY();
      boundary.rollers[0].radius = 6.0 * material.radius;
      boundary.rollers[0].centre = Vec3(0.0, 0.0, -7.0 * material.radius);
      way = 2e-3 * material.radius * Vec3(0.3, 0.2, 1.0);
    } else {
      for (const int node : {0, 1, last - 1, last}) boundary.fixed_nodes.push_back({node, state.position.col(node)});
      way = 2e-2 * material.radius * (state.position.col(last) - state.position.col(0)).normalized();
      if (scene.kind == Kind::kStraight) way = 1e-4 * material.radius * Vec3(1.0, 0.5, 2.0);
      if (scene.curved()) way = 1e-3 * material.radius * Vec3(-5.0, 2.0, 0.0);
      if (scene.twist) {
        boundary.fixed_twists = {{0, 0.0}, {last - 1, 0.0}};
        spin = 10.0;
      }
    }
    velocity = way / kStep;
    begin = boundary;
    balance = std::make_unique<Balance>(TimeStep::make(rod, state, settings), settings, kStep);
  }

  const Boundary& at(double time) {
    for (std::size_t k = 0; k < boundary.rollers.size(); ++k)
      boundary.rollers[k].centre = begin.rollers[k].centre + time * velocity;
    for (std::size_t k = 2; k < boundary.fixed_nodes.size(); ++k)
      boundary.fixed_nodes[k].position = begin.fixed_nodes[k].position + time * velocity;
    if (!boundary.fixed_twists.empty()) boundary.fixed_twists[1].angle = time * spin;
    return boundary;
  }
  void run(const std::function<void()>& each) {
    balance->run(
        120 * kStep, [this](double to) -> const Boundary& { return at(to); }, each);
  }
};

class BalanceOf : public testing::TestWithParam<Scene> {};

TEST_P(BalanceOf, EverySceneClosesStepByStep) {
  Running scene(GetParam());
  const Balance& books = *scene.balance;
  const bool spins = GetParam().curved();  // with inertia, of which the sums of loads do not know
  double gap = 0.0;
  scene.run([&] {
    EXPECT_LT(std::abs(books.gap() - gap), books.rounding());
    gap = books.gap();
    EXPECT_LT(books.read_force().norm(), books.force_bound());
    EXPECT_LT(books.read_moment().norm(), books.moment_bound());
    if (spins) return;
    EXPECT_LT(books.force().norm(), books.force_bound());
    EXPECT_LT(books.moment().norm(), books.moment_bound());
  });
  if (HasFatalFailure()) return;
  EXPECT_LT(std::abs(books.sum().residual), books.residual_bound());
  EXPECT_GT(books.sum().drag, 0.0);
  EXPECT_EQ(books.sum().friction > 0.0, GetParam().friction > 0.0);
  EXPECT_EQ(books.sum().plastic, 0.0);
  if (!spins) {
    EXPECT_GT(books.largest_load(), 100.0 * books.force_bound()) << "nothing to balance";
    EXPECT_GT(books.largest_moment(), 100.0 * books.moment_bound()) << "nothing to balance";
  }
  // The energies that the balance goes by are those of the state.
  const Energies energies = books.stepper().readings().energies();
  const ElasticEnergy elastic = elastic_energy(books.stepper().rod(), books.stepper().state());
  EXPECT_NEAR(energies.stretching, elastic.stretching, 1e-9 * energies.total());
  // Bends and twists go by the stretch at the step's beginning.
  const double lag = GetParam().soft ? 1e-3 : 1e-9;
  EXPECT_NEAR(energies.bending, elastic.bending, lag * energies.total());
  EXPECT_NEAR(energies.twisting, elastic.twisting, lag * energies.total());
}

INSTANTIATE_TEST_SUITE_P(Scenes, BalanceOf,
                         testing::Values(Scene{Kind::kCurved, true, 0.0}, Scene{Kind::kStraight, false, 0.0},
                                         Scene{Kind::kStraight, true, 0.0}, Scene{Kind::kOverhand, false, 0.3},
                                         Scene{Kind::kOverhand, true, 0.3}, Scene{Kind::kOverhand, true, 0.3, 1.0},
                                         Scene{Kind::kFallsOnARoller, true, 0.0},
                                         Scene{Kind::kFallsOnARoller, true, 0.4, 1.0},
                                         Scene{Kind::kFallsOnARoller, false, 0.4},
                                         Scene{Kind::kOverhand, true, 0.3, 1.0, true},
                                         Scene{Kind::kFallsOnARoller, true, 0.4, 1.0, true}),
                         [](const auto& scene) { return scene.param.name(); });

}  // namespace
}  // namespace knot_utm
