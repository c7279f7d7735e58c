#pragma once

#include <string>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/study/beginning.hpp"

namespace knot_utm {

/// Brings machine and program, which have just been made from `method`, to the state in which the run in `folder`
/// stopped before a step of its program. Both must have the same specimen, material, machine and physics, and their
/// programs must give the same commands up to that step. Throws InvalidInput (key "--begin-with") where there is no
/// such run, where it does not suit the method, or where the new run would write over it in `out`.
Beginning begin_with_earlier(const std::string& folder, const std::string& out, const Method& method,
                             TestingMachine& bench, ProgramRunner& program);

}  // namespace knot_utm
