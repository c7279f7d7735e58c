#include "knot_utm/words/invalid_input.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <system_error>

namespace knot_utm {
namespace {

constexpr std::size_t kLongest = 64;  // no name is longer

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The optimal string alignment distance: each swap of neighbours, addition, omission or replacement counts one.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = above;
    above = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/// How many mistakes a name of this length may have: more would make it another name.
std::size_t mistakes(std::size_t length) { return length < 3 ? 0 : length < 6 ? 1 : length < 10 ? 2 : 3; }

/// Not a reason of its own: whoever asks was not content with what the file holds.
constexpr const char* kReadable = "it is not a plain file with text in it";

std::string why_unreadable(const std::string& file) {
  // A pipe without a writer would keep a plain open waiting.
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return errno == ENOENT ? "no such file" : reason_of(errno);
  struct stat status {};
  const bool is_folder = fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode);
  close(descriptor);
  return is_folder ? reason_of(EISDIR) : kReadable;
}

std::string question(const std::string& nearest) { return nearest.empty() ? "" : "; did you mean " + nearest + "?"; }

}  // namespace

std::string listed(const std::vector<std::string>& names, const char* before_last) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) all += i + 1 == names.size() ? before_last : ", ";
    all += names[i];
  }
  return all;
}

std::string nearest_name(const std::string& given, const std::vector<std::string>& known) {
  if (given.size() > kLongest) return {};
  std::string nearest;
  std::size_t fewest = mistakes(given.size()) + 1;
  for (const std::string& name : known) {
    const std::size_t apart = distance(lower(given), lower(name));
    if (apart < fewest) {
      fewest = apart;
      nearest = name;
    }
  }
  return nearest;
}

std::string shown(const std::string& text) {
  constexpr std::size_t kLongestLine = 500;
  std::string line = text.substr(0, kLongestLine);
  for (char& c : line) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) c = ' ';
  }
  return text.size() > kLongestLine ? line + "..." : line;
}

std::string reason_of(int error) {
  std::string reason = std::generic_category().message(error);
  const bool word = reason.size() > 1 && std::islower(static_cast<unsigned char>(reason[1])) != 0;
  if (word) reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
  return reason;
}

InvalidInput::InvalidInput(const Place& place, const std::string& line)
    : std::runtime_error(line), file(place.file), key(place.key) {}

InvalidInput::InvalidInput(const std::string& key_, const std::string& value, const std::string& allowed)
    : InvalidInput(Place{"", key_}, shown(key_) + " is " + shown(value) + ", but must be " + allowed) {}

InvalidInput::InvalidInput(const std::string& file_, const std::string& key_, const std::string& value,
                           const std::string& allowed)
    : InvalidInput(InvalidInput(key_, value, allowed).in_file(file_)) {}

InvalidInput InvalidInput::missing(const std::string& key, const std::string& give) {
  return sentence(key, shown(key) + " is missing: give " + give);
}

InvalidInput InvalidInput::unknown_key(const std::string& section, const std::string& key,
                                       const std::vector<std::string>& known, const std::string& of) {
  const std::string prefix = section.empty() ? "" : section + ".", nearest = nearest_name(key, known);
  std::string hint = question(nearest.empty() ? "" : prefix + nearest);
  if (nearest.empty() && known.empty()) hint = "; " + section + " takes no keys";
  if (nearest.empty() && !known.empty())
    hint = "; the keys of " + (section.empty() ? of : section) + " are " + listed(known, " and ");
  return sentence(prefix + key, shown(prefix + key) + " is no key of " + of + shown(hint));
}

InvalidInput InvalidInput::unknown_name(const std::string& key, const std::string& value, const std::string& allowed,
                                        const std::vector<std::string>& known) {
  return sentence(
      key, shown(key) + " is \"" + shown(value) + "\", but must be " + allowed + question(nearest_name(value, known)));
}

InvalidInput InvalidInput::cannot_read(const std::string& file, const std::string& key) {
  const std::string line = "cannot read " + shown(file) + ": " + why_unreadable(file);
  if (key.empty()) return {Place{file, "file"}, line};
  return sentence(key, shown(key) + ": " + line);
}

InvalidInput InvalidInput::cannot_write(const std::string& key, const std::string& file, int error) {
  return sentence(key, "cannot write " + shown(file) + ": " + reason_of(error));
}

InvalidInput InvalidInput::sentence(const std::string& key, const std::string& text) { return {Place{"", key}, text}; }

InvalidInput InvalidInput::in_file(const std::string& name) const {
  if (!file.empty() || name.empty() || key.rfind("--", 0) == 0) return *this;
  return {Place{name, key}, shown(name) + ": " + what()};
}

}  // namespace knot_utm
