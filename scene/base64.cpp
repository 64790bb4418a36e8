// SPDX-License-Identifier: Apache-2.0
#include "scene/base64.h"

#include <array>

namespace luciole {
namespace {

constexpr std::uint8_t kInvalid = 255;

constexpr std::array<std::uint8_t, 256> kSextetOf = [] {
  std::array<std::uint8_t, 256> table{};
  for (std::uint8_t& entry : table) entry = kInvalid;
  std::uint8_t next = 0;
  for (char c = 'A'; c <= 'Z'; ++c) table[static_cast<unsigned char>(c)] = next++;
  for (char c = 'a'; c <= 'z'; ++c) table[static_cast<unsigned char>(c)] = next++;
  for (char c = '0'; c <= '9'; ++c) table[static_cast<unsigned char>(c)] = next++;
  table['+'] = 62;
  table['/'] = 63;
  return table;
}();

}  // namespace

std::optional<std::vector<std::uint8_t>> decode_base64(std::string_view text) {
  if (text.size() % 4 == 0) {
    if (text.ends_with("==")) {
      text.remove_suffix(2);
    } else if (text.ends_with('=')) {
      text.remove_suffix(1);
    }
  }
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const std::uint8_t sextet = kSextetOf[static_cast<unsigned char>(c)];
    if (sextet == kInvalid) return std::nullopt;
    bits = (bits << 6 | sextet) & 0xffffu;
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count & 0xffu));
    }
  }
  if ((bits & ((1u << bit_count) - 1)) != 0) return std::nullopt;
  return bytes;
}

}  // namespace luciole
