#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace knot_utm {

/// The values of an enumeration, and the name of each in files and messages. The first name stands for values that are
/// none of them.
template <typename Choice, std::size_t N>
using ChoiceNames = std::array<std::pair<Choice, const char*>, N>;

template <typename Choice, std::size_t N>
const char* name_of(const ChoiceNames<Choice, N>& names, Choice choice) {
  for (const auto& [value, name] : names) {
    if (value == choice) return name;
  }
  return names.front().second;
}

/// The value with this name; nothing where no value has it.
template <typename Choice, std::size_t N>
std::optional<Choice> choice_named(const ChoiceNames<Choice, N>& names, const std::string& name) {
  for (const auto& [value, text] : names) {
    if (name == text) return value;
  }
  return std::nullopt;
}

}  // namespace knot_utm
