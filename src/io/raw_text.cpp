#include "raw_text.hpp"

#include <iconv.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string_view>

namespace knot_utm {
namespace {

constexpr char32_t kAnyLetter = 0xE000;            // for private use: stands in no export
constexpr const char* kAnyBytes = "\xEE\x80\x80";  // the same in UTF-8
constexpr char32_t kBeyondCodePages = 0x250;       // letters that a code page of one byte may have are below
constexpr char32_t kUnknown = 0xFFFD;

void append(std::string& out, char32_t c) {
  const auto put = [&out](char32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | c >> 6);
    put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | c >> 12);
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | c >> 18);
    put(0x80 | (c >> 12 & 0x3F));
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

/// How many bytes a letter has, by its first one; 0: none begins so.
int bytes_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

/// Nothing where the bytes are no UTF-8.
std::optional<std::u32string> letters_of(std::string_view bytes) {
  std::u32string out;
  for (std::size_t i = 0; i < bytes.size();) {
    const auto first = static_cast<unsigned char>(bytes[i]);
    const int count = bytes_of(first);
    if (count == 0 || i + static_cast<std::size_t>(count) > bytes.size()) return std::nullopt;
    char32_t letter = count == 1 ? first : first & (0x7F >> count);
    for (int k = 1; k < count; ++k) {
      const auto next = static_cast<unsigned char>(bytes[i + static_cast<std::size_t>(k)]);
      if ((next & 0xC0) != 0x80) return std::nullopt;
      letter = letter << 6 | (next & 0x3F);
    }
    out += letter;
    i += static_cast<std::size_t>(count);
  }
  return out;
}

char32_t plain(char32_t c) {
  if (c == 0xA0 || c == 0x202F || c == 0x3000) return ' ';
  if (c == 0xFF08) return '(';
  if (c == 0xFF09) return ')';
  if (c == 0xFF3B || c == 0x3010) return '[';
  return c == 0xFF3D || c == 0x3011 ? ']' : c;
}

std::string text_of(const std::u32string& letters) {
  std::string out;
  for (const char32_t c : letters) append(out, plain(c));
  return out;
}

/// Two bytes a unit, the high one first or second; two units a rare letter.
std::string from_utf16(const std::string& bytes, std::size_t high) {
  std::u32string out;
  char32_t lead = 0;
  for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const char32_t unit = static_cast<char32_t>(static_cast<unsigned char>(bytes[i + high])) << 8 |
                          static_cast<unsigned char>(bytes[i + 1 - high]);
    const bool is_lead = unit >= 0xD800 && unit < 0xDC00, is_trail = unit >= 0xDC00 && unit < 0xE000;
    if (is_trail && lead != 0)
      out += 0x10000 + ((lead - 0xD800) << 10) + (unit - 0xDC00);
    else if (!is_lead)
      out += is_trail ? kUnknown : unit;
    lead = is_lead ? unit : 0;
  }
  return text_of(out);
}

std::string from_code_page(const std::string& bytes) {
  std::u32string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x80 || byte == 0xA0 ? byte : kAnyLetter;
  }
  return text_of(out);
}

/// Nothing where the bytes are none of this encoding, or the system does not know it.
std::optional<std::string> converted(const std::string& bytes, const char* encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  std::string in = bytes, out(4 * bytes.size() + 4, '\0');
  char *from = in.data(), *to = out.data();
  std::size_t left = in.size(), room = out.size();
  const bool failed = iconv(converter, &from, &left, &to, &room) == static_cast<std::size_t>(-1);
  iconv_close(converter);
  if (failed) return std::nullopt;
  out.resize(out.size() - room);
  const auto letters = letters_of(out);
  return letters ? std::optional<std::string>(text_of(*letters)) : std::nullopt;
}

char32_t lower(char32_t c) {
  if ((c >= 'A' && c <= 'Z') || (c >= 0xC0 && c <= 0xDE && c != 0xD7)) return c + 0x20;
  const bool even_first = (c >= 0x100 && c < 0x138) || (c >= 0x14A && c < 0x178);
  const bool odd_first = (c >= 0x139 && c < 0x149) || (c >= 0x179 && c < 0x17F);
  if ((even_first && c % 2 == 0) || (odd_first && c % 2 == 1)) return c + 1;
  return c;
}

/// The letter without its accent; letters are in lower case.
char32_t bare(char32_t c) {
  struct Letters {
    char32_t bare;
    const char32_t* accented;
  };
  static constexpr Letters kAll[] = {{'a', U"àáâãäåą"}, {'c', U"çćč"}, {'e', U"èéêëęě"},  {'i', U"ìíîï"},
                                     {'l', U"ł"},       {'n', U"ñńň"}, {'o', U"òóôõöőø"}, {'s', U"śšş"},
                                     {'u', U"ùúûüűů"},  {'y', U"ýÿ"},  {'z', U"źżž"}};
  for (const Letters& row : kAll)
    if (std::u32string_view(row.accented).find(c) != std::u32string_view::npos) return row.bare;
  return c;
}

bool is_letter(char32_t given, char32_t known) {
  if (given == kAnyLetter) return known >= 0x80 && known < kBeyondCodePages;
  return bare(lower(given)) == bare(lower(known));
}

}  // namespace

std::vector<std::string> meanings_of(const std::string& bytes) {
  const auto begins = [&](const char* mark) { return bytes.rfind(mark, 0) == 0; };
  if (begins("\xFF\xFE")) return {from_utf16(bytes, 1)};
  if (begins("\xFE\xFF")) return {from_utf16(bytes, 0)};
  const std::size_t mark = begins("\xEF\xBB\xBF") ? 3 : 0;
  if (const auto letters = letters_of(std::string_view(bytes).substr(mark))) return {text_of(*letters)};
  std::vector<std::string> out{from_code_page(bytes.substr(mark))};
  for (const char* encoding : {"SHIFT_JIS", "GB18030"})
    if (auto text = converted(bytes, encoding)) out.push_back(*std::move(text));
  return out;
}

bool is_name(const std::string& given, const std::string& known) {
  const auto a = letters_of(given), b = letters_of(known);
  return a && b && std::equal(a->begin(), a->end(), b->begin(), b->end(), is_letter);
}

std::string visible(const std::string& text) {
  std::string out = text;
  for (std::size_t at = out.find(kAnyBytes); at != std::string::npos; at = out.find(kAnyBytes, at))
    out.replace(at, std::string_view(kAnyBytes).size(), "?");
  return out;
}

}  // namespace knot_utm
