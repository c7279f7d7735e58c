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
  bool next();

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
