#include "knot_utm/study/find_margin.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/specimen_centreline.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/machine/tied_loop.hpp"
#include "knot_utm/record/loading_steps.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {

namespace {

constexpr double kPulledPart = 0.2;  // of the first knot distance

/// Up to the first step that pulls, and of that a part.
Program beginning(const Program& program, double extension) {
  Program out;
  for (const ProgramStep& step : program) {
    if (pulls(step->phase())) {
      PullStep pull;
      pull.speed = step->speed;
      pull.until.extension = extension;
      out.emplace_back(pull);
      break;
    }
    out.push_back(step);
  }
  return out;
}

/// What became of one short test.
enum class Outcome { kHeld, kOpened, kFailed, kInterrupted };

struct ShortTests {
  const Method& method;
  const std::function<bool()>& interrupted;

  Outcome run(double friction, double preload) const {
    Method now = method;
    now.physics.accuracy = Accuracy::kDraft;
    now.material.friction_coefficient *= friction;
    now.specimen.preload = preload * tying_load(method.specimen, method.material);
    TestingMachine bench(now.specimen, now.material, now.machine, now.physics);
    ProgramRunner::Limits limits;
    limits.load = INFINITY;
    limits.travel = now.machine.travel;
    ProgramRunner program(beginning(now.program, kPulledPart * now.specimen.knot_distance),
                          now.machine.load_cell.sampling_rate, bench.longest_step(), limits);
    std::vector<Sample> samples;
    run_test(
        bench, program,
        [&](const Command&, const Sample&) {
          samples.insert(samples.end(), bench.substeps().begin(), bench.substeps().end());
        },
        interrupted);
    if (!program.ended()) return Outcome::kInterrupted;
    if (program.ended_by() == EndedBy::kUntangled) return Outcome::kOpened;
    if (program.ended_by() == EndedBy::kSolver) return Outcome::kFailed;
    const Results results = analyse(samples, samples, program.ended_by(), rollers_hold(now.specimen, now.machine),
                                    hung_weight(now.specimen, now.material), marks_of(now.specimen, now.program));
    return results.motion_pattern == MotionPattern::kUntangling ? Outcome::kOpened : Outcome::kHeld;
  }
};

}  // namespace

double fraction_until_it_opens(const std::function<bool(double)>& opens) {
  constexpr int kBisections = 3;
  double open = 1.0 - Margin::kMost, holds = 1.0;
  if (!opens(open)) return Margin::kMost;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = std::sqrt(open * holds);
    (opens(middle) ? open : holds) = middle;
  }
  return 1.0 - std::sqrt(open * holds);
}

Margin find_margin(const Method& method, const std::function<bool()>& interrupted) {
  const ShortTests tests{method, interrupted};
  Margin out;
  Outcome worst = tests.run(1.0, 1.0);
  if (worst == Outcome::kOpened) {
    out.reason =
        "the runs for the margin are made at accuracy draft, at which the knot opens even with all of its friction and "
        "pre-load";
    return out;
  }
  const auto opens = [&](double friction, double preload) {
    if (worst != Outcome::kHeld) return true;  // nothing more is to be learnt
    const Outcome outcome = tests.run(friction, preload);
    if (outcome == Outcome::kFailed || outcome == Outcome::kInterrupted) worst = outcome;
    return outcome != Outcome::kHeld;
  };
  const double friction = fraction_until_it_opens([&](double factor) { return opens(factor, 1.0); });
  const double preload = fraction_until_it_opens([&](double factor) { return opens(1.0, factor); });
  if (worst == Outcome::kInterrupted) {
    out.reason = "the runs for the margin were interrupted";
  } else if (worst == Outcome::kFailed) {
    out.reason = "the physics gave up in one of the runs for the margin";
  } else {
    out.friction = friction;
    out.preload = preload;
  }
  return out;
}

}  // namespace knot_utm
