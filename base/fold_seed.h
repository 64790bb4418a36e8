// SPDX-License-Identifier: Apache-2.0
// Seeds and frame numbers have 64 bits, the equations' random numbers take 32: small numbers stay themselves.
#pragma once
#include <cstdint>

namespace luciole {

inline std::uint32_t folded(std::uint64_t value) {
  return static_cast<std::uint32_t>(value) ^ (static_cast<std::uint32_t>(value >> 32) * 0x9e3779b9u);
}

}  // namespace luciole
