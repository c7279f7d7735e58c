#pragma once

#include <algorithm>
#include <cmath>

namespace knot_utm {

struct NewtonOptions {
  int max_iterations = 20;
  double largest_factor = 1.0;  ///< largest damping factor of a change
  bool abandons_early = false;  ///< ends where the residual hardly falls
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

/// Newton's method for a system that has the functions
///
///   double residual()      evaluates the system at the present unknowns and returns the norm of its residual
///   double tolerance()     the norm that is small enough
///   bool solve()           assembles and factors the Jacobian and solves for the change; false where it is singular
///   void move(factor)      moves the unknowns by `factor` times the change, or by less where the system limits it
///   bool stands_still()    the last change was a whole one and is negligible, so that no better point lies nearby
///
/// A prediction within the tolerance is still solved once, because the imbalance that the tolerance allows would let
/// the rod drift on from step to step. Only a prediction far below the tolerance is accepted as it is. There is no line
/// search, because the energy is no guide along stiff, nearly inextensible rods. The caller limits the size of a step,
/// and halves the step where this method does not converge.
///
/// If, after the first few iterations, the residual has not halved over two iterations, the iterates cycle between two
/// sides of a kink (a foot that jumps, a contact that sticks and slips). Halving the damping factor ends the cycle, but
/// takes iterations. With `abandons_early` the solve is ended instead, once a residual well above its tolerance has
/// hardly fallen over one and over two iterations, because a shorter step costs less.
///
/// Source: Nocedal, Wright 2006 (damping); Deuflhard 2004 (monitor of convergence).
template <typename System>
NewtonSummary newton(System& system, const NewtonOptions& options) {
  constexpr int kUndamped = 5;
  constexpr double kUnsolved = 1e-3;
  constexpr int kFirst = 4;  // iterations that are not judged
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
