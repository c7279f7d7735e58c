#pragma once

#include <string>
#include <vector>

/// Decodes files whose character encoding is not known. Decoded texts are UTF-8.
namespace knot_utm {

/// What a file is that is no text, such as a workbook, with what to do about it; a whole sentence. Empty for a text.
std::string why_no_text(const std::string& bytes);

/// The possible decodings of the bytes, the most likely first. With a byte order mark there is one. Otherwise it is
/// UTF-16 if every other byte is 0, and UTF-8 if the bytes are valid UTF-8; if not, the candidates are the Windows code
/// pages 1252 and 1250, Shift-JIS and GB 18030. Of letters that Unicode calls compatible the plain one is given: thin
/// and full-width blanks become blanks, full-width brackets and digits become plain ones, a minus sign becomes a
/// hyphen. The end of a file that was padded with zero bytes or Ctrl-Z is left out.
std::vector<std::string> meanings_of(const std::string& bytes);

/// The text by which names are compared: lower case, without accents, dots behind abbreviations and
/// repeated blanks. An underscore is a blank.
std::string folded(const std::string& text);

}  // namespace knot_utm
