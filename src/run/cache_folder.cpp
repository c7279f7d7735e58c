#include "knot_utm/run/cache_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLimit = "KNOT_UTM_CACHE_LIMIT";
constexpr std::uint64_t kMebibyte = 1U << 20U;
constexpr std::uint64_t kUsualLimit = 1024, kLargestLimit = 1U << 30U;  // [MiB]
constexpr const char* kKept = ".kept";
constexpr const char* kPart = ".part";  // is being written
constexpr std::size_t kUuidLength = 36;
constexpr std::chrono::hours kLongestWrite{1};  // an older part was left by a process that was killed

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::uint64_t limit_of_user() {
  const std::string text = environment(kLimit);
  if (text.empty()) return kUsualLimit;
  std::uint64_t limit = 0;
  const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), limit);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size() || limit > kLargestLimit)
    throw InvalidInput(kLimit, shown(text), "a whole number of MiB, 0 to " + std::to_string(kLargestLimit));
  return limit;
}

/// Relative paths do not count there, says the specification of base directories.
std::string folder_of_user() {
  std::string own = environment("KNOT_UTM_CACHE_DIR");
  if (!own.empty()) return own;
  const fs::path caches = environment("XDG_CACHE_HOME"), home = environment("HOME");
  if (caches.is_absolute()) return (caches / "knot_utm").string();
  return home.is_absolute() ? (home / ".cache" / "knot_utm").string() : "";
}

/// Whether a file is one of this cache, whole or being written. Others that stand in its folder are left alone.
bool is_named_as(const char* end, const std::string& name) {
  const std::string tail(end);
  return name.size() >= kUuidLength + tail.size() && name.find_first_not_of("0123456789abcdef-") == kUuidLength &&
         name.compare(name.size() - tail.size(), tail.size(), tail) == 0;
}

/// Writes to a new name first, and gives that back; empty where it could not be written.
std::string written_part(const std::string& file, const std::string& content) {
  std::string part = file + ".XXXXXX" + kPart;
  const int descriptor = mkstemps(part.data(), static_cast<int>(std::string(kPart).size()));
  if (descriptor < 0) return {};
  close(descriptor);
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out << content;
  out.close();
  if (out) return part;
  unlink(part.c_str());
  return {};
}

}  // namespace

CacheFolder::CacheFolder(std::string folder, std::uint64_t limit) : folder_(std::move(folder)), limit_(limit) {}

std::optional<CacheFolder> CacheFolder::of_user() {
  const std::uint64_t limit = limit_of_user();
  const std::string folder = folder_of_user();
  if (limit == 0 || folder.empty()) return std::nullopt;
  return CacheFolder(folder, limit * kMebibyte);
}

std::string CacheFolder::file_of(const std::string& made_from) const {
  const boost::uuids::uuid name = boost::uuids::name_generator_sha1(boost::uuids::uuid{})(made_from);
  return (fs::path(folder_) / (boost::uuids::to_string(name) + kKept)).string();
}

std::optional<std::string> CacheFolder::read(const std::string& made_from) const {
  const std::string file = file_of(made_from);
  std::error_code error;
  // Opening anything else than a file could wait for ever.
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  const std::uint64_t size = fs::file_size(file, error);
  if (error || size > limit_) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  std::string content(size, '\0');
  if (!in.read(content.data(), static_cast<std::streamsize>(size))) return std::nullopt;
  fs::last_write_time(file, fs::file_time_type::clock::now(), error);
  return content;
}

void CacheFolder::write(const std::string& made_from, const std::string& content) const {
  if (content.size() > limit_) return;
  std::error_code error;
  fs::create_directories(folder_, error);
  const std::string file = file_of(made_from);
  make_room(content.size());
  const std::string part = written_part(file, content);
  if (part.empty()) return;
  if (fs::is_directory(file, error)) fs::remove_all(file, error);
  fs::rename(part, file, error);
  if (error) unlink(part.c_str());
}

void CacheFolder::make_room(std::uint64_t bytes) const {
  struct Kept {
    fs::file_time_type used;
    std::uint64_t size;
    fs::path path;
  };
  std::vector<Kept> all;
  std::error_code error, listing;
  for (fs::directory_iterator entry(folder_, listing), end; !listing && entry != end; entry.increment(listing)) {
    const std::string name = entry->path().filename().string();
    const bool whole = is_named_as(kKept, name), part = is_named_as(kPart, name);
    if ((!whole && !part) || !entry->is_regular_file(error)) continue;
    const Kept kept{entry->last_write_time(error), entry->file_size(error), entry->path()};
    if (error) continue;  // another process has just removed it
    if (part && fs::file_time_type::clock::now() - kept.used > kLongestWrite) fs::remove(kept.path, error);
    if (whole) all.push_back(kept);
  }
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  std::uint64_t size = bytes;
  for (const Kept& kept : all) size += kept.size;
  for (const Kept& kept : all) {
    if (size <= limit_) return;
    fs::remove(kept.path, error);
    size -= kept.size;
  }
}

}  // namespace knot_utm
