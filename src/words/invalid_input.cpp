#include "knot_utm/words/invalid_input.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <system_error>

#include "knot_utm/words/known_names.hpp"

namespace knot_utm {
namespace {

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

std::string shown(const std::string& text) {
  constexpr std::size_t kLongest = 500;
  std::string line = text.substr(0, kLongest);
  for (char& c : line) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) c = ' ';
  }
  return text.size() > kLongest ? line + "..." : line;
}

std::string reason_of(int error) {
  std::string reason = std::generic_category().message(error);
  const bool word = reason.size() > 1 && std::islower(static_cast<unsigned char>(reason[1])) != 0;
  if (word) reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
  return reason;
}

InvalidInput::InvalidInput(const Parts& parts, const std::string& line)
    : std::runtime_error(line), file(parts.file), key(parts.key), value(parts.value), allowed(parts.allowed) {}

InvalidInput::InvalidInput(const std::string& key_, const std::string& value_, const std::string& allowed_)
    : InvalidInput(Parts{"", key_, value_, allowed_},
                   shown(key_) + " is " + shown(value_) + ", but must be " + allowed_) {}

InvalidInput::InvalidInput(const std::string& file_, const std::string& key_, const std::string& value_,
                           const std::string& allowed_)
    : InvalidInput(InvalidInput(key_, value_, allowed_).in_file(file_)) {}

InvalidInput InvalidInput::missing(const std::string& key, const std::string& give) {
  return {Parts{"", key, "nothing", give}, shown(key) + " is missing: give " + give};
}

InvalidInput InvalidInput::unknown_key(const std::string& section, const std::string& key, const std::string& value,
                                       const std::vector<std::string>& known, const std::string& of) {
  const std::string prefix = section.empty() ? "" : section + ".";
  const std::string path = prefix + key;
  const std::string nearest = nearest_name(key, known);
  std::string hint = question(nearest.empty() ? "" : prefix + nearest);
  if (nearest.empty() && known.empty()) hint = "; " + section + " takes no keys";
  if (nearest.empty() && !known.empty())
    hint = "; the keys of " + (section.empty() ? of : section) + " are " + listed(known, " and ");
  return {Parts{"", path, value, listed(known, " and ") + " (no other keys)"},
          shown(path) + " is no key of " + of + shown(hint)};
}

InvalidInput InvalidInput::unknown_name(const std::string& key, const std::string& value, const std::string& allowed,
                                        const std::vector<std::string>& known) {
  return {Parts{"", key, value, allowed},
          shown(key) + " is \"" + shown(value) + "\", but must be " + allowed + question(nearest_name(value, known))};
}

InvalidInput InvalidInput::cannot_read(const std::string& file, const std::string& key) {
  const std::string line = "cannot read " + shown(file) + ": " + why_unreadable(file);
  if (key.empty()) return {Parts{file, "file", file, "a file that can be read"}, line};
  return {Parts{"", key, file, "a file that can be read"}, shown(key) + ": " + line};
}

InvalidInput InvalidInput::cannot_write(const std::string& key, const std::string& file, int error) {
  return {Parts{"", key, file, "a place that can be written to"},
          "cannot write " + shown(file) + ": " + reason_of(error)};
}

InvalidInput InvalidInput::sentence(const std::string& key, const std::string& value, const std::string& text) {
  return {Parts{"", key, value, text}, text};
}

InvalidInput InvalidInput::in_file(const std::string& name) const {
  if (!file.empty() || name.empty() || key.rfind("--", 0) == 0) return *this;
  return {Parts{name, key, value, allowed}, shown(name) + ": " + what()};
}

}  // namespace knot_utm
