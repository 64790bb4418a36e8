// SPDX-License-Identifier: Apache-2.0
// Which parts of a stretch of memory are free: first fit, neighbours merge. Knows nothing of Vulkan.
#pragma once
#include <cstdint>
#include <map>
#include <optional>

namespace luciole::gpu {

class FreeList {
 public:
  explicit FreeList(std::uint64_t bytes) : bytes_(bytes), free_{{0, bytes}} {}

  // Where `bytes` > 0 found room at a multiple of `alignment`, a power of two; none if nowhere.
  std::optional<std::uint64_t> take(std::uint64_t bytes, std::uint64_t alignment);

  // Gives back what take(bytes, ...) gave.
  void give_back(std::uint64_t offset, std::uint64_t bytes);

  bool unused() const { return free_.size() == 1 && free_.begin()->second == bytes_; }

 private:
  std::uint64_t bytes_;
  std::map<std::uint64_t, std::uint64_t> free_;  // begin -> bytes; no two touch
};

}  // namespace luciole::gpu
