#pragma once

#include <cstddef>
#include <istream>
#include <string>

namespace knot_utm {

/// Reads a table that somebody else wrote, row by row. A row may have at most 4096 characters and a table at most two
/// million rows, so that reading any file ends and takes bounded memory.
class TextRows {
 public:
  explicit TextRows(std::istream& in) : in_(in) {}

  /// Goes on to the next row; false at the end, and where a bound is passed (`fault`).
  bool next() {
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

  const std::string& text() const { return text_; }  ///< of the row, without the end of the line
  std::size_t number() const { return number_; }     ///< of the row, from 1
  /// A sentence about the bound that was passed; empty where none was.
  const std::string& fault() const { return fault_; }

 private:
  std::istream& in_;
  std::string text_, fault_;
  std::size_t number_ = 0;
};

}  // namespace knot_utm
