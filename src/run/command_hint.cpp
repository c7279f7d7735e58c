#include "knot_utm/run/command_hint.hpp"

#include <filesystem>
#include <system_error>

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

std::string from_here(const fs::path& file) {
  std::error_code error;
  const fs::path here = fs::current_path(error), near = file.lexically_proximate(here);
  return error || near.empty() || *near.begin() == ".." ? file.string() : near.string();
}

}  // namespace

std::string command_line(int argc, const char* const* argv) { return command_line({argv, argv + argc}); }

std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

std::string program_beside(const std::string& name) {
  std::error_code error;
  const fs::path running = fs::read_symlink("/proc/self/exe", error);
  return error ? name : from_here(running.parent_path() / name);
}

}  // namespace knot_utm
