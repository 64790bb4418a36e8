// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/tile_shading_pass.h"

#include "real_time/light_culling/tile.h"

namespace luciole {

extern const gpu::ShaderCode shade_tiles, shade_tiles_by_subgroup, shade_tiles_with_shadows;

namespace {

void copy(Vec3 from, float (&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

const gpu::ShaderCode& code_of(LightReads reads, bool shadows) {
  if (shadows) return shade_tiles_with_shadows;
  return reads == LightReads::by_pixel ? shade_tiles : shade_tiles_by_subgroup;
}

}  // namespace

// Software Vulkan reads a light lane by lane, even if all lanes read the same one. Hardware reads that once, and which
// way is faster there is for a measurement to say: benchmarks/gpu.sh times both.
LightReads faster_light_reads(const gpu::DeviceDescription& device) {
  return device.kind == gpu::DeviceKind::cpu && device.shuffles ? LightReads::by_subgroup : LightReads::by_pixel;
}

TileGrid tile_grid(std::uint32_t width, std::uint32_t height, std::uint32_t interleave) {
  const std::uint32_t side = kTileSide * interleave;
  return {(width + side - 1) / side, (height + side - 1) / side, interleave * interleave};
}

std::vector<std::uint32_t> shading_constants(const Settings& settings, LightKind kind) {
  return {kind, static_cast<std::uint32_t>(settings.tile_test), settings.culling == Culling::tiled ? 1u : 0u,
          settings.ranges == Ranges::stochastic ? 1u : 0u};
}

ShadingPush shading_push(const ShadingBuffers& buffers, const GeometryBuffer& geometry, std::uint32_t interleave,
                         std::uint32_t shift, LightPart part) {
  ShadingPush push{};
  push.pixels = buffers.pixels->address(), push.subsets = buffers.subsets->address();
  push.emitters = buffers.lights->emitters.address(), push.bounds = buffers.lights->bounds.address();
  push.sums = buffers.sums->address(), push.tile_counts = buffers.tile_counts->address();
  const Camera& camera = geometry.camera;
  copy(camera.eye, push.eye), copy(camera.right, push.right), copy(camera.up, push.up);
  push.width = geometry.width, push.height = geometry.height, push.interleave = interleave;
  push.shift = shift;
  push.first_light = part.first, push.light_count = part.count;
  return push;
}

Result<TileShadingPass> TileShadingPass::create(gpu::Device& device, const Settings& settings, LightReads reads) {
  TileShadingPass pass;
  pass.interleave_ = settings.interleave;
  for (const LightKind kind : {kDiffuseLights, kGlossyLights, kManyLights}) {
    const bool shadows = settings.direct_shadows && kind == kManyLights;
    Result<gpu::Kernel> kernel = gpu::Kernel::create(device, code_of(reads, shadows),
                                                     shadows ? sizeof(ShadowedShadingPush) : sizeof(ShadingPush),
                                                     shading_constants(settings, kind));
    if (!kernel) return kernel.error();
    pass.kernels_[kind] = std::move(*kernel);
  }
  return pass;
}

void TileShadingPass::record(gpu::CommandList& list, LightKind kind, const ShadingBuffers& buffers,
                             const GeometryBuffer& geometry, std::uint32_t shift, LightPart part) const {
  const ShadingPush push = shading_push(buffers, geometry, interleave_, shift, part);
  const TileGrid grid = tile_grid(geometry.width, geometry.height, interleave_);
  if (kind == kManyLights && buffers.shadows != nullptr) {
    const ShadowedShadingPush shadowed{push, buffers.shadows->address()};
    list.dispatch(kernels_[kind], shadowed, grid.columns, grid.rows, grid.regions);
  } else {
    list.dispatch(kernels_[kind], push, grid.columns, grid.rows, grid.regions);
  }
}

}  // namespace luciole
