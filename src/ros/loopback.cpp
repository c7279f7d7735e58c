#include "knot_utm/ros/loopback.hpp"

#include <sys/socket.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

void prefer_loopback() {
  if (std::getenv("ROS_HOSTNAME") == nullptr && std::getenv("ROS_IP") == nullptr)
    setenv("ROS_HOSTNAME", "localhost", 1);
}

void stay_on_loopback() {
  constexpr char kLoopbackDevice[] = "lo";
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int fd = std::atoi(entry.path().filename().c_str());
    int listens = 0;
    socklen_t length = sizeof listens;
    if (getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listens, &length) != 0 || listens == 0) continue;
    if (setsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, kLoopbackDevice, sizeof kLoopbackDevice) != 0)
      throw InvalidInput::sentence("network", "this node cannot be kept from other machines (" + reason_of(errno) +
                                                  "), and ROS 1 has no authentication: allow it by network:=true");
  }
}

}  // namespace knot_utm
