#pragma once

#include <dirent.h>

#include <memory>
#include <string>

namespace knot_utm {

/// The folder of a run or a batch, which no other program writes to as long as this object is there. The operating
/// system holds the claim, and lets it go when the process ends, however it does.
class ClaimedFolder {
 public:
  /// Makes the folder where it is not there, and claims it whatever it holds. Throws InvalidInput (key "--out") where
  /// it cannot be made, or another program is writing to it.
  explicit ClaimedFolder(const std::string& folder);

  /// The folder or, where that holds a run already (complete, cut off or under way), the first free one of `folder-2`,
  /// `folder-3` and so on, so that nothing measured is overwritten. Throws InvalidInput where it cannot be made.
  static ClaimedFolder first_free(const std::string& folder);

  const std::string& path() const { return path_; }

 private:
  ClaimedFolder() : folder_(nullptr, &closedir) {}
  bool claim(const std::string& folder);

  std::string path_;
  std::unique_ptr<DIR, int (*)(DIR*)> folder_;
};

/// The folder that ClaimedFolder::first_free would use now.
std::string free_folder(const std::string& folder);

/// The notice for the user when a run goes to another folder than the one asked for.
std::string moved_notice(const std::string& asked, const std::string& used);

/// Makes the link `out/latest` lead to the folder of a run that stands in a folder called `out`, such as `out/tighten`
/// or `out/tighten-2`, so that a command that reads `out/latest` reads the run that was written last. Returns the path
/// of the link. Returns an empty text, and makes no link, where the run stands elsewhere, where something that is no
/// link has that name, or where the file system has no links.
std::string point_latest_to(const std::string& folder);

}  // namespace knot_utm
