#include "knot_utm/record/ended_by.hpp"

#include <array>
#include <utility>

namespace knot_utm {
namespace {

constexpr std::array<std::pair<EndedBy, const char*>, 10> kEndNames{{{EndedBy::kNotYet, "not yet"},
                                                                     {EndedBy::kBreak, "break"},
                                                                     {EndedBy::kExtension, "extension"},
                                                                     {EndedBy::kLoad, "load"},
                                                                     {EndedBy::kTravel, "travel"},
                                                                     {EndedBy::kOperator, "operator"},
                                                                     {EndedBy::kSolver, "solver"},
                                                                     {EndedBy::kProgram, "program"},
                                                                     {EndedBy::kTime, "time"},
                                                                     {EndedBy::kUntangled, "untangled"}}};

}  // namespace

const char* ended_by_name(EndedBy end) {
  for (const auto& [value, name] : kEndNames) {
    if (value == end) return name;
  }
  return kEndNames.front().second;
}

std::optional<EndedBy> ended_by_named(const std::string& name) {
  for (const auto& [value, text] : kEndNames) {
    if (name == text) return value;
  }
  return std::nullopt;
}

}  // namespace knot_utm
