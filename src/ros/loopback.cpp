#include "knot_utm/ros/loopback.hpp"

#include <arpa/inet.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <ros/master.h>
#include <ros/network.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

/// Who may be reached from where only this machine should reach it, and what to do about it.
InvalidInput reachable(const std::string& who, const std::string& address, const std::string& remedy) {
  return InvalidInput::sentence(who, address,
                                who + " can be reached from other machines (" + shown(address) +
                                    "), and ROS 1 has no authentication: " + remedy + ", or allow it by network:=true");
}

constexpr char kLoopbackDevice[] = "lo";

bool is_loopback(const sockaddr_storage& address) {
  if (address.ss_family == AF_INET) {
    return (ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr) >> 24) == 127;
  }
  const in6_addr& v6 = reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
  return IN6_IS_ADDR_LOOPBACK(&v6) || (IN6_IS_ADDR_V4MAPPED(&v6) && v6.s6_addr[12] == 127);
}

std::string text_of(const sockaddr_storage& address) {
  char text[NI_MAXHOST] = "";
  char port[NI_MAXSERV] = "";
  getnameinfo(reinterpret_cast<const sockaddr*>(&address), sizeof address, text, sizeof text, port, sizeof port,
              NI_NUMERICHOST | NI_NUMERICSERV);
  return std::string(text) + ":" + port;
}

/// The addresses that a name stands for are all loopback.
bool names_loopback(const std::string& host) {
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, nullptr, &found) != 0) return false;
  bool all = true;
  for (const addrinfo* a = found; a != nullptr; a = a->ai_next) {
    sockaddr_storage address{};
    std::memcpy(&address, a->ai_addr, a->ai_addrlen);
    all = all && is_loopback(address);
  }
  freeaddrinfo(found);
  return all;
}

/// A socket of this process that listens on an address of more than this machine.
struct OpenSocket {
  int descriptor;
  std::string address;
};

std::vector<OpenSocket> open_sockets() {
  std::vector<OpenSocket> found;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc/self/fd")) {
    const int fd = std::atoi(entry.path().filename().c_str());
    int listens = 0;
    socklen_t length = sizeof listens;
    if (getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listens, &length) != 0 || listens == 0) continue;
    char device[IFNAMSIZ] = "";
    length = sizeof device;
    if (getsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, device, &length) == 0 && std::strcmp(device, kLoopbackDevice) == 0)
      continue;
    sockaddr_storage address{};
    length = sizeof address;
    if (getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length) != 0) continue;
    if ((address.ss_family == AF_INET || address.ss_family == AF_INET6) && !is_loopback(address))
      found.push_back({fd, text_of(address)});
  }
  return found;
}

/// An address of /proc/net/tcp or tcp6: words of 32 bits, each as this machine writes the number it makes.
bool is_loopback_in_table(const std::string& text) {
  sockaddr_storage address{};
  const bool v4 = text.size() == 8;
  address.ss_family = v4 ? AF_INET : AF_INET6;
  for (std::size_t word = 0; 8 * word + 8 <= text.size() && word < 4; ++word) {
    const auto bits = static_cast<std::uint32_t>(std::stoul(text.substr(8 * word, 8), nullptr, 16));
    if (v4) {
      reinterpret_cast<sockaddr_in&>(address).sin_addr.s_addr = bits;
    } else {
      std::memcpy(reinterpret_cast<sockaddr_in6&>(address).sin6_addr.s6_addr + 4 * word, &bits, sizeof bits);
    }
  }
  return is_loopback(address);
}

/// Whether somebody on this machine listens on the port on an address that others reach. A line of the tables is
/// "0: ADDRESS:PORT PEER:PORT STATE ...", 0A: listens.
bool is_open_port(unsigned port) {
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream in(table);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::istringstream words(line);
      std::string number, local, peer, state;
      words >> number >> local >> peer >> state;
      const std::size_t colon = local.find(':');
      if (state != "0A" || colon == std::string::npos || std::stoul(local.substr(colon + 1), nullptr, 16) != port) {
        continue;
      }
      if (!is_loopback_in_table(local.substr(0, colon))) return true;
    }
  }
  return false;
}

}  // namespace

void prefer_loopback() {
  if (std::getenv("ROS_HOSTNAME") == nullptr && std::getenv("ROS_IP") == nullptr)
    setenv("ROS_HOSTNAME", "localhost", 1);
}

void stay_on_loopback() {
  for (const OpenSocket& one : open_sockets())
    setsockopt(one.descriptor, SOL_SOCKET, SO_BINDTODEVICE, kLoopbackDevice, sizeof kLoopbackDevice);
}

void require_loopback() {
  const std::string& host = ros::network::getHost();
  if (!names_loopback(host)) throw reachable("this node", host, "set ROS_HOSTNAME=localhost");
  const std::vector<OpenSocket> open = open_sockets();
  if (!open.empty())
    throw reachable("a socket of this node", open.front().address,
                    "run it on Linux 5.7 or later, which can prevent that");
  if (!names_loopback(ros::master::getHost()))
    throw reachable("the ROS master", ros::master::getURI(), "set ROS_MASTER_URI=http://localhost:11311");
  if (is_open_port(ros::master::getPort())) {
    throw reachable("the ROS master", "at every address of this machine", "start it with ROS_HOSTNAME=localhost");
  }
}

bool master_answers() {
  addrinfo* found = nullptr;
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  const std::string port = std::to_string(ros::master::getPort());
  if (getaddrinfo(ros::master::getHost().c_str(), port.c_str(), &hints, &found) != 0) return false;
  bool answers = false;
  for (const addrinfo* a = found; a != nullptr && !answers; a = a->ai_next) {
    const int fd = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, 0);
    if (fd < 0) continue;
    answers = connect(fd, a->ai_addr, a->ai_addrlen) == 0;
    close(fd);
  }
  freeaddrinfo(found);
  return answers;
}

}  // namespace knot_utm
