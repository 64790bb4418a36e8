// SPDX-License-Identifier: Apache-2.0
// A fingerprint of values in memory: 64 bits, for telling whether two things are the same and whether a file is whole.
// It is no protection against intent.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace luciole {

class Digest {
 public:
  // Each step is a bijection of the state, and of the word: a single changed word always shows.
  void add_word(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x9fb21c651e98df25u;
    state_ ^= state_ >> 29;
  }

  void add_bytes(const void* bytes, std::size_t count) {
    const char* at = static_cast<const char*>(bytes);
    add_word(count);  // so that "ab", "c" is not "a", "bc"
    for (; count >= 8; at += 8, count -= 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, at, 8);
      add_word(word);
    }
    if (count == 0) return;
    std::uint64_t word = 0;
    std::memcpy(&word, at, count);
    add_word(word);
  }

  void add(std::string_view text) { add_bytes(text.data(), text.size()); }

  // Numbers, and vectors that consist of nothing else: padding would be hashed, too.
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_bytes(values.data(), values.size() * sizeof(T));
  }

  std::uint64_t value() const {
    std::uint64_t bits = state_ * 0xd6e8feb86659fd93u;
    bits = (bits ^ (bits >> 32)) * 0xd6e8feb86659fd93u;
    return bits ^ (bits >> 32);
  }

  std::string hexadecimal() const {
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i) text[i] = "0123456789abcdef"[value() >> (60 - 4 * i) & 15];
    return text;
  }

 private:
  std::uint64_t state_ = 0x6c8e9cf570932bd5u;
};

}  // namespace luciole
