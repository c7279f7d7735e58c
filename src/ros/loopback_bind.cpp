// roscpp's XML-RPC server listens on every address, whatever ROS_HOSTNAME says (XmlRpcSocket::bind takes none). Its
// call of bind() finds this one, in the node's own library or preloaded, before that of the C library.
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace {

/// As rosgraph's get_bind_address reads the environment.
bool loopback_is_wanted() {
  const char* host = std::getenv("ROS_HOSTNAME");
  if (host == nullptr) host = std::getenv("ROS_IP");
  return host != nullptr &&
         (std::strcmp(host, "localhost") == 0 || std::strncmp(host, "127.", 4) == 0 || std::strcmp(host, "::1") == 0);
}

}  // namespace

extern "C" int bind(int socket, const sockaddr* address, socklen_t length) noexcept {
  sockaddr_storage own{};
  if (length <= sizeof own && loopback_is_wanted()) {
    std::memcpy(&own, address, length);
    auto* v4 = reinterpret_cast<sockaddr_in*>(&own);
    auto* v6 = reinterpret_cast<sockaddr_in6*>(&own);
    if (own.ss_family == AF_INET && v4->sin_addr.s_addr == htonl(INADDR_ANY)) {
      v4->sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    } else if (own.ss_family == AF_INET6 && IN6_IS_ADDR_UNSPECIFIED(&v6->sin6_addr)) {
      v6->sin6_addr = in6addr_loopback;
    }
    address = reinterpret_cast<const sockaddr*>(&own);
  }
  return static_cast<int>(syscall(SYS_bind, socket, address, length));
}
