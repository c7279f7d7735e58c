#include "knot_utm/io/locked_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace knot_utm {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTryAgain(20);
constexpr mode_t kMode = 0666;

}  // namespace

LockedFile::LockedFile(const std::string& file, int flags, double patience) {
  const auto end = Clock::now() + std::chrono::duration<double>(patience);
  for (;;) {
    descriptor_ = open(file.c_str(), flags | O_CLOEXEC, kMode);
    if (descriptor_ < 0) return;
    const bool held = flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    // The one before may have removed it meanwhile.
    if (!held && has_name()) return;
    close(descriptor_);
    descriptor_ = -1;
    errno = EWOULDBLOCK;
    if (held && Clock::now() >= end) return;
    if (held) std::this_thread::sleep_for(kTryAgain);
  }
}

LockedFile::~LockedFile() {
  if (is_open()) close(descriptor_);
}

bool LockedFile::has_name() const {
  struct stat status {};
  return fstat(descriptor_, &status) == 0 && status.st_nlink > 0;
}

}  // namespace knot_utm
