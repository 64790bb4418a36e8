// SPDX-License-Identifier: Apache-2.0
#include "offline/display/connection.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace luciole {
namespace {

constexpr int kConnectMs = 1000, kSendMs = 2000;

bool is_ready_to_write(int socket, int timeout_ms) {
  pollfd wanted{socket, POLLOUT, 0};
  int ready = 0;
  do ready = poll(&wanted, 1, timeout_ms);
  while (ready < 0 && errno == EINTR);
  return ready == 1 && (wanted.revents & (POLLERR | POLLHUP | POLLNVAL)) == 0;
}

// -1 if it fails.
int connect_to(const addrinfo& address) {
  const int socket =
      ::socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, address.ai_protocol);
  if (socket < 0) return -1;
  if (connect(socket, address.ai_addr, address.ai_addrlen) == 0) return socket;
  if (errno == EINPROGRESS && is_ready_to_write(socket, kConnectMs)) {
    int fault = 0;
    socklen_t size = sizeof(fault);
    if (getsockopt(socket, SOL_SOCKET, SO_ERROR, &fault, &size) == 0 && fault == 0) return socket;
  }
  close(socket);
  return -1;
}

}  // namespace

std::optional<Connection> Connection::open(const std::string& host, const std::string& port) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(host.c_str(), port.c_str(), &wanted, &found) != 0) return std::nullopt;
  int socket = -1;
  for (const addrinfo* at = found; at != nullptr && socket < 0; at = at->ai_next) socket = connect_to(*at);
  freeaddrinfo(found);
  if (socket < 0) return std::nullopt;
  return Connection(socket);
}

Connection::Connection(Connection&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

Connection::~Connection() {
  if (socket_ >= 0) close(socket_);
}

bool Connection::send(const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    // No signal where the other side is gone.
    const ssize_t count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count > 0) {
      sent += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!is_ready_to_write(socket_, kSendMs)) return false;
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

bool Connection::is_open() const {
  // A viewer says nothing; should one, it is read and forgotten. Zero bytes are the end.
  char ignored[256];
  while (true) {
    const ssize_t count = recv(socket_, ignored, sizeof(ignored), MSG_DONTWAIT);
    if (count > 0) continue;
    return count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  }
}

}  // namespace luciole
