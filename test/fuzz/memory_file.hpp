#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "fuzz/target.hpp"

namespace knot_utm {

/// A file that is never on a disk, for a parser that is given a file's name.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
    promise(descriptor_ >= 0, "memory for a file");
    promise(write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size()), "it is written");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace knot_utm
