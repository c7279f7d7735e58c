#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/linear_system.hpp"
#include "knot_utm/sim/step_account.hpp"

namespace knot_utm {

/// The unit vectors of a node's position, and of the spin that stands behind it in the fourth lane.
inline constexpr Lanes kAxis[3] = {{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}};
inline constexpr Lanes kSpin = {0.0, 0.0, 0.0, 1.0};

/// The interface of a force term of the time step's equation (increment.hpp). It has no base class, because no call in
/// the inner loop is virtual. Every term has add_forces, add_stiffness and account, of which kIsForceTerm makes sure,
/// and of the other functions those that it needs. A step calls them in this order:
///
///   begin(start, ...)               once a step: the state that the term kept of the last accepted step becomes the
///                                   start
///   add_forces(start, x, force)     at trial positions x: adds forces [N] in lanes 0 to 2 of every node, and torques
///                                   [N m] in lane 3 of the edge after it
///   add_stiffness(system)           adds -d(force)/dx [N/m] at the positions that were evaluated last
///   account(step, account)          for an accepted step: adds energies, work and loads (step_account.hpp)
///   commit(...)                     stores the state of the accepted step in the term
///
/// A step that is not accepted is never committed, so `begin` always starts from the last accepted one.
template <int D, typename Term>
constexpr bool kIsForceTerm = std::is_void_v<decltype(std::declval<Term&>().add_forces(
    std::declval<const StepStart&>(), std::declval<const Points&>(), std::declval<std::vector<Lanes>&>()))>&&
    std::is_void_v<decltype(std::declval<Term&>().add_stiffness(std::declval<LinearSystem<D>&>()))>&& std::is_void_v<
        decltype(std::declval<const Term&>().account(std::declval<const SolvedStep&>(), std::declval<StepAccount&>()))>;

}  // namespace knot_utm
