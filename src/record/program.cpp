#include "knot_utm/record/program.hpp"

namespace knot_utm {

std::optional<int> step_called(const Program& program, const std::string& name) {
  std::optional<int> found;
  for (std::size_t i = 0; i < program.size(); ++i) {
    if (name == std::to_string(i)) return static_cast<int>(i);
    if (name != phase_name(program[i].phase)) continue;
    if (found) return std::nullopt;
    found = static_cast<int>(i);
  }
  return found;
}

}  // namespace knot_utm
