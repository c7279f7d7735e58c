#pragma once

/// The face of a force term of the time step's equation (increment.hpp). It has no base class: no call in the inner
/// loop is virtual, and a term offers only what it has. In the order in which one step uses them:
///
///   begin(start, ...)               once a step: what the term remembers of the last accepted step becomes its start
///   add_forces(start, x, force)     at trial positions x: forces [N] in lanes 0 to 2 of every node, torques [N m] in
///                                   lane 3 of the edge behind it
///   add_stiffness(..., matrix)      -d(force)/dx [N/m] at the positions that were evaluated last
///   account(step, account)          of an accepted step: energies, work and loads (step_account.hpp)
///   commit(...)                     the accepted step becomes what the term remembers
///
/// A step that is not accepted is never committed, so `begin` always finds the last accepted one.
