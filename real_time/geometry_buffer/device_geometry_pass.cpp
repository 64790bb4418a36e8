// SPDX-License-Identifier: Apache-2.0
#include "real_time/geometry_buffer/device_geometry_pass.h"

#include <string>

#include "base/parallel.h"
#include "real_time/geometry_buffer/pixel_block.h"

namespace luciole {

extern const gpu::ShaderCode geometry_buffer;

namespace {

constexpr std::uint32_t kGroup = 8;     // pixels along a side of a workgroup of geometry_buffer.comp
constexpr std::size_t kAtOnce = 16384;  // pixels of a thread

void copy(Vec3 from, float (&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }
void copy(const float (&from)[3], std::size_t pixel, Plane3& to) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis][pixel] = from[axis];
}

void unpack(const PixelRecord* pixels, const SurfaceRecord* surfaces, GeometryBuffer& to) {
  parallel_for(to.pixel_count(), kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PixelRecord& pixel = pixels[i];
      const SurfaceRecord& surface = surfaces[i];
      to.depth[i] = pixel.depth, to.f90[i] = pixel.f90, to.ggx_alpha[i] = pixel.ggx_alpha;
      copy(pixel.position, i, to.position), copy(pixel.normal, i, to.normal);
      copy(pixel.geometric_normal, i, to.geometric_normal), copy(pixel.f0, i, to.f0);
      copy(surface.diffuse_albedo, i, to.diffuse_albedo), copy(surface.emission, i, to.emission);
      to.material[i] = surface.material;
    }
  });
}

}  // namespace

Result<GeometryOnDevice> GeometryOnDevice::create(gpu::Device& device, std::uint32_t width, std::uint32_t height) {
  const std::uint64_t count = std::uint64_t(width) * height;
  GeometryOnDevice made;
  const std::pair<gpu::Buffer*, std::uint64_t> wanted[] = {{&made.pixels, count * sizeof(PixelRecord)},
                                                           {&made.surfaces, count * sizeof(SurfaceRecord)},
                                                           {&made.unfinished, sizeof(word_)}};
  for (const auto& [buffer, bytes] : wanted) {
    Result<gpu::Buffer> one = gpu::Buffer::create(device, bytes, gpu::BufferUse::device);
    if (!one) return one.error();
    *buffer = std::move(*one);
  }
  return made;
}

Result<DeviceGeometryPass> DeviceGeometryPass::create(gpu::Device& device) {
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, geometry_buffer, sizeof(GeometryPush));
  if (!kernel) return kernel.error();
  DeviceGeometryPass pass;
  pass.kernel_ = std::move(*kernel);
  return pass;
}

GeometryPush geometry_push(const DeviceScene& scene, const DeviceView& view, const GeometryOnDevice& to) {
  const ScreenRays screen(view.camera, view.width, view.height, view.sub_pixel);
  GeometryPush push{};
  push.scene = scene.address(), push.pixels = to.pixels.address(), push.surfaces = to.surfaces.address();
  push.unfinished = to.unfinished.address();
  copy(screen.eye, push.eye), copy(screen.forward, push.forward), copy(screen.top_left, push.top_left);
  copy(screen.across, push.across), copy(screen.down, push.down);
  push.pixel_size = screen.pixel_size;
  push.width = view.width, push.height = view.height;
  return push;
}

void DeviceGeometryPass::record(gpu::CommandList& list, const DeviceScene& scene, const DeviceView& view,
                                const GeometryOnDevice& to) const {
  list.begin_pass("geometry_buffer");
  list.fill(to.unfinished, 0);
  list.barrier();
  list.dispatch(kernel_, geometry_push(scene, view, to), (view.width + kGroup - 1) / kGroup,
                (view.height + kGroup - 1) / kGroup);
}

Status all_finished(word_ unfinished) {
  if (unfinished == 0) return Done{};
  return Error{ErrorKind::failed, std::to_string(unfinished) +
                                      " rays met more of the scene than a device's kernel can ask: use --front cpu"};
}

Status read_back(gpu::Device& device, const GeometryOnDevice& from, const DeviceView& view, GeometryBuffer& to) {
  to.resize(view.width, view.height);
  to.camera = view.camera;
  to.sub_pixel_x = view.sub_pixel.x, to.sub_pixel_y = view.sub_pixel.y;
  Result<gpu::CommandList> list = gpu::CommandList::create(device);
  if (!list) return list.error();
  list->begin_pass("transfer");
  const std::pair<const gpu::Buffer*, std::uint64_t> wanted[] = {
      {&from.pixels, to.pixel_count() * sizeof(PixelRecord)},
      {&from.surfaces, to.pixel_count() * sizeof(SurfaceRecord)},
      {&from.unfinished, sizeof(word_)}};
  std::vector<gpu::Buffer> received;
  for (const auto& [buffer, bytes] : wanted) {
    Result<gpu::Buffer> one = gpu::Buffer::create(device, bytes, gpu::BufferUse::readback);
    if (!one) return one.error();
    list->copy(*buffer, *one, bytes);
    received.push_back(std::move(*one));
  }
  if (Status done = list->run(); !done) return done;
  if (Status finished = all_finished(*received[2].as<word_>()); !finished) return finished;
  unpack(received[0].as<PixelRecord>(), received[1].as<SurfaceRecord>(), to);
  return Done{};
}

}  // namespace luciole
