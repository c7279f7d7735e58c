#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace knot_utm {

/// A folder of files that could all be made again, such as specimens that are tied. Each is found by a text that says
/// what it was made from. Several processes may use a folder at the same time, since a file appears as a whole. Nothing
/// here stops a run: a file that cannot be read is as good as none, and one that cannot be written is not kept.
class CacheFolder {
 public:
  /// `limit`: of all files together [bytes]. Those that were used least recently are removed first.
  CacheFolder(std::string folder, std::uint64_t limit);

  /// The user's: `$KNOT_UTM_CACHE_DIR`, else `$XDG_CACHE_HOME/knot_utm`, else `~/.cache/knot_utm`. The environment
  /// variable `KNOT_UTM_CACHE_LIMIT` has its limit [MiB]; unless set it is 1024. Empty where that is 0, or where there
  /// is no home. Throws InvalidInput (key "KNOT_UTM_CACHE_LIMIT") where it is not a whole number.
  static std::optional<CacheFolder> of_user();

  const std::string& folder() const { return folder_; }

  /// The file of what is made from this. It need not be there.
  std::string file_of(const std::string& made_from) const;

  /// The content of that file, which then counts as used now. Empty where it cannot be read.
  std::optional<std::string> read(const std::string& made_from) const;

  /// Writes that file, or replaces it, unless it is larger than the limit.
  void write(const std::string& made_from, const std::string& content) const;

 private:
  void make_room(std::uint64_t bytes) const;

  std::string folder_;
  std::uint64_t limit_;
};

}  // namespace knot_utm
