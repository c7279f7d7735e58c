#include "knot_utm/rod/bending_laws.hpp"

namespace knot_utm {
namespace {

constexpr auto kNumbers = std::make_index_sequence<std::variant_size_v<BendingLaws>>();

template <std::size_t... I>
BendingLaws law_of(std::size_t number, const Material& material, std::index_sequence<I...> /*all*/) {
  BendingLaws out;
  ((number == I ? void(out = std::variant_alternative_t<I, BendingLaws>::of(material)) : void()), ...);
  return out;
}

template <std::size_t... I>
BendingLaws plain_law(std::size_t number, std::index_sequence<I...> /*all*/) {
  BendingLaws out;
  ((number == I ? void(out.emplace<I>()) : void()), ...);
  return out;
}

}  // namespace

BendingLaws bending_law_of(const Material& material) {
  return law_of(static_cast<std::size_t>(material.bending_law), material, kNumbers);
}

bool remembers(const BendingLaws& law) {
  return std::visit([](const auto& of) { return of.kRemembers; }, law);
}

bool remembers_bends(const Material& material) { return remembers(bending_law_of(material)); }

void archive_law(Archive& archive, BendingLaws& law) {
  int number = static_cast<int>(law.index());
  archive.number("bending law", number, 0, static_cast<int>(std::variant_size_v<BendingLaws>) - 1);
  if (archive.loads()) law = plain_law(static_cast<std::size_t>(number), kNumbers);
  std::visit([&](auto& of) { of.state(archive); }, law);
}

}  // namespace knot_utm
