#include "knot_utm/run/claimed_folder.hpp"

#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

ClaimedFolder::ClaimedFolder(const std::string& folder) : ClaimedFolder() {
  if (!claim(folder))
    throw InvalidInput::sentence("--out", folder, "another run is writing to the folder " + shown(folder));
}

ClaimedFolder ClaimedFolder::first_free(const std::string& folder) {
  for (int number = 1;; ++number) {
    const std::string candidate = numbered_folder(folder, number);
    ClaimedFolder claimed;
    // Another run may have written its results between the look and the claim.
    if (!holds_run(candidate) && claimed.claim(candidate) && !holds_run(candidate)) return claimed;
  }
}

bool ClaimedFolder::claim(const std::string& folder) {
  make_run_folder(folder);
  path_ = folder;
  folder_.reset(opendir(folder.c_str()));
  if (!folder_) throw InvalidInput::cannot_write("--out", folder, errno);
  // A file system without locks leaves it to samples.csv, which nobody begins twice.
  return flock(dirfd(folder_.get()), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

std::string free_folder(const std::string& folder) {
  int number = 1;
  while (holds_run(numbered_folder(folder, number))) ++number;
  return numbered_folder(folder, number);
}

std::string moved_notice(const std::string& asked, const std::string& used) {
  return asked + " holds a run already, which stays as it is; this one is written to " + used;
}

std::string point_latest_to(const std::string& folder) {
  namespace fs = std::filesystem;
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
