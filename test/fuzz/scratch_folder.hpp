#pragma once

#include <filesystem>
#include <string>

#include "fuzz/target.hpp"

namespace knot_utm {

/// A folder for a reader that is given a folder's name; gone at the end of the process. In memory where the system has
/// such a place.
class ScratchFolder {
 public:
  ScratchFolder() {
    const std::filesystem::path memory = "/dev/shm";
    std::error_code none;
    const bool there = std::filesystem::is_directory(memory, none);
    name_ = ((there ? memory : std::filesystem::temp_directory_path()) / "knot_utm_fuzz_XXXXXX").string();
    promise(mkdtemp(name_.data()) != nullptr, "a folder for temporary files");
  }
  ~ScratchFolder() {
    std::error_code none;
    std::filesystem::remove_all(name_, none);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace knot_utm
