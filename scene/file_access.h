// SPDX-License-Identifier: Apache-2.0
// How readers get at bytes: the file itself, and files beside it that it names. A reader that works from memory (a
// fuzzer, an archive) passes its own FileReader.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace luciole {

using Bytes = std::vector<std::uint8_t>;

// Gives the content of a file named by a checked relative path (see uri.h), or a sentence without the path.
using FileReader = std::function<Result<Bytes>(const std::string& relative_path)>;

// The whole of a regular file of at most `largest` bytes; directories, pipes and devices are refused.
Result<Bytes> read_regular_file(const std::filesystem::path& path, std::uint64_t largest);

// Reads files below `folder`.
FileReader files_in(const std::filesystem::path& folder);

// Refuses every name: for scenes that must bring everything along.
FileReader no_files();

// What one scene may ask for: a small hostile file must not fill the memory. Each is far above real scenes.
struct LoadLimits {
  std::uint64_t file_bytes = std::uint64_t(4) << 30;    // each file that is read
  std::uint64_t buffer_bytes = std::uint64_t(8) << 30;  // all buffers together
  std::uint64_t vertices = std::uint64_t(1) << 28;      // of all meshes after instancing; the same for indices
  std::uint64_t texels = std::uint64_t(1) << 30;        // of all images, finest levels
  std::uint32_t image_side = 16384;                     // [texel], checked from the header before decoding
};

}  // namespace luciole
