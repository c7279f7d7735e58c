#include "knot_utm/numeric/text_rows.hpp"

namespace knot_utm {

bool TextRows::next() {
  constexpr std::size_t kLongest = 4096, kMost = 2000000;
  using Traits = std::istream::traits_type;
  if (!fault_.empty() || Traits::eq_int_type(in_.peek(), Traits::eof())) return false;
  ++number_;
  text_.clear();
  std::streambuf& buffer = *in_.rdbuf();
  for (auto c = buffer.sbumpc(); !Traits::eq_int_type(c, Traits::eof()); c = buffer.sbumpc()) {
    const char character = Traits::to_char_type(c);
    if (character == '\n') break;
    if (text_.size() == kLongest) {
      fault_ = "row " + std::to_string(number_) + " is longer than " + std::to_string(kLongest) + " characters";
      return false;
    }
    text_ += character;
  }
  if (number_ > kMost) fault_ = "there are more than " + std::to_string(kMost) + " rows";
  return fault_.empty();
}

}  // namespace knot_utm
