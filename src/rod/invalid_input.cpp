#include "knot_utm/rod/invalid_input.hpp"

namespace knot_utm {

std::string shown(const std::string& text) {
  constexpr std::size_t kLongest = 500;
  std::string line = text.substr(0, kLongest);
  for (char& c : line) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) c = ' ';
  }
  return text.size() > kLongest ? line + "..." : line;
}

}  // namespace knot_utm
