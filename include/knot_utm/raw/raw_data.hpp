#pragma once

#include <string>
#include <vector>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/raw/raw_options.hpp"

namespace knot_utm {

/// Reads the raw data of a test as testing machines export them: a text file with a table. The table has columns for
/// time, extension and load among others, in any order. Other text may precede it.
///
///   characters  UTF-8, UTF-16, Shift-JIS, GB 18030, or a Windows code page (raw_text.hpp).
///   separator   semicolon, tab, bar, comma or blanks: the one with which a row names all three quantities. A quoted
///               cell may contain the separator, and two quotes for one.
///   names       those of the table in raw_names.cpp: what Instron, ZwickRoell, MTS, Shimadzu, Mecmesin and others
///               write, in many languages, with any accents and capitals, and with a number of the specimen before or
///               behind them ("C_1_Time"); or those that the user gives as `columns`. The row of names is the first
///               that names all three quantities. Columns that are given by number need no names.
///   several     If a row has several names for one quantity, the machine's own counts: "Extension" before "Tensile
///               extension". If a column that is called an extension goes another way than that of the crosshead, it is
///               an extensometer's, and the crosshead's counts. Several specimens side by side or in tables below each
///               other are refused unless one is chosen.
///   units       after the names ("Load (N)", "Load [N]", "Load/N", "Load N"), in a row of their own below or above the
///               names ("(N)"), or given by the user. They are never guessed: a column without a unit, or with an
///               unknown one, is refused. raw_names.cpp has their spellings. A unit of mass stands for its weight.
///   decimals    point or comma, the same in the whole file. The other one, a blank or an apostrophe may separate
///               groups of three digits. A number must show which is which: 1,234 alone does not.
///
/// The rows are converted to SI and are otherwise as recorded: the load is not balanced and the extension not zeroed. A
/// row that repeats the values of the row before, as the first one often does, is left out. So is a row in which all
/// are empty, and a single reading whose extension jumps away and back. What the machine did not measure is NaN, and
/// the phase is `pull`. `tell` receives what was read, from which columns, and what was left out.
///
/// Throws InvalidInput, which names row and column, where the file does not have this form, a time is smaller than the
/// one before, a value is not finite, a row has a cell without a name, or there is no row at all. `file`: name of the
/// file in messages.
std::vector<CurveRow> read_raw_data(const std::string& content, const std::string& file, const RawOptions& options = {},
                                    const Tell& tell = nullptr);

}  // namespace knot_utm
