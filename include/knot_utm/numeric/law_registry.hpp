#pragma once

#include <array>
#include <cstddef>
#include <variant>

#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {

/// The laws of one kind: plain structs in a variant, numbered by their place in it. Each has a `kName`, a static
/// `of(...)` that makes it from a method, and a visitor `state(Archive&)` of its parameters.
template <typename Laws>
struct LawRegistry;

template <typename... Law>
struct LawRegistry<std::variant<Law...>> {
  using Laws = std::variant<Law...>;

  static constexpr std::array<const char*, sizeof...(Law)> kNames{Law::kName...};

  /// The law of that number, with its parameters from `method`.
  template <typename... Method>
  static Laws of(std::size_t number, const Method&... method) {
    Laws out;
    std::size_t next = 0;
    static_cast<void>(((next++ == number && (out = Law::of(method...), true)) || ...));
    return out;
  }

  /// Saves or loads which law it is, and its parameters. `what`: the kind of law, for messages.
  static void archive(Archive& archive, const char* what, Laws& law) {
    int number = static_cast<int>(law.index());
    archive.number(what, number, 0, static_cast<int>(sizeof...(Law)) - 1);
    if (archive.loads()) {
      int next = 0;
      static_cast<void>(((next++ == number && (law = Law(), true)) || ...));
    }
    std::visit([&](auto& of) { of.state(archive); }, law);
  }
};

}  // namespace knot_utm
