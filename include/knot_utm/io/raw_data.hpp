#pragma once

#include <string>
#include <vector>

#include "knot_utm/io/csv.hpp"
#include "knot_utm/io/raw_columns.hpp"

namespace knot_utm {

/// Reads the raw data of a test as testing machines export them: a text with a table of time, extension and load among
/// other columns, in any order, behind whatever stands before it.
///
///   characters  UTF-8, UTF-16 with a byte order mark, Shift-JIS, GB 18030, or a Windows code page. The code pages need
///               not be told apart: letters beyond ASCII are in names only, and known names differ in others too.
///   separator   semicolon, tab or comma: the one by which a row names all three quantities. A cell in quotes may hold
///               it, and quotes twice for one.
///   names       those of the table in raw_names.cpp: what Instron, ZwickRoell, MTS, Shimadzu, Mecmesin and others
///   write,
///               in English, German, Polish, French, Spanish, Italian, Portuguese, Dutch, Chinese and Japanese,
///               whatever their accents and capitals; or those that the user gives as `columns`. Their row is the first
///               that names all three. Of names for the same quantity in one row the machine's own counts: "Extension"
///               before "Tensile extension".
///   units       behind the names ("Load (N)", "Load [N]", "Load/N", "Load N") or in a row of their own ("(N)"). They
///   are never guessed: a
///               column with none, or an unknown one, is refused. Time: ms, s or sec, min, h. Extension: um, mm, cm, m,
///               in, ft. Load: mN, cN, N, kN, gf, kgf, lbf.
///   decimals    point or comma, the same in all of the file; the other one or a blank may stand between groups of
///   three
///               digits. A number must tell which: of 1,234 alone it is not known.
///
/// Rows are in SI as they were recorded: neither is the load balanced nor the extension zeroed. A row that repeats the
/// one before in all three, as the first one often does, is left out; so is one in which all three are empty. What the
/// machine did not measure is NaN, the phase is `pull`.
///
/// Throws InvalidInput, which names the row and the column, where this is not so, a time goes back, a value is not
/// finite, a row has a cell without a name, or there is no row at all. `file`: its name in messages.
std::vector<CurveRow> read_raw_data(const std::string& content, const std::string& file,
                                    const RawColumns& columns = {});

}  // namespace knot_utm
