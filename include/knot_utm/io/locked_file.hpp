#pragma once

#include <string>
#include <utility>

namespace knot_utm {

/// An open file that nobody else may hold at the same time, in this process or another; let go at the end of its life,
/// or of the process. Where the file system knows no locks it keeps nobody out.
class LockedFile {
 public:
  /// Opens with the flags of open(2). Waits up to `patience` [s] for another to let go. Not open, and errno set, where
  /// that cannot be done; EWOULDBLOCK: another holds it.
  LockedFile(const std::string& file, int flags, double patience);
  ~LockedFile();
  LockedFile(LockedFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;
  LockedFile& operator=(LockedFile&&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  bool has_name() const;  ///< the file was not removed

 private:
  int descriptor_;
};

}  // namespace knot_utm
