#pragma once

#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "knot_utm/contact/memory_friction.hpp"
#include "knot_utm/contact/power_friction.hpp"
#include "knot_utm/contact/smoothed_friction.hpp"
#include "knot_utm/contact/stribeck_friction.hpp"
#include "knot_utm/numeric/law_registry.hpp"

namespace knot_utm {

/// All friction laws there are, in the order in which messages name them; the first is the default.
using FrictionLaws = std::variant<MemoryFriction, SmoothedFriction, StribeckFriction, PowerFriction>;

/// What is known of a law by its type alone.
struct FrictionLawEntry {
  const char* name;
  const FrictionKey* keys;
  std::size_t key_count;
  bool studied;

  bool has(const std::string& key) const;
};

namespace friction {

template <std::size_t... I>
constexpr std::array<FrictionLawEntry, sizeof...(I)> entries(std::index_sequence<I...>) {
  return {FrictionLawEntry{std::variant_alternative_t<I, FrictionLaws>::kName,
                           std::variant_alternative_t<I, FrictionLaws>::kKeys.data(),
                           std::variant_alternative_t<I, FrictionLaws>::kKeys.size(),
                           std::variant_alternative_t<I, FrictionLaws>::kStudied}...};
}

inline constexpr auto kEntries = entries(std::make_index_sequence<std::variant_size_v<FrictionLaws>>());

}  // namespace friction

inline constexpr auto kFrictionLawNames = LawRegistry<FrictionLaws>::kNames;

inline constexpr const FrictionLawEntry& entry_of(FrictionLaw law) {
  return friction::kEntries[static_cast<std::size_t>(law)];
}

/// The keys of all laws, each once.
const std::vector<FrictionKey>& friction_keys();
/// The laws that have a key, as a message lists them: "memory or smoothed".
std::string laws_with(const std::string& key);

/// The friction of one kind of contact, by one of the laws.
class Friction {
 public:
  Friction() = default;
  template <typename Law, typename = decltype(Law::kName)>
  Friction(const Law& law) : law_(law), on_(law.coefficient > 0.0) {}  // NOLINT(google-explicit-constructor)
  static Friction of(const FrictionOptions& options, const FrictionScales& scales);

  /// Calls use(law) with the law itself, once for all contacts, so that the law is not chosen at every contact.
  template <typename Use>
  auto visit(Use&& use) const {
    return std::visit(std::forward<Use>(use), law_);
  }

  bool on() const { return on_; }
  const char* name() const { return friction::kEntries[law_.index()].name; }
  double coefficient() const {
    return visit([](const auto& law) { return law.coefficient; });
  }
  double creep_speed() const {
    return visit([](const auto& law) { return law.creep_speed(); });
  }

  void state(Archive& archive);

 private:
  FrictionLaws law_;
  bool on_ = false;
};

}  // namespace knot_utm
