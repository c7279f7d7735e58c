#pragma once

#include <algorithm>
#include <cmath>

namespace knot_utm {

struct NewtonOptions {
  int max_iterations = 20;
  double largest_factor = 1.0;  ///< of a change that is taken
  bool abandons_early = false;  ///< where the residual does not fall, instead of taking smaller factors
};

/// How a Newton solve went. Starts as a failure; only a residual within tolerance makes it a success.
struct NewtonSummary {
  enum class End { kNotRun, kConverged, kIterationLimit, kAbandonedEarly, kSingular, kNotFinite };
  End end = End::kNotRun;
  int iterations = 0;      ///< linear solves
  double residual = 0.0;   ///< at the end, as the system measures it [N]
  double tolerance = 0.0;  ///< what it was compared with [N]

  bool converged() const { return end == End::kConverged; }
  const char* reason() const {
    switch (end) {
      case End::kConverged:
        return "converged";
      case End::kIterationLimit:
        return "the residual did not fall below its tolerance within the iteration limit";
      case End::kAbandonedEarly:
        return "the residual did not fall";
      case End::kSingular:
        return "the Jacobian is singular";
      case End::kNotFinite:
        return "the residual is not a number";
      case End::kNotRun:
        break;
    }
    return "not run";
  }
};

/// Newton's method for a system that offers
///   double residual()     evaluates at the current unknowns, returns the residual's size
///   double tolerance()    what that may be
///   bool solve()          assembles and factors the Jacobian, solves for the change; false where singular
///   void move(factor)      takes `factor` times the change, capped as the system sees fit
///   bool stands_still()   the whole of the last change was taken and is nothing: there is no better place next to here
/// A prediction that happens to lie within the tolerance is solved once all the same: what the tolerance leaves would
/// otherwise drift on, step after step, and never come to rest. Only far below it is nothing left to do.
/// There is no line search: along stiff, nearly inextensible rods the energy is no guide. Whoever calls guards the
/// step by its size and halves it where this does not converge. Where the residual has not halved over two iterations
/// after the first few, the iterates run in a cycle between two sides of a kink (a foot that jumps, a contact that
/// sticks and slips): half the change breaks it. That takes iterations: where a shorter step is the cheaper way out,
/// the solve is given up instead, once a residual well above its tolerance has hardly fallen over one iteration nor
/// over two.
template <typename System>
NewtonSummary newton(System& system, const NewtonOptions& options) {
  constexpr int kUndamped = 5;
  constexpr double kUnsolved = 1e-3;
  constexpr int kFirst = 4;  // iterations that are free to wander
  constexpr double kHardly = 0.7, kWellAbove = 3.0;
  NewtonSummary summary;
  double last = 0.0, before = 0.0, factor = options.largest_factor;
  for (;;) {
    summary.residual = system.residual();
    summary.tolerance = system.tolerance();
    if (!std::isfinite(summary.residual)) {
      summary.end = NewtonSummary::End::kNotFinite;
      return summary;
    }
    if (summary.residual <= (summary.iterations > 0 ? 1.0 : kUnsolved) * summary.tolerance ||
        (summary.iterations > 0 && system.stands_still())) {
      summary.end = NewtonSummary::End::kConverged;
      return summary;
    }
    if (summary.iterations == options.max_iterations) {
      summary.end = NewtonSummary::End::kIterationLimit;
      return summary;
    }
    const bool falls = summary.residual <= kHardly * std::max(last, before);
    if (options.abandons_early && summary.iterations >= kFirst && !falls &&
        summary.residual > kWellAbove * summary.tolerance) {
      summary.end = NewtonSummary::End::kAbandonedEarly;
      return summary;
    }
    if (!system.solve()) {
      summary.end = NewtonSummary::End::kSingular;
      return summary;
    }
    const bool cycles = summary.iterations >= kUndamped && summary.residual > 0.5 * before;
    factor = cycles ? std::max(0.5 * factor, 1.0 / 16.0) : std::min(2.0 * factor, options.largest_factor);
    system.move(factor);
    before = last;
    last = summary.residual;
    ++summary.iterations;
  }
}

}  // namespace knot_utm
