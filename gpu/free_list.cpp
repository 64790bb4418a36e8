// SPDX-License-Identifier: Apache-2.0
#include "gpu/free_list.h"

#include <iterator>

#include "base/assert.h"

namespace luciole::gpu {

std::optional<std::uint64_t> FreeList::take(std::uint64_t bytes, std::uint64_t alignment) {
  for (auto piece = free_.begin(); piece != free_.end(); ++piece) {
    const std::uint64_t begin = piece->first, end = begin + piece->second;
    const std::uint64_t offset = (begin + alignment - 1) & ~(alignment - 1);
    if (offset > end || end - offset < bytes) continue;
    free_.erase(piece);
    if (offset > begin) free_.emplace(begin, offset - begin);
    if (end > offset + bytes) free_.emplace(offset + bytes, end - offset - bytes);
    return offset;
  }
  return std::nullopt;
}

void FreeList::give_back(std::uint64_t offset, std::uint64_t bytes) {
  const auto [piece, is_new] = free_.emplace(offset, bytes);
  LUCIOLE_ASSERT_EQ(is_new, true);
  if (const auto next = std::next(piece); next != free_.end() && offset + bytes == next->first) {
    piece->second += next->second;
    free_.erase(next);
  }
  if (piece == free_.begin()) return;
  if (const auto before = std::prev(piece); before->first + before->second == offset) {
    before->second += piece->second;
    free_.erase(piece);
  }
}

}  // namespace luciole::gpu
