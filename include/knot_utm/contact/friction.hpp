#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "knot_utm/contact/memory_friction.hpp"
#include "knot_utm/contact/power_friction.hpp"
#include "knot_utm/contact/rate_friction.hpp"
#include "knot_utm/contact/smoothed_friction.hpp"
#include "knot_utm/numeric/law_registry.hpp"

namespace knot_utm {

/// All friction laws there are, in the order in which messages name them; the first is the default.
using FrictionLaws = std::variant<MemoryFriction, SmoothedFriction, PowerFriction, RateFriction>;

using FrictionRegistry = LawRegistry<FrictionLaws>;

inline constexpr auto kFrictionLawNames = FrictionRegistry::kNames;

/// By its name as in a method, which must be one of kFrictionLawNames.
inline FrictionLaw law_named(const std::string& name) {
  return static_cast<FrictionLaw>(std::find(kFrictionLawNames.begin(), kFrictionLawNames.end(), name) -
                                  kFrictionLawNames.begin());
}

/// The friction of one kind of contact, by one of the laws.
class Friction {
 public:
  Friction() = default;
  template <typename Law, typename = decltype(Law::kName)>
  Friction(const Law& law) : law_(law), on_(law.coefficient > 0.0) {}  // NOLINT(google-explicit-constructor)
  static Friction of(const FrictionOptions& options, const FrictionScales& scales) {
    Friction out;
    out.law_ = FrictionRegistry::of(options.law, options, scales);
    out.on_ = out.coefficient() > 0.0;
    return out;
  }

  /// Calls use(law) with the law itself, once for all contacts, so that the law is not chosen at every contact.
  template <typename Use>
  auto visit(Use&& use) const {
    return std::visit(std::forward<Use>(use), law_);
  }

  /// The law itself, where it is known to be of this type.
  template <typename Law>
  const Law& as() const {
    return std::get<Law>(law_);
  }

  bool on() const { return on_; }
  const char* name() const { return kFrictionLawNames[law_.index()]; }
  double coefficient() const {
    return visit([](const auto& law) { return law.coefficient; });
  }
  double creep_speed() const {
    return visit([](const auto& law) { return law.creep_speed(); });
  }

 private:
  FrictionLaws law_;
  bool on_ = false;
};

}  // namespace knot_utm
