#include "knot_utm/raw/raw_cells.hpp"

#include <algorithm>
#include <cstring>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// 1,234,567 without its marks; what has none as it is; nothing where they stand elsewhere.
std::optional<std::string> without_groups(const std::string& whole, char mark) {
  const std::size_t first = whole.find(mark);
  if (first == std::string::npos) return whole;
  const std::size_t begin = whole[0] == '-' || whole[0] == '+' ? 1 : 0;
  if (first == begin || first > begin + 3 || whole[begin] == '0' || (whole.size() - first) % 4 != 0)
    return std::nullopt;
  std::string out = whole.substr(0, begin);
  for (std::size_t i = begin; i < whole.size(); ++i) {
    const bool between = i >= first && (i - first) % 4 == 0;
    if (between ? whole[i] != mark : !is_digit(whole[i])) return std::nullopt;
    if (!between) out += whole[i];
  }
  return out;
}

Cells words(const std::string& row, const std::string& gap) {
  Cells out;
  std::size_t begin = row.find_first_not_of(' ');
  while (begin != std::string::npos) {
    const std::size_t end = std::min(row.find(gap, begin), row.size());
    out.push_back(row.substr(begin, end - begin));
    begin = row.find_first_not_of(' ', end);
  }
  return out;
}

/// Whether a quote that begins a cell is not closed. An inch, as in "Extension (")", begins none.
bool is_open(const std::string& row) {
  constexpr const char* kBeforeCell = ",;|\t ";
  bool open = false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] != '"') continue;
    const bool begins = i == 0 || std::strchr(kBeforeCell, row[i - 1]) != nullptr;
    if (open && i + 1 < row.size() && row[i + 1] == '"')
      ++i;
    else
      open = !open && begins;
  }
  return open;
}

}  // namespace

void join_quoted(std::vector<std::string>& rows) {
  constexpr std::size_t kMost = 8;  // lines behind the first one
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!is_open(rows[i])) continue;
    std::string whole = rows[i];
    for (std::size_t j = i + 1; j < rows.size() && j <= i + kMost; ++j) {
      whole += ' ' + trimmed(rows[j]);
      if (is_open(whole)) continue;
      rows[i] = whole;
      for (std::size_t k = i + 1; k <= j; ++k) rows[k].clear();
      break;
    }
  }
}

std::string trimmed(std::string_view text) {
  constexpr const char* kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin));
}

bool has_digit(const std::string& cell) { return std::any_of(cell.begin(), cell.end(), is_digit); }

bool are_empty(const Cells& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); });
}

Cells split(const std::string& row, char separator) {
  if (separator == ' ') return words(trimmed(row), " ");
  Cells cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool twice = quoted && row[i] == '"' && i + 1 < row.size() && row[i + 1] == '"';
    if (twice)
      cells.back() += row[i++];
    else if (row[i] == '"' && (quoted || trimmed(cells.back()).empty()))  // elsewhere it may be an inch
      quoted = !quoted;
    else if (row[i] == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += row[i];
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

Cells split_names(const std::string& row) {
  const std::string text = trimmed(row);
  if (text.find("  ") != std::string::npos) return words(text, "  ");
  Cells out;
  for (const std::string& word : words(text, " ")) {
    if (!out.empty() && (word.front() == '(' || word.front() == '['))
      out.back() += ' ' + word;
    else
      out.push_back(word);
  }
  return out;
}

void DecimalMark::look_at(const std::string& cell) {
  if (is_told()) return;
  const std::size_t point = cell.rfind('.'), comma = cell.rfind(',');
  if (point != std::string::npos && comma != std::string::npos) {
    told_ = point > comma ? '.' : ',';
  } else if (point != comma) {
    const char mark = point != std::string::npos ? '.' : ',';
    const bool twice = std::count(cell.begin(), cell.end(), mark) > 1;
    if (twice)
      told_ = mark == '.' ? ',' : '.';
    else if (!without_groups(cell, mark))
      told_ = mark;
    else if (unclear_.empty())
      unclear_ = cell;
  }
}

std::optional<double> number(const std::string& cell, char mark) {
  const std::size_t decimals = std::min(cell.find(mark), cell.size());
  std::optional<std::string> text = cell.substr(0, decimals);
  for (const char groups : {mark == '.' ? ',' : '.', ' ', '\''})
    if (text) text = without_groups(*text, groups);
  if (!text) return std::nullopt;
  if (decimals < cell.size()) *text += '.' + cell.substr(decimals + 1);
  return has_digit(*text) ? parse_number(*text) : std::nullopt;
}

bool is_number(const std::string& cell) { return number(cell, '.') || number(cell, ','); }

}  // namespace knot_utm
