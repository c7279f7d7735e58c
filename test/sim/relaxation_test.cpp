// Rods of which a share of the stiffness relaxes, against closed forms of the standard linear solid.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/frames.hpp"
#include "rod/own_laws.hpp"
#include "sim/balance.hpp"
#include "sim/saved.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 12;
constexpr double kShare = 0.3, kTime = 200.0;  // s [-]; tau, far longer than a rod swings [s]
constexpr StandardSolid kSolid{kShare, kTime};
constexpr double kStrain = 1e-3;

/// What is left of a held load after a time: 1 - s (1 - exp(-t/tau)).
double left_after(double time) { return 1.0 - kShare * (1.0 - std::exp(-time / kTime)); }

/// The implicit Euler method takes (1 + dt/tau)^-n for exp(-t/tau). It is late by dt/2 t/tau exp(-t/tau)/tau at first
/// order, at most dt/(2 e tau); the next order is smaller than a tenth of that in the steps below.
double error_of_step(double dt) { return 1.1 * dt / (2.0 * std::exp(1.0) * kTime); }

/// A straight rod along x.
struct Straight {
  Material material = braided_rope();
  RodProperties rod;
  StepSettings settings;
  RodState state;
  double stiffness = material.stretching_stiffness;

  Straight() {
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, material.radius));
    set_law(rod, StretchingLaws(ViscoelasticStretching{kSolid}));
    settings = closed_form_settings(material);
    state = straight_state(rod);
    remember_stretches(rod, &state);
  }
  Boundary stretched(double strain) const {
    Boundary out;
    for (int i = 0; i <= kEdges; ++i) out.fixed_nodes.push_back({i, (1.0 + strain) * state.position.col(i)});
    return out;
  }
  std::unique_ptr<TimeStep> stepper() const { return TimeStep::make(rod, state, settings); }
};

/// The largest difference of a held rod's tension from the closed form, over the first tension [-].
double error_of_relaxation(double dt) {
  const Straight scene;
  const std::unique_ptr<TimeStep> stepper = scene.stepper();
  const Boundary held = scene.stretched(kStrain);
  constexpr double kAtOnce = 1e-9 * kTime;
  EXPECT_TRUE(stepper->step(held, kAtOnce).accepted());
  const double first = scene.stiffness * kStrain;
  EXPECT_NEAR(stepper->tension()[0], first, 1e-8 * first) << "k_s is the stiffness of what is stretched at once";
  double error = 0.0;
  for (double t = dt; t < 4.0 * kTime; t += dt) {
    EXPECT_TRUE(stepper->step(held, dt).accepted());
    for (const double tension : stepper->tension()) error = std::max(error, std::abs(tension / first - left_after(t)));
  }
  return error;
}

TEST(Relaxation, AHeldRodLosesItsShareOfTheLoad) {
  constexpr double kStep = kTime / 50.0;
  const double error = error_of_relaxation(kStep);
  EXPECT_LT(error, kShare * error_of_step(kStep));
  EXPECT_NEAR(error_of_relaxation(0.5 * kStep), 0.5 * error, 0.03 * error) << "first order in the step";
}

/// Under a load F the strain is F/k_s at first, and grows to F/(k_s (1 - s)) with the time tau/(1 - s).
TEST(Relaxation, ALoadedRodCreeps) {
  const Straight scene;
  const std::unique_ptr<TimeStep> stepper = scene.stepper();
  const double load = kStrain * scene.stiffness, dt = kTime / 100.0, length = scene.rod.length();
  Boundary loaded;
  loaded.fixed_nodes.push_back({0, scene.state.position.col(0)});
  loaded.forces.push_back({kEdges, Vec3(load, 0.0, 0.0)});
  const auto strain = [&] { return stepper->state().position(0, kEdges) / length - 0.5; };
  // The load comes within a hundredth of a step, in which its wave dies out.
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(stepper->step(loaded, 1e-3 * dt).accepted());
  EXPECT_NEAR(strain(), kStrain, 1e-3 * kStrain);
  for (double t = 0.01 * dt + dt; t < 4.0 * kTime; t += dt) {
    ASSERT_TRUE(stepper->step(loaded, dt).accepted());
    const double grown = 1.0 - std::exp(-t * (1.0 - kShare) / kTime);
    EXPECT_NEAR(strain(), kStrain * (1.0 + kShare / (1.0 - kShare) * grown), kStrain * kShare * error_of_step(dt)) << t;
  }
}

/// Pulled to and fro by eps sin(wt), a rod bears k_s eps [(1 - s) sin + s wtau/(1 + (wtau)^2) (wtau sin + cos)], so
/// that the loss angle has tan delta = s wtau/(1 - s + (wtau)^2), and loses pi k_s eps^2 s wtau/(1 + (wtau)^2) a length
/// and cycle.
TEST(Relaxation, ACycledRodHasTheLossAngle) {
  constexpr int kSteps = 400;  // a cycle
  for (const double w_tau : {0.3, 1.0, 3.0}) {
    const Straight scene;
    const double period = 2.0 * M_PI * kTime / w_tau, dt = period / kSteps;
    Balance balance(scene.stepper(), scene.settings, dt);
    Boundary held;
    double sine = 0.0, cosine = 0.0, before = 0.0;
    const int cycles = 8;  // the first ones die out by exp(-t/tau)
    int step = 0;
    balance.run(
        cycles * period,
        [&](double to) -> const Boundary& {
          return held = scene.stretched(kStrain * std::sin(2.0 * M_PI * to / period));
        },
        [&] {
          ++step;
          const double phase = 2.0 * M_PI * step / kSteps, tension = balance.stepper().tension()[0];
          if (step <= (cycles - 1) * kSteps) {
            before = balance.sum().plastic;
            return;
          }
          sine += tension * std::sin(phase);
          cosine += tension * std::cos(phase);
        });
    ASSERT_EQ(step, cycles * kSteps) << "steps of one length";
    const double by_step = M_PI / kSteps;  // w dt/2, the error of the implicit Euler method, of the part that relaxes
    EXPECT_NEAR(cosine / sine, kShare * w_tau / (1.0 - kShare + w_tau * w_tau), 2.0 * kShare * by_step);
    const double lost =
        M_PI * scene.stiffness * kStrain * kStrain * kShare * w_tau / (1.0 + w_tau * w_tau) * scene.rod.length();
    EXPECT_NEAR(balance.sum().plastic - before, lost, 2.0 * (1.0 + w_tau) * by_step * lost);
    EXPECT_LT(std::abs(balance.gap()), balance.rounding());
  }
}

/// A cantilever whose tip is held aside.
struct Cantilever {
  Material material = braided_rope();
  RodProperties rod;
  StepSettings settings;
  RodState state;
  Boundary held;

  explicit Cantilever(const BendingLaws& law) {
    material.twisting_stiffness = material.bending_stiffness;
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, material.radius));
    set_law(rod, law);
    settings = closed_form_settings(material);
    settings.residual = 1e-10;
    settings.residual_of_tension = 0.0;
    settings.drag = 1.0;
    state = straight_state(rod);
    remember_bends(rod, &state);
    initialise_frames(&state);
    for (const int node : {0, 1, kEdges}) held.fixed_nodes.push_back({node, state.position.col(node)});
    held.fixed_twists.push_back({0, 0.0});
    held.fixed_nodes[2].position += Vec3(-0.3 * material.radius, 2.0 * material.radius, 0.0);
  }
  /// Moves the tip within a thousandth of tau, and lets it settle as long.
  std::unique_ptr<TimeStep> bent() const {
    std::unique_ptr<TimeStep> stepper = TimeStep::make(rod, state, settings);
    Boundary way = held;
    for (int i = 1; i <= 200; ++i) {
      const double part = std::min(i / 100.0, 1.0);
      way.fixed_nodes[2].position = state.position.col(kEdges) * (1.0 - part) + held.fixed_nodes[2].position * part;
      EXPECT_EQ(stepper->step(way, kTime * 1e-3 / 100.0).reason, "");
    }
    return stepper;
  }
};

/// With all moments of one share and time the shape stays, and the force at the tip falls as a moment does. The rope
/// hardly stretches.
TEST(Relaxation, ABentCantileverLosesItsShareOfTheForce) {
  const auto tip = [](const TimeStep& stepper) { return stepper.readings().reaction(kEdges); };
  const Cantilever elastic{ElasticBending()}, relaxing{ViscoelasticBending{kSolid}};
  constexpr double kStep = kTime / 50.0;
  const std::unique_ptr<TimeStep> reference = elastic.bent(), stepper = relaxing.bent();
  for (int i = 0; i < 100; ++i) ASSERT_EQ(reference->step(elastic.held, kStep).reason, "");
  const Vec3 first = tip(*reference);
  ASSERT_GT(first.norm(), 0.0);
  for (double t = kStep; t < 4.0 * kTime; t += kStep) {
    ASSERT_EQ(stepper->step(relaxing.held, kStep).reason, "");
    const double error = kShare * (error_of_step(kStep) + 2e-3);  // and the way of the tip
    EXPECT_LT((tip(*stepper) - left_after(t) * first).norm(), error * first.norm()) << t;
  }
  EXPECT_LT((stepper->state().position - reference->state().position).norm(), 1e-3 * relaxing.material.radius);
}

/// What both laws remember is saved with the state, and the next one comes to the same bits elsewhere.
TEST(Relaxation, ASavedStateRemembersIt) {
  Cantilever scene{ViscoelasticBending{kSolid}};
  set_law(scene.rod, StretchingLaws(ViscoelasticStretching{kSolid}));
  remember_stretches(scene.rod, &scene.state);
  const std::unique_ptr<TimeStep> stepper = scene.bent(),
                                  elsewhere = TimeStep::make(scene.rod, scene.state, scene.settings);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(stepper->step(scene.held, 0.1 * kTime).accepted());
  load(saved(*stepper), *elsewhere);
  EXPECT_GT(elsewhere->state().stretching_own.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(elsewhere->state().bending_own.cwiseAbs().maxCoeff(), 0.0);
  ASSERT_TRUE(elsewhere->step(scene.held, 0.1 * kTime).accepted());
  ASSERT_TRUE(stepper->step(scene.held, 0.1 * kTime).accepted());
  EXPECT_EQ(elsewhere->state().position, stepper->state().position);
  EXPECT_EQ(elsewhere->state().stretching_own, stepper->state().stretching_own);
  EXPECT_EQ(elsewhere->state().bending_own, stepper->state().bending_own);

  RodState without = scene.state;
  without.stretching_own.resize(0);
  EXPECT_THROW(require_fits(scene.rod, without), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
