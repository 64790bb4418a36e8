// SPDX-License-Identifier: Apache-2.0
#include "real_time/device_scene/upload.h"

namespace luciole {

Result<Upload> Upload::begin(gpu::Device& device) {
  Result<gpu::CommandList> list = gpu::CommandList::create(device);
  if (!list) return list.error();
  list->begin_pass("transfer");
  return Upload(device, std::move(*list));
}

Status Upload::reserve(std::uint64_t bytes, gpu::Buffer& made) {
  Result<gpu::Buffer> kept = gpu::Buffer::create(*device_, bytes, gpu::BufferUse::device);
  if (!kept) return kept.error();
  made = std::move(*kept);
  if (bytes == 0) return Done{};
  Result<gpu::Buffer> staged = gpu::Buffer::create(*device_, bytes, gpu::BufferUse::upload);
  if (!staged) return staged.error();
  list_.copy(*staged, made, bytes);
  staged_.push_back(std::move(*staged));
  return Done{};
}

}  // namespace luciole
