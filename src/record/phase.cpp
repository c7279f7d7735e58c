#include "knot_utm/record/phase.hpp"

#include <array>

namespace knot_utm {
namespace {

constexpr bool kYes = true, kNo = false;

// clang-format off
constexpr std::array<PhaseTraits, 12> kPhases{{
    //                              step  prepares forms ends  moves pulls can_break
    {Phase::kIdle,     "idle",      kNo,  kYes,    kNo,  kNo,  kNo,  kNo,  kNo},
    {Phase::kTie,      "tie",       kYes, kYes,    kYes, kYes, kNo,  kNo,  kNo},
    {Phase::kRelease,  "release",   kYes, kYes,    kYes, kYes, kNo,  kNo,  kNo},
    {Phase::kMount,    "mount",     kYes, kYes,    kNo,  kYes, kYes, kNo,  kNo},
    {Phase::kPreload,  "preload",   kYes, kYes,    kNo,  kNo,  kYes, kNo,  kYes},
    {Phase::kBalance,  "balance",   kYes, kYes,    kNo,  kNo,  kNo,  kNo,  kNo},
    {Phase::kPull,     "pull",      kYes, kNo,     kNo,  kNo,  kYes, kYes, kYes},
    {Phase::kHold,     "hold",      kYes, kNo,     kNo,  kNo,  kNo,  kNo,  kYes},
    {Phase::kCycle,    "cycle",     kYes, kNo,     kNo,  kNo,  kYes, kYes, kYes},
    {Phase::kReturn,   "return",    kYes, kNo,     kNo,  kNo,  kYes, kNo,  kNo},
    {Phase::kFollow,   "follow",    kYes, kNo,     kNo,  kNo,  kYes, kYes, kNo},
    {Phase::kDone,     "done",      kNo,  kYes,    kNo,  kNo,  kNo,  kNo,  kNo},
}};
// clang-format on

constexpr bool stand_in_order() {
  for (std::size_t i = 0; i < kPhases.size(); ++i)
    if (static_cast<std::size_t>(kPhases[i].phase) != i) return false;
  return true;
}
static_assert(stand_in_order());

}  // namespace

const PhaseTraits& traits_of(Phase phase) {
  const std::size_t place = static_cast<std::size_t>(phase);
  return kPhases[place < kPhases.size() ? place : 0];
}

std::optional<Phase> phase_named(const std::string& name) {
  for (const PhaseTraits& traits : kPhases)
    if (name == traits.name) return traits.phase;
  return std::nullopt;
}

std::vector<PhaseTraits> all_phases() { return {kPhases.begin(), kPhases.end()}; }

std::vector<std::string> step_names() {
  std::vector<std::string> names;
  for (const PhaseTraits& traits : kPhases)
    if (traits.is_step) names.emplace_back(traits.name);
  return names;
}

}  // namespace knot_utm
