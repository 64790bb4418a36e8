// SPDX-License-Identifier: Apache-2.0
#include "real_time/composition/device_composition_pass.h"

#include "base/assert.h"

namespace luciole {

extern const gpu::ShaderCode compose_pixels;

namespace {

address_ address_or_zero(const gpu::Buffer* buffer) { return buffer != nullptr ? buffer->address() : 0; }

}  // namespace

Result<DeviceCompositionPass> DeviceCompositionPass::create(gpu::Device& device) {
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, compose_pixels, sizeof(CompositionPush));
  if (!kernel) return kernel.error();
  DeviceCompositionPass pass;
  pass.kernel_ = std::move(*kernel);
  return pass;
}

void DeviceCompositionPass::record(gpu::CommandList& list, const CompositionBuffers& buffers, std::uint32_t width,
                                   std::uint32_t height) const {
  LUCIOLE_ASSERT_EQ(buffers.indirect != nullptr && buffers.sums != nullptr, false);
  LUCIOLE_ASSERT_EQ(buffers.many != nullptr && buffers.many_sums != nullptr, false);
  CompositionPush push{};
  push.pixels = buffers.pixels->address(), push.surfaces = buffers.surfaces->address();
  push.picture = buffers.picture->address(), push.counts = buffers.counts->address();
  push.direct = address_or_zero(buffers.direct);
  push.indirect = address_or_zero(buffers.indirect), push.many = address_or_zero(buffers.many);
  push.sums = address_or_zero(buffers.sums), push.more_sums = address_or_zero(buffers.more_sums);
  push.many_sums = address_or_zero(buffers.many_sums);
  push.weight = buffers.weight;
  push.width = width, push.height = height;
  push.with_emission = buffers.with_emission ? 1 : 0;
  list.fill(*buffers.counts, 0);
  list.barrier();
  list.dispatch(kernel_, push, (width + kPictureGroupColumns - 1) / kPictureGroupColumns,
                (height + kPictureGroupRows - 1) / kPictureGroupRows);
}

}  // namespace luciole
