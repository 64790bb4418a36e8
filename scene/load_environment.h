// SPDX-License-Identifier: Apache-2.0
// Light from all around: Radiance's .hdr pictures.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "base/result.h"
#include "scene/file_access.h"
#include "scene/scene.h"

namespace luciole {

// An equirectangular picture (G. Ward, "Real Pixels", Graphics Gems II, 1991: shared exponents, run lengths), rows from
// the top, at most 16,384 pixels a side. The radiance factor of the result is 1.
Result<Environment> load_environment(const std::filesystem::path& path);

// The same from memory; `name` stands for the file in messages.
Result<Environment> read_radiance_picture(std::span<const std::uint8_t> file, const std::string& name);

}  // namespace luciole
