#include "knot_utm/record/ended_by.hpp"

namespace knot_utm {
namespace {

// In the order of the enumerations.
constexpr const char* kEndNames[] = {"not yet", "break",   "extension", "load",      "travel",      "operator",
                                     "solver",  "program", "time",      "untangled", "interrupted", "plateau"};
constexpr const char* kBreakPlaceNames[] = {"none", "strand", "knot", "grip"};

}  // namespace

const char* break_place_name(BreakPlace place) { return kBreakPlaceNames[static_cast<std::size_t>(place)]; }

const char* ended_by_name(EndedBy end) { return kEndNames[static_cast<std::size_t>(end)]; }

std::optional<EndedBy> ended_by_named(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(EndedBy::kPlateau); ++i)
    if (name == ended_by_name(static_cast<EndedBy>(i))) return static_cast<EndedBy>(i);
  return std::nullopt;
}

}  // namespace knot_utm
