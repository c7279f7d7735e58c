#include "knot_utm/io/raw_columns.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {

RawColumns parse_raw_columns(const std::string& text, const std::string& key) {
  constexpr const char* kForm = "time=NAME,extension=NAME,load=NAME, or one or two of these";
  constexpr std::array<std::pair<const char*, std::string RawColumns::*>, 3> kQuantities{
      {{"time=", &RawColumns::time}, {"extension=", &RawColumns::extension}, {"load=", &RawColumns::load}}};
  RawColumns out;
  std::string* current = nullptr;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, comma - begin);
    std::string* next = nullptr;
    for (const auto& [word, name] : kQuantities)
      if (part.rfind(word, 0) == 0) {
        next = &(out.*name);
        if (!next->empty()) throw InvalidInput(key, text, std::string("a list with ") + word + " only once");
        *next = part.substr(std::string(word).size());
      }
    if (!next && !current) throw InvalidInput(key, text.empty() ? "\"\"" : text, kForm);
    if (!next) *current += ',' + part;
    if (next) current = next;
    if (current->empty()) throw InvalidInput(key, text, kForm);
    begin = comma + 1;
  }
  return out;
}

}  // namespace knot_utm
