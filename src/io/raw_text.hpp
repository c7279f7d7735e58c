#pragma once

#include <string>
#include <vector>

/// Decodes files whose character encoding is not known. Decoded texts are UTF-8.
namespace knot_utm {

/// The possible decodings of the bytes, the most likely first. With a byte order mark there is one. Otherwise it is
/// UTF-8 if the bytes are valid UTF-8; if not, the candidates are a code page of one byte per letter, Shift-JIS and GB
/// 18030. The code page itself need not be known: every letter beyond ASCII is decoded as a placeholder that matches
/// any letter. Non-breaking blanks become blanks, and full-width brackets become brackets.
std::vector<std::string> meanings_of(const std::string& bytes);

/// Whether `given` is the name `known`, which is in lower case. Upper case and accents are ignored, and a placeholder
/// matches any letter.
bool is_name(const std::string& given, const std::string& known);

/// The text for a message, with question marks in place of placeholders.
std::string visible(const std::string& text);

}  // namespace knot_utm
