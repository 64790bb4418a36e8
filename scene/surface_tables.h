// SPDX-License-Identifier: Apache-2.0
// A scene's meshes, materials and textures as plain pointers and numbers: what the surface kernels of each instruction
// set read, which may not see standard containers.
#pragma once
#include <cstdint>

#include "scene/texture_modes.h"

namespace luciole {

inline constexpr std::uint32_t kMostMipLevels = 32;

struct SurfaceTexture {
  const std::uint32_t* texels = nullptr;  // of all levels; red in the lowest byte
  std::uint32_t width = 0, height = 0;    // of level 0; each further one halves, rounding down, at least 1
  std::uint32_t first_texel[kMostMipLevels] = {};
  float coarsest = 0;                       // number of the last level
  const float* linear_from_srgb = nullptr;  // 256 values; none where the codes are linear already
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  MipFilter mip_filter = MipFilter::linear;
  bool magnify_linear = true, minify_linear = true;
};

enum SurfaceSlotName : int { kBaseColourSlot, kNormalSlot, kReflectionSlot, kEmissiveSlot, kSurfaceSlots };

struct SurfaceSlot {
  const SurfaceTexture* texture = nullptr;  // none: white
  int same_texels_as = 0;  // the first slot of the material that reads the same places of a texture alike; itself
  int uv_set = 0;
  float a = 1, b = 0, c = 0, d = 1, offset[2] = {0, 0};  // uv' = (a b; c d) uv + offset
};

struct SurfaceMaterial {
  SurfaceSlot slot[kSurfaceSlots];
  float base_colour[3] = {};
  float metallic = 0, roughness = 0;  // factors of the texture
  float metallic_override = -1, ggx_alpha_override = -1;
  float normal_scale = 1;
  float emission[3] = {};
  bool emits = false, double_sided = false;
  float dielectric_f0[3] = {}, dielectric_f90 = 1;
};

// Per vertex, tightly packed: 3 floats of position and normal, 4 of tangent and colour, 2 of uv; null where there are
// none.
struct SurfaceMesh {
  const float *positions = nullptr, *normals = nullptr, *tangents = nullptr, *colours = nullptr;
  const float* uv[2] = {};
  const std::uint32_t* indices = nullptr;
  SurfaceMaterial material;
};

}  // namespace luciole
