#include "knot_utm/raw/raw_text.hpp"

#include <unicode/normalizer2.h>
#include <unicode/uchar.h>
#include <unicode/unistr.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace knot_utm {
namespace {

using Letters = icu::UnicodeString;

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

std::string utf8(const Letters& letters) {
  std::string out;
  letters.toUTF8String(out);
  return out;
}

Letters from_utf8(std::string_view text) {
  return Letters::fromUTF8(icu::StringPiece(text.data(), static_cast<std::int32_t>(text.size())));
}

Letters from(const std::string& bytes, const char* encoding) {
  return {bytes.data(), static_cast<std::int32_t>(bytes.size()), encoding};
}

Letters normalised(const Letters& letters, const char* name, UNormalization2Mode mode) {
  UErrorCode error = U_ZERO_ERROR;
  const icu::Normalizer2* normalizer = icu::Normalizer2::getInstance(nullptr, name, mode, error);
  if (U_FAILURE(error)) return letters;
  Letters out = normalizer->normalize(letters, error);
  return U_SUCCESS(error) ? out : letters;
}

/// Compatible letters as the plain ones, and some that Unicode does not call so.
std::string plain(const Letters& letters) {
  constexpr std::array<std::pair<char16_t, char16_t>, 9> kSigns{{{0x066B, '.'},
                                                                 {0x066C, '\''},
                                                                 {0x2212, '-'},
                                                                 {0x2019, '\''},
                                                                 {0x2018, '\''},
                                                                 {0x02BC, '\''},
                                                                 {0x3010, '['},
                                                                 {0x3011, ']'},
                                                                 {0x2010, '-'}}};
  const Letters compatible = normalised(letters, "nfkc", UNORM2_COMPOSE);
  Letters out;
  for (std::int32_t i = 0; i < compatible.length(); ++i) {
    const char16_t c = compatible[i];
    if (c == 0xFEFF || (c >= 0x200B && c <= 0x200F)) continue;         // marks without width
    if (const std::int32_t digit = u_charDigitValue(c); digit >= 0) {  // of any script
      out.append(static_cast<char16_t>(u'0' + digit));
      continue;
    }
    const auto sign = std::find_if(kSigns.begin(), kSigns.end(), [c](const auto& pair) { return pair.first == c; });
    out.append(sign != kSigns.end() ? sign->second : c);
  }
  return utf8(out);
}

/// UTF-16 without its mark: digits, separators and line ends have one byte that is 0. Null: it is not.
const char* unmarked_utf16(std::string_view bytes) {
  const std::size_t looked_at = std::min<std::size_t>(bytes.size(), 4096) / 2 * 2;
  std::array<std::size_t, 2> zeros{};
  for (std::size_t i = 0; i < looked_at; ++i) zeros[i % 2] += bytes[i] == '\0';
  const auto is = [&](std::size_t high) {
    return 8 * zeros[high] > looked_at && 8 * zeros[1 - high] < zeros[high] && looked_at > 8;
  };
  return is(1) ? "UTF-16LE" : is(0) ? "UTF-16BE" : nullptr;
}

std::string without_padding(std::string text) {
  constexpr std::string_view kPadding("\0\x1A \r\n", 5);
  const std::size_t last = text.find_last_not_of(kPadding);
  if (last != std::string::npos && text.find_first_of(std::string_view("\0\x1A", 2), last) != std::string::npos)
    text = text.substr(0, last + 1) + '\n';
  return text;
}

}  // namespace

std::string why_no_text(const std::string& bytes) {
  constexpr std::string_view kSave = ": save its table as CSV (comma-separated text) and give that file";
  struct Kind {
    std::string_view mark, what, remedy;
  };
  constexpr Kind kKinds[] = {
      {"PK\x03\x04", "is a workbook (xlsx, ods) or another zip archive, and no text", kSave},
      {"\xD0\xCF\x11\xE0", "is an old workbook (xls), and no text", kSave},
      {"%PDF", "is a PDF, and no table of text", kSave},
      {"\x1F\x8B", "is compressed (gzip)", ": unpack it first, for example by gunzip"},
      {"SQLite format 3", "is a data base (SQLite), and no text", kSave},
      {"#ROSBAG", "is a bag, and no table of text",
       ": give the curve.csv of its run, or the raw data. compare reads a bag whose name ends in .bag"}};
  if (bytes.find_first_not_of(" \r\n\t") == std::string::npos) return "the file is empty";
  for (const Kind& kind : kKinds)
    if (bytes.compare(0, kind.mark.size(), kind.mark) == 0)
      return "the file " + std::string(kind.what) + std::string(kind.remedy);
  const std::string_view head = std::string_view(bytes).substr(0, 512);
  const std::size_t first = head.find_first_not_of(" \r\n\t\xEF\xBB\xBF");
  if (first != std::string_view::npos && head[first] == '<')
    return "the file is XML or HTML, as some programs write for a workbook, and no table of text" + std::string(kSave);
  // A last line end of another kind, which an editor put there, changes nothing.
  const auto ends = [&](char c) { return std::count(bytes.begin(), bytes.end(), c); };
  if (ends('\r') > 2 * ends('\n') && bytes.find('\r') + 1 < bytes.size())
    return "the lines of the file end with a carriage return alone, as on old Macs: give it the usual line ends first, "
           "for example by tr '\\r' '\\n' <FILE >NEW_FILE";
  if (bytes.size() > (std::size_t{1} << 30))
    return "the file is larger than 1 GiB, which is too large for a table of text";
  return {};
}

std::vector<std::string> meanings_of(const std::string& bytes) {
  const auto begins = [&](const char* mark) { return bytes.rfind(mark, 0) == 0; };
  std::vector<std::string> out;
  if (begins("\xFF\xFE") || begins("\xFE\xFF")) {
    out.push_back(plain(from(bytes, "UTF-16")));
  } else if (const char* utf16 = unmarked_utf16(bytes)) {
    out.push_back(plain(from(bytes, utf16)));
  } else if (is_ascii(bytes)) {
    out.push_back(bytes);
  } else if (const Letters letters = from_utf8(bytes); letters.indexOf(char16_t{0xFFFD}) < 0) {
    out.push_back(plain(letters));
  } else {
    for (const char* encoding : {"windows-1252", "windows-1250", "Shift_JIS", "GB18030"})
      out.push_back(plain(from(bytes, encoding)));
  }
  for (std::string& text : out) text = without_padding(std::move(text));
  return out;
}

std::string folded(const std::string& text) {
  constexpr std::array<std::pair<char16_t, char16_t>, 2> kBare{{{0x142, 'l'}, {0xF8, 'o'}}};  // they have no accent
  std::string lower;
  if (is_ascii(text)) {
    for (const char c : text) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 0x20) : c;
  } else {
    const Letters apart = normalised(normalised(from_utf8(text), "nfkc_cf", UNORM2_COMPOSE), "nfc", UNORM2_DECOMPOSE);
    Letters out;
    for (std::int32_t i = 0; i < apart.length(); ++i) {
      const char16_t c = apart[i];
      if (u_charType(c) == U_NON_SPACING_MARK) continue;
      const auto bare = std::find_if(kBare.begin(), kBare.end(), [c](const auto& pair) { return pair.first == c; });
      out.append(bare != kBare.end() ? bare->second : c);
    }
    lower = utf8(out);
  }
  std::string once;
  for (char c : lower) {
    if (c == '_') c = ' ';
    if (c != ' ' || (!once.empty() && once.back() != ' ')) once += c;
  }
  while (once.size() > 1 && (once.back() == '.' || once.back() == ' ')) once.pop_back();
  return once;
}

}  // namespace knot_utm
