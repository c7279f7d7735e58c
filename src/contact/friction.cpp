#include "knot_utm/contact/friction.hpp"

#include <algorithm>
#include <string>

#include "knot_utm/numeric/known_names.hpp"

namespace knot_utm {

bool FrictionLawEntry::has(const std::string& key) const {
  return std::any_of(keys, keys + key_count, [&](const FrictionKey& own) { return key == own.name; });
}

FrictionLaw law_named(const std::string& name) {
  const auto& all = friction::kEntries;
  return static_cast<FrictionLaw>(
      std::find_if(all.begin(), all.end(), [&](const FrictionLawEntry& law) { return name == law.name; }) -
      all.begin());
}

const std::vector<FrictionKey>& friction_keys() {
  static const std::vector<FrictionKey> all = [] {
    std::vector<FrictionKey> out;
    const auto known = [&](const std::string& name) {
      return std::any_of(out.begin(), out.end(), [&](const FrictionKey& key) { return name == key.name; });
    };
    for (const FrictionLawEntry& law : friction::kEntries)
      std::copy_if(law.keys, law.keys + law.key_count, std::back_inserter(out),
                   [&](const FrictionKey& key) { return !known(key.name); });
    return out;
  }();
  return all;
}

std::string laws_with(const std::string& key) {
  std::vector<std::string> names;
  for (const FrictionLawEntry& law : friction::kEntries)
    if (law.has(key)) names.emplace_back(law.name);
  return listed(names);
}

Friction Friction::of(const FrictionOptions& options, const FrictionScales& scales) {
  Friction out;
  out.law_ = LawRegistry<FrictionLaws>::of(static_cast<std::size_t>(options.law), options, scales);
  out.on_ = out.coefficient() > 0.0;
  return out;
}

void Friction::state(Archive& archive) {
  LawRegistry<FrictionLaws>::archive(archive, "friction law", law_);
  on_ = coefficient() > 0.0;
}

}  // namespace knot_utm
