#include "knot_utm/program/program.hpp"

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

const Program& all_steps() {
  static const Program all{
      TieStep(),  ReleaseStep(), MountStep(),  PreloadStep(), BalanceStep(), PullStep(),
      HoldStep(), CycleStep(),   ReturnStep(), FollowStep(),  TwistStep(),
  };
  return all;
}

std::vector<std::string> step_names() {
  std::vector<std::string> names;
  for (const ProgramStep& step : all_steps()) names.emplace_back(step->name());
  return names;
}

std::optional<ProgramStep> step_named(const std::string& name) {
  for (const ProgramStep& step : all_steps())
    if (name == step->name()) return step;
  return std::nullopt;
}

std::optional<int> step_called(const Program& program, const std::string& name) {
  std::optional<int> found;
  for (std::size_t i = 0; i < program.size(); ++i) {
    if (name == std::to_string(i)) return static_cast<int>(i);
    if (name != program[i]->name()) continue;
    if (found) return std::nullopt;
    found = static_cast<int>(i);
  }
  return found;
}

std::string StepPlace::key() const { return "program." + std::to_string(index) + "." + program[index]->name(); }

void StepPlace::misplaced(const std::string& why) const {
  const std::string entry = "program." + std::to_string(index), name = program[index]->name();
  throw InvalidInput::sentence(entry, entry + ": " + name + " " + why);
}

void StepPlace::needs(const std::string& knots) const {
  if (!knots.empty()) misplaced("needs specimen.knot: " + knots + "; begin the program with another step");
}

}  // namespace knot_utm
