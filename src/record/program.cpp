#include "knot_utm/record/program.hpp"

#include "knot_utm/record/choice_names.hpp"

namespace knot_utm {
namespace {

constexpr ChoiceNames<Phase, 12> kPhaseNames{{{Phase::kIdle, "idle"},
                                              {Phase::kTie, "tie"},
                                              {Phase::kRelease, "release"},
                                              {Phase::kMount, "mount"},
                                              {Phase::kPreload, "preload"},
                                              {Phase::kBalance, "balance"},
                                              {Phase::kPull, "pull"},
                                              {Phase::kHold, "hold"},
                                              {Phase::kCycle, "cycle"},
                                              {Phase::kReturn, "return"},
                                              {Phase::kFollow, "follow"},
                                              {Phase::kDone, "done"}}};

}  // namespace

const char* phase_name(Phase phase) { return name_of(kPhaseNames, phase); }

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

std::optional<Phase> phase_named(const std::string& name) { return choice_named(kPhaseNames, name); }

std::vector<std::string> step_names() {
  std::vector<std::string> names;
  for (const auto& [phase, name] : kPhaseNames)
    if (phase != Phase::kIdle && phase != Phase::kDone) names.emplace_back(name);
  return names;
}

}  // namespace knot_utm
