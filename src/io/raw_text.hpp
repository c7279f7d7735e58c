#pragma once

#include <string>
#include <vector>

/// The characters of files that do not say what theirs are. Inside, texts are UTF-8.
namespace knot_utm {

/// What the bytes may mean, the likeliest first: as their byte order mark says; else as UTF-8, where they are; else as
/// a code page of one byte a letter, as Shift-JIS and as GB 18030. Of a code page every letter beyond ASCII is one that
/// may be any: which code page it is, nobody needs to know. Blanks that do not break a line are blanks, and wide
/// brackets are brackets.
std::vector<std::string> meanings_of(const std::string& bytes);

/// Whether a name is the known one, which is in lower case: letters count the same in upper case, without their
/// accents, and where a code page leaves them open.
bool is_name(const std::string& given, const std::string& known);

/// As a message shows it: letters that are left open as question marks.
std::string visible(const std::string& text);

}  // namespace knot_utm
