#include "knot_utm/numeric/law_registry.hpp"

#include <algorithm>
#include <iterator>

#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

bool LawEntry::has(const std::string& key) const {
  return std::any_of(keys, keys + key_count, [&](const LawKey& own) { return key == own.name; });
}

std::vector<LawKey> keys_of(const LawEntry* laws, std::size_t count) {
  std::vector<LawKey> out;
  const auto is_new = [&](const LawKey& key) {
    return std::none_of(out.begin(), out.end(),
                        [&](const LawKey& other) { return std::string(key.name) == other.name; });
  };
  for (const LawEntry* law = laws; law != laws + count; ++law)
    std::copy_if(law->keys, law->keys + law->key_count, std::back_inserter(out), is_new);
  return out;
}

std::string laws_with(const std::string& key, const LawEntry* laws, std::size_t count) {
  std::vector<std::string> names;
  for (const LawEntry* law = laws; law != laws + count; ++law)
    if (law->has(key)) names.emplace_back(law->name);
  return listed(names);
}

}  // namespace knot_utm
