#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Rows of a table that somebody else wrote, as cells and numbers.
namespace knot_utm {

using Cells = std::vector<std::string>;

/// The separators, in the order in which they are tried. A blank stands for any number of blanks.
constexpr std::string_view kSeparators = ";\t|, ";

/// The cells of a row, without blanks around them. A quoted cell may contain the separator, and two quotes for one.
Cells split(const std::string& row, char separator);

/// The names of columns that blanks separate: by two blanks or more where there are such, else by one, where a unit in
/// brackets belongs to the name before it.
Cells split_names(const std::string& row);

/// A cell in quotes may go over some lines, as names in spreadsheets do: they become the first of these rows, and the
/// others are empty, so that all rows keep their numbers.
void join_quoted(std::vector<std::string>& rows);

std::string trimmed(std::string_view text);
bool has_digit(const std::string& cell);
bool are_empty(const Cells& cells);

/// The mark of decimals in a file: the first cell that tells it counts for all.
class DecimalMark {
 public:
  void look_at(const std::string& cell);

  bool is_told() const { return told_.has_value(); }
  char mark() const { return told_.value_or('.'); }
  /// A number of three digits behind a mark, where none tells whether it is of decimals; else empty.
  std::string unclear() const { return told_ ? std::string() : unclear_; }

 private:
  std::optional<char> told_;
  std::string unclear_;
};

/// A number with this mark before its decimals. The other mark, blanks or apostrophes may separate groups of three
/// digits. Empty where it is none.
std::optional<double> number(const std::string& cell, char mark);

/// Whether a cell is a number with either mark.
bool is_number(const std::string& cell);

}  // namespace knot_utm
