// SPDX-License-Identifier: Apache-2.0
// SPIR-V as part of the program (cmake/shader.cmake).
#pragma once
#include <cstddef>
#include <cstdint>

namespace luciole::gpu {

struct ShaderCode {
  const char* name;
  const std::uint32_t* words;
  std::size_t bytes;
};

}  // namespace luciole::gpu
