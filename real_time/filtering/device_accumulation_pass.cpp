// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/device_accumulation_pass.h"

#include "real_time/shading/shading_records.h"

namespace luciole {

extern const gpu::ShaderCode accumulate_light;

namespace {

address_ address_or_zero(const gpu::Buffer* buffer) { return buffer != nullptr ? buffer->address() : 0; }

void copy(Vec3 from, float (&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

std::uint32_t groups(std::uint32_t pixels, int of_group) {
  const auto side = static_cast<std::uint32_t>(of_group);
  return (pixels + side - 1) / side;
}

void put_past_view(const FrameView& past, AccumulationFrame& to) {
  const f32::PastView view = past_view(past);
  copy(view.eye, to.past_eye), copy(view.right, to.past_right), copy(view.up, to.past_up);
  copy(view.forward, to.past_forward);
  to.past_pixel_size = view.pixel_size;
  to.past_sub_pixel_x = view.sub_pixel_x, to.past_sub_pixel_y = view.sub_pixel_y;
}

}  // namespace

Result<DeviceAccumulationPass> DeviceAccumulationPass::create(gpu::Device& device, std::uint32_t interleave,
                                                              std::uint32_t longest) {
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, accumulate_light, sizeof(AccumulationPush));
  if (!kernel) return kernel.error();
  DeviceAccumulationPass pass;
  pass.device_ = &device;
  pass.kernel_ = std::move(*kernel);
  pass.weight_ = static_cast<float>(interleave * interleave);
  pass.most_ = static_cast<float>(longest - 1);
  if (Status s = pass.grow(pass.sent_, sizeof(AccumulationFrame), gpu::BufferUse::upload); !s) return s.error();
  if (Status s = pass.grow(pass.frame_, sizeof(AccumulationFrame), gpu::BufferUse::device); !s) return s.error();
  return pass;
}

Status DeviceAccumulationPass::grow(gpu::Buffer& buffer, std::uint64_t bytes, gpu::BufferUse use) {
  if (buffer.bytes() >= bytes) return Done{};
  buffer = gpu::Buffer();  // the old memory may be what the new one needs
  Result<gpu::Buffer> made = gpu::Buffer::create(*device_, bytes, use);
  if (!made) return made.error();
  buffer = std::move(*made);
  return Done{};
}

Status DeviceAccumulationPass::make_room(History& history, const FrameView& view) {
  const std::uint64_t pixels = std::uint64_t(view.width) * view.height;
  history.view = FrameView();
  const std::pair<gpu::Buffer*, std::uint64_t> wanted[] = {
      {&history.surfaces, pixels * sizeof(PastSurfaceRecord)},
      {&history.indirect, pixels * sizeof(PixelSums)},
      {&history.many, view.has_many ? pixels * sizeof(PixelSums) : 0}};
  for (const auto& [buffer, bytes] : wanted) {
    if (Status grown = grow(*buffer, bytes, gpu::BufferUse::device); !grown) return grown;
  }
  history.view = view;
  return Done{};
}

Status DeviceAccumulationPass::record(gpu::CommandList& list, const AccumulationBuffers& buffers, FrameView view) {
  view.has_many = buffers.many_sums != nullptr;
  const History& past = history_[now_];
  History& next = history_[1 - now_];
  if (Status room = make_room(next, view); !room) return room;
  now_ = 1 - now_;
  AccumulationFrame frame{};
  frame.pixels = buffers.pixels->address(), frame.surfaces = buffers.surfaces->address();
  frame.sums = address_or_zero(buffers.sums), frame.more_sums = address_or_zero(buffers.more_sums);
  frame.many_sums = address_or_zero(buffers.many_sums);
  frame.frames = address_or_zero(buffers.frames), frame.counts = buffers.counts->address();
  const WayBack way = way_back(past.view, view);
  if (way != WayBack::none) {
    frame.past_surfaces = past.surfaces.address(), frame.past_indirect = past.indirect.address();
    if (view.has_many) frame.past_many = past.many.address();
  }
  frame.present_surfaces = next.surfaces.address(), frame.present_indirect = next.indirect.address();
  if (view.has_many) frame.present_many = next.many.address();
  frame.way_back = static_cast<word_>(way);
  copy(view.camera.eye, frame.eye);
  put_past_view(past.view, frame);
  frame.weight = weight_, frame.most = most_;
  frame.width = view.width, frame.height = view.height;
  *sent_.as<AccumulationFrame>() = frame;
  list.copy(sent_, frame_, sizeof(AccumulationFrame));
  list.fill(*buffers.counts, 0);
  list.barrier();
  list.dispatch(kernel_, AccumulationPush{frame_.address()}, groups(view.width, kAccumulationGroupColumns),
                groups(view.height, kAccumulationGroupRows));
  return Done{};
}

void DeviceAccumulationPass::forget() {
  for (History& history : history_) history.view = FrameView();
}

}  // namespace luciole
