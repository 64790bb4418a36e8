// SPDX-License-Identifier: Apache-2.0
// How a texture is looked up: names without any code, so that kernels of an instruction set may read them.
#pragma once
#include <cstdint>

namespace luciole {

enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class MipFilter : std::uint8_t { none, nearest, linear };

}  // namespace luciole
