// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/device_filter_pass.h"

#include "base/assert.h"
#include "real_time/filtering/bilateral_filter.h"

namespace luciole {

extern const gpu::ShaderCode filter_pixels;

namespace {

std::uint32_t groups(std::uint32_t pixels, int of_group) {
  const auto side = static_cast<std::uint32_t>(of_group);
  return (pixels + side - 1) / side;
}

void copy(Vec3 from, float (&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

}  // namespace

Result<DeviceFilterPass> DeviceFilterPass::create(gpu::Device& device, FilterRadius radius, std::uint32_t interleave) {
  LUCIOLE_ASSERT_LE(radius.x, kLargestFilterRadius);
  LUCIOLE_ASSERT_LE(radius.y, kLargestFilterRadius);
  const std::vector<std::uint32_t> constants = {static_cast<std::uint32_t>(radius.x),
                                                static_cast<std::uint32_t>(radius.y)};
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, filter_pixels, sizeof(FilterPush), constants);
  if (!kernel) return kernel.error();
  DeviceFilterPass pass;
  pass.kernel_ = std::move(*kernel);
  pass.weight_ = static_cast<float>(interleave * interleave);
  return pass;
}

void DeviceFilterPass::record(gpu::CommandList& list, const FilterBuffers& buffers,
                              const GeometryBuffer& geometry) const {
  FilterPush push{};
  push.pixels = buffers.pixels->address(), push.filtered = buffers.filtered->address();
  push.sums = buffers.sums->address(), push.counts = buffers.counts->address();
  push.more_sums = buffers.more_sums != nullptr ? buffers.more_sums->address() : 0;
  const FilterView view = filter_view(geometry);
  copy(geometry.camera.right, push.right), copy(geometry.camera.up, push.up);
  copy(geometry.camera.forward, push.forward);
  push.footprint = view.footprint, push.left_edge = view.left_edge, push.top_edge = view.top_edge;
  push.weight = buffers.weighed ? 1.0f : weight_;
  push.width = geometry.width, push.height = geometry.height;
  list.fill(*buffers.counts, 0);
  list.barrier();
  list.dispatch(kernel_, push, groups(geometry.width, kFilterGroupColumns), groups(geometry.height, kFilterGroupRows));
}

}  // namespace luciole
