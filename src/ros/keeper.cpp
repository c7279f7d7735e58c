#include "knot_utm/ros/keeper.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "knot_utm/ros/journal_bag.hpp"

namespace knot_utm {
namespace {

/// Each message is a folder to be recovered behind a letter, so that none is empty as the end is.
constexpr char kWatch = '+';

std::runtime_error no_keeper(int error) { return std::runtime_error("cannot start the keeper: " + reason_of(error)); }

}  // namespace

Keeper::Keeper() {
  std::array<int, 2> ends{};
  // Whole messages, and an end once the recorder has ended, however it did.
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) throw no_keeper(errno);
  const std::string file = std::filesystem::read_symlink("/proc/self/exe").replace_filename("keeper").string();
  std::string name = file;
  std::array<char*, 2> arguments = {name.data(), nullptr};

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  const int error = posix_spawn(&process_, file.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  socket_ = ends[0];
  if (error != 0) {
    close(socket_);
    throw no_keeper(error);
  }
}

Keeper::~Keeper() {
  close(socket_);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool Keeper::watch(const std::string& folder) { return tell(folder); }

bool Keeper::release() { return tell(""); }

bool Keeper::tell(const std::string& folder) {
  const std::string message = kWatch + folder;
  return send(socket_, message.data(), message.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(message.size());
}

int keep() {
  std::array<char, PATH_MAX + 1> message{};
  std::string folder;
  for (;;) {
    const ssize_t length = recv(STDIN_FILENO, message.data(), message.size(), 0);
    if (length < 0 && errno == EINTR) continue;
    if (length <= 0) break;
    folder.assign(message.data() + 1, static_cast<std::size_t>(length) - 1);
  }
  try {
    if (folder.empty() || is_settled(folder)) return 0;
    Recovery recovery(folder, folder);
    recover_with_bag(recovery);
    std::fprintf(stderr, "the recorder died; %s\n", recovery.summary().c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "the recorder died, and its results could not be recovered: %s\n", error.what());
    return 1;
  }
}

}  // namespace knot_utm
