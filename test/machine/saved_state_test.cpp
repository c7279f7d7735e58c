// A test that is saved and goes on elsewhere is the same test, to the bit.

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "knot_utm/contact/friction.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "machine/overhand_specimen.hpp"
#include "program/programs.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

using programs::pull;
using programs::step;

constexpr std::size_t kToTheEnd = std::numeric_limits<std::size_t>::max();

/// What is compared: all fields by their bits, as not-a-number is none of its equals.
std::string bits(const std::vector<Sample>& samples, std::size_t i) {
  std::string out;
  Archive::to(out).save(samples[i]);
  return out;
}

/// A bench, which is saved, its program, and what the bench answered since.
struct WholeTest {
  TestingMachine bench;
  ProgramRunner program;
  std::vector<Sample> substeps;
  std::vector<double> tension;

  std::string saved() {
    Archive archive("test");
    archive(bench);
    return archive.bytes();
  }
  void load(const std::string& bytes) {
    Archive archive("test", bytes, "here");
    archive(bench);
    archive.end();
  }
  /// Calls `before(n)` before each command.
  template <typename Before>
  void go_on(std::size_t commands, Before before) {
    for (std::size_t n = 0; n < commands && !program.ended(); ++n) {
      before(n);
      const Sample sample = bench.respond(program.last());
      substeps.insert(substeps.end(), bench.substeps().begin(), bench.substeps().end());
      program.next(sample);
    }
    const Eigen::VectorXd now = bench.tension();
    tension.assign(now.data(), now.data() + now.size());
  }
};

/// A whole test, and how many commands lie between two moments at which it is saved.
struct Scene {
  std::string name;
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;
  PhysicsOptions physics;
  Program program;
  std::size_t every;

  WholeTest begin() const {
    TestingMachine bench(specimen, material, machine, physics);
    const double period = bench.longest_step();
    return {std::move(bench), ProgramRunner(program, machine.load_cell.sampling_rate, period, {}), {}, {}};
  }
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

Scene straight() {
  Scene out{"straight", {}, nylon(), {}, {}, {BalanceStep(), pull(0.01)}, 2};
  out.specimen.knot = knot_named("straight");
  out.specimen.length = 0.25;
  out.specimen.edge_length = 0.005;
  out.machine.grips = GripKind::kClamps;
  out.machine.load_cell.noise = 3.0;
  out.physics.accuracy = Accuracy::kDraft;
  return out;
}

/// Every way in which the crosshead is led.
Scene programmed_on_a_compliant_frame() {
  Scene out = straight();
  out.name = "programmedOnACompliantFrame";
  out.machine.stiffness = 1e5;
  PullStep by_load = pull(0.01);
  auto held = step<HoldStep>(0.0033, 1.0);
  CycleStep cycle;
  by_load.load_rate = 100.0;
  by_load.until.load = 300.0;
  held.hold_load = true;
  cycle.extension = fields::LowHigh{0.0, 0.002};
  cycle.cycles = 2;
  out.program = {by_load, held, cycle, ReturnStep()};
  return out;
}

Scene broken() {
  Scene out = straight();
  out.name = "broken";
  out.material.breaking_force = 1000.0;
  out.every = 1;
  return out;
}

Scene overhand(const std::string& name, const char* friction, double couple = 0.0) {
  Scene out{name, {}, pink_vps(), {}, {}, {step<HoldStep>(0.0033, 1.0), BalanceStep(), pull(0.02)}, 4};
  out.specimen = overhand_specimen(0.4, 0.15, 0.006);
  out.material.friction_couple = couple;
  out.machine.grips = GripKind::kClamps;
  out.machine.load_cell.noise = 0.01;
  out.physics.accuracy = Accuracy::kDraft;
  out.physics.twist = TwistMode::kOn;
  out.physics.friction.law = law_named(friction);
  return out;
}

/// Tied, released, put onto rollers and pulled.
Scene loop(const std::string& name) {
  Scene out{name, {}, polypropylene(),
            {},   {}, {TieStep(), step<ReleaseStep>(0.0033, 1.0), MountStep(), BalanceStep(), pull(0.002)},
            7};
  out.specimen.preload = 20.0;
  out.specimen.to_be_tied = true;
  out.specimen.edge_length = 0.005;
  out.machine.roller_friction = 0.1;
  out.physics.accuracy = Accuracy::kDraft;
  return out;
}

Scene with_fibres(Scene of) {
  of.material.bending.law = static_cast<BendingLaw>(2);
  of.material.bending.set("friction_moment", 0.06);
  return of;
}

Scene rolling(Scene of) {
  of.physics.twist = TwistMode::kOn;
  of.material.friction_couple = 1.0;
  of.material.rolling_resistance = 0.1;
  return of;
}

class SavedState : public testing::TestWithParam<Scene> {};

/// From each saved state another bench goes on to where the next one was saved, and must have the same bytes there: so
/// it goes on as the one that saved it. From the first one it goes on to the end.
TEST_P(SavedState, GoesOnToTheSameBits) {
  WholeTest unbroken = GetParam().begin();
  unbroken.go_on(kToTheEnd, [](std::size_t) {});
  ASSERT_NE(unbroken.program.ended_by(), EndedBy::kSolver) << unbroken.program.reason();

  // Saving leaves a run as it was.
  WholeTest saved = GetParam().begin();
  std::vector<std::string> states;
  std::vector<ProgramRunner> programs;
  std::vector<std::size_t> answered;  // substeps before each
  const std::size_t every = GetParam().every;
  saved.go_on(kToTheEnd, [&](std::size_t n) {
    if (n % every != 0) return;
    states.push_back(saved.saved());
    programs.push_back(saved.program);
    answered.push_back(saved.substeps.size());
  });
  ASSERT_GT(states.size(), 3U);
  const auto answers_as_unbroken = [&](const WholeTest& run, std::size_t from) {
    for (std::size_t i = 0; i < run.substeps.size(); ++i) {
      ASSERT_EQ(bits(run.substeps, i), bits(unbroken.substeps, from + i))
          << "at t = " << run.substeps[i].time << " s, saved after " << from;
    }
  };
  const auto ends_as_unbroken = [&](const WholeTest& run, std::size_t from) {
    ASSERT_EQ(run.substeps.size(), unbroken.substeps.size() - from);
    answers_as_unbroken(run, from);
    EXPECT_EQ(run.bench.state().position, unbroken.bench.state().position);
    EXPECT_EQ(run.bench.state().velocity, unbroken.bench.state().velocity);
    EXPECT_EQ(run.bench.state().twist, unbroken.bench.state().twist);
    ASSERT_EQ(run.tension.size(), unbroken.tension.size());
    EXPECT_EQ(std::memcmp(run.tension.data(), unbroken.tension.data(), run.tension.size() * sizeof(double)), 0);
    EXPECT_EQ(run.program.ended_by(), unbroken.program.ended_by());
  };
  ends_as_unbroken(saved, 0);

  std::vector<std::unique_ptr<char[]>> shifted;  // what is new must not depend on where it lies in memory
  for (std::size_t i = 0; i < states.size() && !HasFailure(); ++i) {
    WholeTest resumed = GetParam().begin();
    shifted.push_back(std::make_unique<char[]>(16 * (i % 5) + 8));
    resumed.load(states[i]);
    resumed.program = programs[i];
    EXPECT_EQ(resumed.saved(), states[i]);
    const bool to_the_end = i == 0 || i + 1 == states.size();
    resumed.go_on(to_the_end ? kToTheEnd : every, [](std::size_t) {});
    if (to_the_end) {
      ends_as_unbroken(resumed, answered[i]);
    } else {
      answers_as_unbroken(resumed, answered[i]);
      EXPECT_EQ(resumed.saved(), states[i + 1]) << "saved after " << answered[i];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SavedState,
                         testing::Values(programmed_on_a_compliant_frame(), broken(),
                                         overhand("overhandWithTwist", "memory"),
                                         overhand("overhandThatRolls", "memory", 1.0), loop("loop"),
                                         with_fibres(loop("loopWithFibres")), rolling(loop("rolling"))),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace knot_utm
