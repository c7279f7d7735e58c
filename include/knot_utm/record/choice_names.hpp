#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace knot_utm {

/// The values of an enumeration and how each is called in files and messages; the first stands for what is none.
template <typename Choice, std::size_t N>
using ChoiceNames = std::array<std::pair<Choice, const char*>, N>;

template <typename Choice, std::size_t N>
const char* name_of(const ChoiceNames<Choice, N>& names, Choice choice) {
  for (const auto& [value, name] : names) {
    if (value == choice) return name;
  }
  return names.front().second;
}

/// The other way; nothing for a name that is none.
template <typename Choice, std::size_t N>
std::optional<Choice> choice_named(const ChoiceNames<Choice, N>& names, const std::string& name) {
  for (const auto& [value, text] : names) {
    if (name == text) return value;
  }
  return std::nullopt;
}

}  // namespace knot_utm
