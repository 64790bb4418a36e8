// SPDX-License-Identifier: Apache-2.0
// Each invocation of a subgroup asks whether a light of the list reaches the box round the subgroup's pixels, so that
// only those that do are added: a finer list per subgroup, as the CPU makes one per 16 pixels. With LUCIOLE_LIGHTS_BY_SUBGROUP the
// invocation that asked hands the light to all (lights_by_subgroup.glsl), else each reads it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "benchmarks/shading_variants/variant.glsl"
#include "real_time/shading/emitter_words.glsl"

struct Box {
  vec3 middle, extent;  // view space, half its sides [m]
};

Box box_round(bool counts, vec3 view) {
  const vec3 low = subgroupMin(counts ? view : vec3(3e38)), high = subgroupMax(counts ? view : vec3(-3e38));
  const vec3 extent = 0.5 * (high - low);
  return Box(low + extent, extent);
}

// As cull_group of real_time/light_culling/cull_kernel.cpp: the box round the stretched box, and its distance to the
// centre of the unit sphere that the light's ellipsoid becomes.
bool reaches(uint entry, Box box) {
  const vec3 m0 = bound_rows(entry, kM00), m1 = bound_rows(entry, kM11), normal = bound_rows(entry, kNormalX);
  const vec3 stretched = vec3(dot(m0, box.middle), dot(m1.xy, box.middle.yz), m1.z * box.middle.z);
  const vec3 extent = vec3(dot(abs(m0), box.extent), dot(abs(m1.xy), box.extent.yz), m1.z * box.extent.z);
  const vec3 gap = max(abs(stretched - bound_rows(entry, kStretchedX)) - extent, vec3(0.0));
  const float highest = dot(normal, box.middle) + dot(abs(normal), box.extent);
  return dot(gap, gap) <= 1.0002 && highest > bound_row(entry, kNormalOffset);
}

void shade_by_finer_lists(inout ShadedPixel shaded, TilePixel pixel, TileHalves halves, SubsetRange subset,
                          uint counts[2]) {
  for (uint h = 0u; h < 2u; ++h) {
    const bool mine = pixel.is_surface && halves.half_of_pixel == h;
    if (subgroupBallot(mine) == uvec4(0u)) continue;
    const Box box = box_round(mine, pixel.view);
    for (uint first = 0u; first < counts[h]; first += gl_SubgroupSize) {
      const uint i = first + gl_SubgroupInvocationID;
      const uint entry = subset.begin + listed[h][min(i, counts[h] - 1u)];
      const bool chosen = i < counts[h] && reaches(entry, box);
#if defined(LUCIOLE_LIGHTS_BY_SUBGROUP)
      float own[kMostUsed], w[kMostUsed];
      read_words(entry, own);
#endif
      const uvec4 all = subgroupBallot(chosen);
      for (uint word = 0u; word < 4u; ++word) {
        for (uint bits = all[word]; bits != 0u; bits &= bits - 1u) {
          const uint from = 32u * word + uint(findLSB(bits));
#if defined(LUCIOLE_LIGHTS_BY_SUBGROUP)
          words_from(from, own, w);
          if (mine) add_light_of_words(shaded, w);
#else
          if (mine) add_light(shaded, subset.begin + listed[h][first + from]);
#endif
        }
      }
    }
  }
}

#define SHADE_LIGHTS shade_by_finer_lists
#include "real_time/shading/tile_loop.glsl"

void main() {
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  shade_tile(gl_WorkGroupID, gl_NumWorkGroups, pixel, halve(pixel));
}
