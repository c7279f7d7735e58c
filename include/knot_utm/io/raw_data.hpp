#pragma once

#include <string>
#include <vector>

#include "knot_utm/io/csv.hpp"
#include "knot_utm/io/raw_columns.hpp"

namespace knot_utm {

/// Reads the raw data of a test as testing machines export them: a text file with a table. The table has columns for
/// time, extension and load among others, in any order. Other text may precede it.
///
///   characters  UTF-8, UTF-16 with a byte order mark, Shift-JIS, GB 18030, or a Windows code page. The code pages need
///               not be told apart: letters beyond ASCII occur in names only, and the known names also differ in
///               others.
///   separator   semicolon, tab or comma: the one with which a row names all three quantities. A quoted cell may
///               contain the separator, and two quotes for one.
///   names       those of the table in raw_names.cpp: what Instron, ZwickRoell, MTS, Shimadzu, Mecmesin and others
///               write, in English, German, Polish, French, Spanish, Italian, Portuguese, Dutch, Chinese and Japanese,
///               with any accents and capitals; or those that the user gives as `columns`. The row of names is the
///               first that names all three quantities. If it has several names for one quantity, the machine's own
///               counts: "Extension" before "Tensile extension".
///   units       after the names ("Load (N)", "Load [N]", "Load/N", "Load N") or in a row of their own ("(N)"). They
///               are never guessed: a column without a unit, or with an unknown one, is refused. Time: ms, s or sec,
///               min, h. Extension: um, mm, cm, m, in, ft. Load: mN, cN, N, kN, gf, kgf, lbf.
///   decimals    point or comma, the same in the whole file. The other one, or a blank, may separate groups of three
///               digits. A number must show which is which: 1,234 alone does not.
///
/// The rows are converted to SI and are otherwise as recorded: the load is not balanced and the extension not zeroed. A
/// row that repeats the three values of the row before, as the first one often does, is left out. So is a row in which
/// all three are empty. What the machine did not measure is NaN, and the phase is `pull`.
///
/// Throws InvalidInput, which names row and column, where the file does not have this form, a time is smaller than the
/// one before, a value is not finite, a row has a cell without a name, or there is no row at all. `file`: name of the
/// file in messages.
std::vector<CurveRow> read_raw_data(const std::string& content, const std::string& file,
                                    const RawColumns& columns = {});

}  // namespace knot_utm
