#include "knot_utm/run/latest_link.hpp"

#include <unistd.h>

#include <filesystem>
#include <system_error>

namespace knot_utm {

namespace fs = std::filesystem;

std::string point_latest_to(const std::string& folder) {
  std::error_code error;
  fs::path run = fs::absolute(folder, error).lexically_normal();
  if (!run.has_filename()) run = run.parent_path();
  if (fs::is_symlink(run, error)) run = run.parent_path() / fs::read_symlink(run, error);
  if (error || run.parent_path().filename() != "out") return {};
  const fs::path link = run.parent_path() / "latest";
  const fs::file_status there = fs::symlink_status(link, error);
  if (fs::exists(there) && !fs::is_symlink(there)) return {};
  // Another run may end at the same time: the link is replaced at once, and is never missing.
  const fs::path part = run.parent_path() / (".latest-" + std::to_string(getpid()));
  fs::remove(part, error);
  fs::create_directory_symlink(run.filename(), part, error);
  if (error) return {};
  fs::rename(part, link, error);
  if (error) {
    std::error_code ignored;
    fs::remove(part, ignored);
    return {};
  }
  return fs::path(folder).is_absolute() ? link.string() : link.lexically_proximate(fs::current_path(error)).string();
}

}  // namespace knot_utm
