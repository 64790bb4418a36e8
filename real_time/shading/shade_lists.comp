// SPDX-License-Identifier: Apache-2.0
// The rivals of tiled culling: a tile of a sub-region per workgroup, whose pixels walk the bits of their cluster's or
// cell's list (light_culling/mark_*.comp). Bits ascend, and windows of lights follow each other, so that a pixel adds
// its lights in ascending order whatever the window or the width of subgroups.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#if defined(LUCIOLE_DIRECT_SHADOWS)
#include "real_time/device_scene/scene.glsl"
#endif
#include "real_time/light_culling/list_records.h"

layout(local_size_x = 256) in;
layout(constant_id = 0) const uint kKind = 0u;
layout(constant_id = 1) const uint kClusters = 1u;  // 0: cells of 4x4 pixels
layout(constant_id = 2) const uint kDivideByP = 1u;
layout(push_constant, scalar) uniform Push {
  ListShadingPush push;
#if defined(LUCIOLE_DIRECT_SHADOWS)
  uint64_t shadows;
#endif
};
#include "real_time/light_culling/cluster_slices.glsl"
#include "real_time/shading/pixel_sums.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Subsets { SubsetRange value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Lists { uint word[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Covering { uint word[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counts { PartCounts value[]; };

const uint kParts = 32u;
shared uint pixels_of[kParts], listed_of[kParts];
shared uint pairs, accepted;

void add_counts(uint tile) {
  const uint thread = gl_LocalInvocationIndex;
  Counts counts = Counts(push.counts);
  if (thread < kParts) {
    counts.value[tile].pixels[thread] = pixels_of[thread];
    counts.value[tile].listed[thread] += listed_of[thread];
  }
  if (thread == 0u) {
    counts.value[tile].pairs += pairs;
    counts.value[tile].accepted += accepted;
  }
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  if (thread < kParts) pixels_of[thread] = listed_of[thread] = 0u;
  if (thread == 0u) pairs = accepted = 0u;
  barrier();
  const TilePixel pixel = read_pixel(thread, gl_WorkGroupID);
  const uint tile = (gl_WorkGroupID.z * gl_NumWorkGroups.y + gl_WorkGroupID.y) * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  ShadedPixel shaded = start_pixel(pixel.record);
  uint covering = 0u;
  if (pixel.is_surface) {
    if (push.first_light > 0u) take_earlier_sums(shaded, pixel.index);
    const uint subsets = push.interleave * push.interleave;
    const SubsetRange subset = Subsets(push.subsets).value[(gl_WorkGroupID.z + push.shift) % subsets];
    const uint part = kClusters != 0u ? cluster_slice_of(read_slices(), pixel.record.depth) : thread / 16u;
    const uint list = (tile * (kClusters != 0u ? kSlices : 16u) + part) * push.words;
    uint length = 0u;
    for (uint w = 0u; w < push.words; ++w) {
      uint bits = Lists(push.lists).word[list + w];
      length += uint(bitCount(bits));
      for (; bits != 0u; bits &= bits - 1u) {
        add_light(shaded, subset.begin + push.first_light + 32u * w + uint(findLSB(bits)));
      }
    }
    covering = kClusters != 0u
                   ? length
                   : Covering(push.covering).word[(tile * 256u + thread) / 2u] >> (16u * (thread & 1u)) & 0xffffu;
    atomicAdd(pixels_of[part], 1u);
    atomicMax(listed_of[part], length);
    atomicAdd(pairs, covering);
    atomicAdd(accepted, shaded.accepted);
  }
  barrier();
  add_counts(tile);
  write_sums(pixel, shaded, covering);
}
