#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/raw/raw_cells.hpp"
#include "knot_utm/raw/raw_options.hpp"
#include "raw_names.hpp"

/// Which columns of a table have which quantity.
namespace knot_utm {

/// A column that may have a quantity.
struct RawColumn {
  std::size_t place = 0;            ///< from 0
  std::string label;                ///< as given
  std::optional<std::string> unit;  ///< that behind the name
  std::size_t rank = 0;             ///< the lower, the better
  std::string base;                 ///< the name alone, folded, without the number of a specimen
  bool of_machine = false;          ///< its name says that it is the crosshead's travel
};

/// The columns that were chosen for time, extension and load. Only that of time may be missing.
using RawChoice = std::array<std::optional<RawColumn>, 3>;

/// Where a table begins, and what its columns may have.
struct RawHead {
  std::optional<std::size_t> names_row;  ///< index of the row of names; empty: there is none
  std::size_t first = 0;                 ///< index of the row behind it, which may have units
  char separator = ',';
  std::size_t cells = 0;                          ///< how many columns there are
  std::array<std::vector<RawColumn>, 3> columns;  ///< of each quantity, best first

  /// How many specimens stand side by side. Each has an extension and a load of its own; the time may be common.
  std::size_t specimens() const;
  /// The columns of one of them, from 0.
  RawChoice of_specimen(std::size_t specimen) const;
  /// Columns that may have a quantity of this specimen beside the one that `of_specimen` gives.
  std::vector<RawColumn> others(std::size_t quantity, std::size_t specimen) const;
};

/// The unit without its brackets, "(mm)" or "[mm]"; otherwise the text itself.
std::string without_brackets(const std::string& text);

/// The head, if this row names extension and load, and time where it must.
std::optional<RawHead> head_in(const std::string& row, std::size_t index, const RawColumns& given, bool with_time);

/// The head of a table whose columns are given by their numbers: the last row of names and the first of units before
/// its first row of numbers, where there are such. Empty where the columns are not given so.
std::optional<RawHead> head_by_numbers(const std::vector<std::string>& rows, const RawColumns& given, bool with_time);

/// A sentence about the row that names the most columns, and which it does not name. Empty where there is no such row.
std::string nearest_head(const std::vector<std::string>& rows, const RawColumns& given, bool with_time);

}  // namespace knot_utm
