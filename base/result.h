// SPDX-License-Identifier: Apache-2.0
// A value, or one sentence for the user saying why there is none. Failures of the outside world (files, devices)
// travel through the rooms' doors as Result; mistakes of ours are assertions (assert.h).
#pragma once
#include <string>
#include <utility>
#include <variant>

namespace luciole {

// The program's exit codes; the value is what the process returns.
enum class ErrorKind : int { failed = 1, usage = 2, bad_scene = 3, out_of_memory = 4 };

struct Error {
  ErrorKind kind = ErrorKind::failed;
  std::string message;  // one sentence: file, object, what to do; no trailing newline
};

// The names are those of std::expected (C++23), so that it can take over later.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}
  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  T& value() { return std::get<0>(state_); }
  const T& value() const { return std::get<0>(state_); }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

struct Done {};  // the value of an operation that only succeeds or fails
using Status = Result<Done>;

}  // namespace luciole
