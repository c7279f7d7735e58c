#pragma once

#include <array>
#include <utility>
#include <variant>

#include "knot_utm/rod/elastic_bending.hpp"
#include "knot_utm/rod/plastic_bending.hpp"

namespace knot_utm {

/// All bending laws there are, in the order in which messages name them; the first is the default.
using BendingLaws = std::variant<ElasticBending, PlasticBending>;

namespace bending_laws {

template <std::size_t... I>
constexpr std::array<const char*, sizeof...(I)> names(std::index_sequence<I...> /*all*/) {
  return {std::variant_alternative_t<I, BendingLaws>::kName...};
}

}  // namespace bending_laws

inline constexpr auto kBendingLawNames =
    bending_laws::names(std::make_index_sequence<std::variant_size_v<BendingLaws>>());

/// The law that a material names, with its parameters. Throws InvalidInput where one is missing.
BendingLaws bending_law_of(const Material& material);

/// Whether what the law remembers changes from step to step. The rod then needs frames and a memory of its bends
/// (RodState::natural_curvature), be it zero.
bool remembers(const BendingLaws& law);
bool remembers_bends(const Material& material);

/// Which law it is, and its parameters.
void archive_law(Archive& archive, BendingLaws& law);

}  // namespace knot_utm
