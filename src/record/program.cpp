#include "knot_utm/record/program.hpp"

#include <array>
#include <utility>

namespace knot_utm {
namespace {

constexpr std::array<std::pair<Phase, const char*>, 12> kPhaseNames{{{Phase::kIdle, "idle"},
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

const char* phase_name(Phase phase) {
  for (const auto& [value, name] : kPhaseNames) {
    if (value == phase) return name;
  }
  return "idle";
}

std::optional<Phase> phase_named(const std::string& name) {
  for (const auto& [value, text] : kPhaseNames) {
    if (name == text) return value;
  }
  return std::nullopt;
}

}  // namespace knot_utm
