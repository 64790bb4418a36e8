// SPDX-License-Identifier: Apache-2.0
// A TCP connection that only sends and never waits for long.
#pragma once
#include <optional>
#include <string>

namespace luciole {

class Connection {
 public:
  // Empty if nobody answers within a second.
  static std::optional<Connection> open(const std::string& host, const std::string& port);
  Connection(Connection&& other) noexcept;
  Connection& operator=(Connection&&) = delete;
  ~Connection();

  // False if the other side is gone, or took nothing for two seconds.
  bool send(const std::string& bytes);
  // Whether the other side has not closed it, as far as is known here.
  bool is_open() const;

 private:
  explicit Connection(int socket) : socket_(socket) {}
  int socket_;
};

}  // namespace luciole
