#pragma once

#include <string>
#include <utility>

namespace knot_utm {

/// An open file with an exclusive lock: no other LockedFile can hold it at the same time, in this process or another.
/// The lock is released when the object is destroyed or the process ends. On a file system without locks it excludes
/// nobody.
class LockedFile {
 public:
  /// Opens the file with the flags of open(2). Waits up to `patience` [s] for another holder to release it. On failure
  /// the file is not open and errno is set; EWOULDBLOCK means that another holds it.
  LockedFile(const std::string& file, int flags, double patience);
  ~LockedFile();
  LockedFile(LockedFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;
  LockedFile& operator=(LockedFile&&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  bool has_name() const;  ///< whether the file still has a name, that is, was not removed

 private:
  int descriptor_;
};

}  // namespace knot_utm
