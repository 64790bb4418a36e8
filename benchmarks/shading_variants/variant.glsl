// SPDX-License-Identifier: Apache-2.0
// What the variants of real_time/shading/shade_tiles.comp begin with: its constants, its parts, and what it reads. They
// are for the tile tests exact and tight.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "benchmarks/shading_variants/variant_records.h"

layout(constant_id = 0) const uint kKind = 0u;
layout(constant_id = 1) const uint kTileTest = 2u;
layout(constant_id = 2) const uint kCulled = 1u;
layout(constant_id = 3) const uint kDivideByP = 1u;
layout(push_constant, scalar) uniform Push {
  ShadingPush push;
  uint64_t more;
  uint tiles_each;
};

#include "real_time/shading/tile_lists.glsl"
#include "real_time/shading/pixel_sums.glsl"

layout(local_size_x = kThreads) in;
