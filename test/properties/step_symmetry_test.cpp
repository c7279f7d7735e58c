// A few time steps of a random coil that touches itself: what no choice of frame, end or units may change.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>

#include "knot_utm/rod/rod.hpp"
#include "properties/random.hpp"

namespace knot_utm::properties {
namespace {

struct Kind {
  bool twist;
  double couple = 0.0;  // of friction at the surface
};

class StepSymmetry : public testing::TestWithParam<Kind> {
 protected:
  /// Checks a property of random scenes and what came of them.
  static void hold(const std::function<void(const Scene&, const Outcome&)>& property) {
    rc::detail::checkGTest([&] {
      const std::vector<int> numbers = random_numbers(RandomScene::kNumbers);
      Scene scene = RandomScene(numbers, GetParam().twist).scene();
      scene.settings.friction_couple = GetParam().couple;
      const Outcome outcome = run(scene);
      // A step that only just converges, after many turns about a kink, may do so later after rounding.
      RC_PRE(outcome.accepted && 2 * outcome.most_iterations <= scene.settings.max_iterations);
      property(scene, outcome);
    });
  }
};

/// `then` is what came of the scene after `motion`, its length scaled by `length` and its time by `time`.
void expect_moved(const Scene& scene, const Outcome& now, const Outcome& then, const Motion& motion,
                  Units units = {1, 1, 1}) {
  RC_ASSERT(then.accepted);
  const double error = newton_error(scene), h = scene.rod.material.radius;
  const double least_edge = scene.rod.rest_length.minCoeff();
  const Points position = then.state.position / units.length, velocity = then.state.velocity / units.speed();
  near((position - motion.of(now.state.position)).colwise().norm().maxCoeff(), error, "position");
  // Of both ends of the step.
  near((velocity - motion.turn * now.state.velocity).colwise().norm().maxCoeff(), 2.0 * error / scene.dt, "velocity");
  // k_s (|e|/l - 1), of both ends of the edge.
  near((then.tension / units.force - now.tension).lpNorm<Eigen::Infinity>(),
       2.0 * error * scene.rod.material.stretching_stiffness / least_edge, "tension");
  // Frames turn with the edges, and about them by as much as the residual, which is a torque over h, turns I/dt^2 =
  // m h^2/2 dt^2.
  if (now.twist.size() > 0)
    near((then.twist - motion.handedness() * now.twist).lpNorm<Eigen::Infinity>(),
         4.0 * error / least_edge + 4.0 * error / h, "twist");
}

TEST_P(StepSymmetry, RigidMotion) {
  hold([](const Scene& scene, const Outcome& outcome) {
    const Motion motion = random_motion(0.1);
    expect_moved(scene, outcome, run(moved(scene, motion)), motion);
  });
}

TEST_P(StepSymmetry, MirrorTurnsTheTwistAround) {
  hold([](const Scene& scene, const Outcome& outcome) {
    Motion motion = random_motion(0.1);
    motion.turn.col(0) *= -1.0;
    expect_moved(scene, outcome, run(moved(scene, motion)), motion);
  });
}

/// Signs are exact.
TEST_P(StepSymmetry, MirrorOfACoordinateGivesTheSameBits) {
  if (GetParam().twist) GTEST_SKIP() << "a mirrored frame begins with another director";
  hold([](const Scene& scene, const Outcome& outcome) {
    Motion motion;
    const int axis = *rc::gen::inRange(0, 3);
    motion.turn(axis, axis) = -1.0;
    const Outcome then = run(moved(scene, motion));
    RC_ASSERT(then.accepted);
    RC_ASSERT(then.state.position == motion.of(outcome.state.position));
    RC_ASSERT(then.iterations == outcome.iterations);
  });
}

TEST_P(StepSymmetry, Reversal) {
  hold([](const Scene& scene, const Outcome& outcome) {
    Outcome then = run(reversed(scene));
    if (then.accepted) {
      then.state.position = then.state.position.rowwise().reverse().eval();
      then.state.velocity = then.state.velocity.rowwise().reverse().eval();
      then.tension = then.tension.reverse().eval();
      then.twist = then.twist.reverse().eval();
    }
    expect_moved(scene, outcome, then, {});
  });
}

TEST_P(StepSymmetry, OtherUnits) {
  hold([](const Scene& scene, const Outcome& outcome) {
    const Units units = random_units();
    expect_moved(scene, outcome, run(scaled(scene, units)), {}, units);
  });
}

/// Powers of two change no digit.
TEST_P(StepSymmetry, UnitsThatArePowersOfTwoGiveTheSameBits) {
  hold([](const Scene& scene, const Outcome& now) {
    const Units units = random_powers_of_two();
    const Outcome then = run(scaled(scene, units));
    RC_ASSERT(then.accepted);
    RC_ASSERT(then.iterations == now.iterations);
    RC_ASSERT(then.state.position == units.length * now.state.position);
    RC_ASSERT(then.state.velocity == units.speed() * now.state.velocity);
    RC_ASSERT(then.state.twist == now.state.twist);
    RC_ASSERT(then.tension == units.force * now.tension);
    RC_ASSERT(then.reaction == units.force * now.reaction);
    RC_ASSERT(then.energies.stretching == units.energy() * now.energies.stretching);
    RC_ASSERT(then.energies.bending == units.energy() * now.energies.bending);
    RC_ASSERT(then.energies.twisting == units.energy() * now.energies.twisting);
    RC_ASSERT(then.energies.contact == units.energy() * now.energies.contact);
    RC_ASSERT(then.energies.kinetic == units.energy() * now.energies.kinetic);
    RC_ASSERT(then.contact.touching == now.contact.touching);
    RC_ASSERT(then.contact.normal_force == units.force * now.contact.normal_force);
    RC_ASSERT(then.work.boundary == units.energy() * now.work.boundary);
    RC_ASSERT(then.work.friction == units.energy() * now.work.friction);
    RC_ASSERT(then.work.drag == units.energy() * now.work.drag);
  });
}

/// The scenes are what they are meant to be: strands that press on one another, and slide.
TEST_P(StepSymmetry, ScenesTouchAndSlide) {
  int scenes = 0, touching = 0, sliding = 0;
  hold([&](const Scene&, const Outcome& outcome) {
    ++scenes;
    touching += outcome.contact.touching > 10 ? 1 : 0;
    sliding += outcome.work.friction > 0.0 ? 1 : 0;
  });
  EXPECT_GT(touching, scenes / 2);
  EXPECT_GT(sliding, scenes / 2);
}

INSTANTIATE_TEST_SUITE_P(Laws, StepSymmetry, testing::Values(Kind{false}, Kind{true}, Kind{true, 1.0}),
                         [](const auto& kind) {
                           return std::string(kind.param.twist ? "Twist" : "Plain") +
                                  (kind.param.couple > 0.0 ? "Rolling" : "");
                         });

}  // namespace
}  // namespace knot_utm::properties
