// SPDX-License-Identifier: Apache-2.0
// Many images decoded at once: what glTF and OBJ readers hand over after the geometry.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene/file_access.h"
#include "scene/scene.h"

namespace luciole {

// One image file and how its colours are meant: both pyramids are built if both meanings occur.
struct ImageRequest {
  std::string label;                   // for faults
  Bytes storage;                       // holds the file if nobody else does
  std::span<const std::uint8_t> file;  // PNG or JPEG
  bool as_srgb = false, as_numbers = false;
  std::shared_ptr<const MipImage> srgb, numbers;  // the answer
};

// On all threads. Fails with the first fault in the order of the requests, on any number of threads.
void decode_images(const std::vector<ImageRequest*>& requests, const LoadLimits& limits);

}  // namespace luciole
