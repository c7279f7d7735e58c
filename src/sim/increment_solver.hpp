#pragma once

#include "increment.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

/// Solves the increment of a step in one of the ways of `SolveStrategy` (time_step.hpp).
///
/// Each of them makes its own `Increment`, so that all of them begin at the prediction.
template <int D>
class IncrementSolver {
 public:
  using TheEquation = Equation<D>;
  using TheIncrement = Increment<D>;

  IncrementSolver(TheEquation& equation, const StepStart& start) : equation_(equation), start_(start) {}

  /// Solves in the given way. The equation is left at the last trial, and `worst` is its largest residual.
  NewtonSummary solve(SolveStrategy strategy, WorstResidual& worst) {
    NewtonSummary out = strategy == SolveStrategy::kSecants
                            ? by_secants()
                            : by_tangents(strategy == SolveStrategy::kTangentsAbandonedEarly);
    worst = worst_;
    return out;
  }

 private:
  static constexpr int kTurns = 3;                 // largest number of rounds of secants and tangents
  static constexpr double kFactorOfSecants = 0.5;  // damping factor of the secants after the first round has failed

  /// The system that Newton's method solves: an increment with one linearisation of friction.
  struct System {
    TheIncrement& increment;
    Linearisation of_friction;

    double residual() { return increment.residual(); }
    double tolerance() const { return increment.tolerance(); }
    bool solve() { return increment.solve(of_friction); }
    void move(double factor) { increment.move(factor); }
    bool stands_still() const { return increment.stands_still(); }
  };

  NewtonSummary run(TheIncrement& increment, Linearisation of_friction, const NewtonOptions& options) {
    System system{increment, of_friction};
    NewtonSummary out = newton(system, options);
    worst_ = increment.worst_residual();
    return out;
  }

  NewtonSummary by_tangents(bool abandons_early) {
    TheIncrement increment(equation_, start_, abandons_early);
    return run(increment, Linearisation::kTangent, {equation_.settings.max_iterations, 1.0, abandons_early});
  }

  /// Secants approach the solution slowly from far away, but stay on one side of every kink of friction. From there
  /// tangents find it in few iterations. Where full changes make the iterates oscillate, halved ones may converge.
  NewtonSummary by_secants() {
    NewtonSummary out = by_turns(1.0, 1);
    if (out.converged()) return out;
    const int before = out.iterations;
    out = by_turns(kFactorOfSecants, kTurns);
    out.iterations += before;
    return out;
  }

  /// Up to `turns` rounds, each of secants with the damping factor `factor` and then of tangents.
  NewtonSummary by_turns(double factor, int turns) {
    TheIncrement increment(equation_, start_, false);
    NewtonSummary out;
    for (int turn = 0; turn < 2 * turns; ++turn) {
      const bool secants = turn % 2 == 0;
      const int before = out.iterations;
      out = run(increment, secants ? Linearisation::kSecant : Linearisation::kTangent,
                {equation_.settings.max_iterations, secants ? factor : 1.0});
      out.iterations += before;
      if (out.end != NewtonSummary::End::kIterationLimit) break;
    }
    return out;
  }

  TheEquation& equation_;
  const StepStart& start_;
  WorstResidual worst_;
};

}  // namespace knot_utm
