#pragma once

#include <vector>

#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/linear_system.hpp"
#include "knot_utm/sim/step_account.hpp"

namespace knot_utm {

/// The unit vectors of a node's position, and of the spin that stands behind it in the fourth lane.
inline constexpr Lanes kAxis[3] = {{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}};
inline constexpr Lanes kSpin = {0.0, 0.0, 0.0, 1.0};

/// A force term of the time step's equation, which lists its terms in one place (Equation::for_each_term). A step calls
/// their functions in this order:
///
///   begin(start, predicts)          once a step: the state that the term kept of the last accepted step becomes the
///                                   start; `predicts` as Increment has it
///   add_forces(start, x, force)     at trial positions x: adds forces [N] in lanes 0 to 2 of every node, and torques
///                                   [N m] in lane 3 of the edge after it
///   add_stiffness(system)           adds -d(force)/dx [N/m] at the positions that were evaluated last
///   predict(change, factor)         after a linear solve: predicts what the next stiffness uses, after `factor` times
///                                   the change of the unknowns
///   account(step, account)          for an accepted step: adds energies, work and loads (step_account.hpp)
///   commit(step)                    stores the state of the accepted step in the term
///   part(edge), take_lengths()      between steps: the rod is cut at an edge, or has other lengths
///
/// A term has its own add_forces, add_stiffness and account, and of the others those that it needs; these here stand
/// for the rest. No call is virtual, because they are made in the inner loop. A step that is not accepted is never
/// committed, so `begin` always starts from the last accepted one.
struct ForceTerm {
  void begin(const StepStart&, bool) {}
  void predict(const std::vector<Lanes>&, double) {}
  void commit(const SolvedStep&) {}
  void part(int) {}
  void take_lengths() {}
};

}  // namespace knot_utm
