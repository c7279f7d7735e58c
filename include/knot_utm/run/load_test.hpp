#pragma once

#include <functional>
#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/program/program_runner.hpp"

namespace knot_utm {

/// load_method, after which the specification has been checked, and the records that the program follows have been
/// read. `tell` receives a line where not all of a record is followed. Throws InvalidInput.
Method load_test(const std::string& file, const std::vector<std::string>& overrides = {},
                 const std::function<void(const std::string& line)>& tell = nullptr,
                 const std::string& option = "--set");

/// The runner of the method's program, with the limits at which the machine ends a test. Reads records unless they have
/// been read. `longest_step`: of the simulation [s]. Throws InvalidInput where a record cannot be followed.
ProgramRunner make_program(const Method& method, double longest_step);

}  // namespace knot_utm
