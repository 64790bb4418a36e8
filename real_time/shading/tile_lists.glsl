// SPDX-License-Identifier: Apache-2.0
// A tile of a sub-region: its pixels, its two depth halves, and the lists of the lights that touch them. Lists are
// ascending and batches follow each other, so that a pixel adds its lights in ascending order whatever the batch, the
// part or the width of subgroups. Whoever includes this declares `push` (ShadingPush), kTileTest and kCulled; a
// workgroup is kThreads invocations along x. Benchmarks compile it for other tiles and batches.
#ifndef LUCIOLE_TILE_LISTS_GLSL
#define LUCIOLE_TILE_LISTS_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "equations/exact_tile_test.h"
#include "equations/paper_tile_test.h"
#include "real_time/light_range/bounds.glsl"
#include "real_time/shading/tile_pixel.glsl"

#ifndef BATCH
#define BATCH 1024  // lights that a list may hold: none is lost, as a batch asks no more
#endif
const uint kThreads = TILE_SIDE * TILE_SIDE, kBatch = BATCH;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Subsets { SubsetRange value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counts { TileCounts value[]; };

shared uint listed[2][kBatch];  // per half: lights, counted from the subset's first
shared float scratch[kThreads / 4u];  // one per subgroup; none has fewer than 4 invocations
shared uint hits[kThreads / 4u];

// This invocation's place in the workgroup: subgroups one after the other, which ballots count on.
uint thread() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// The least value of all invocations.
float tile_min(float value) {
  const float least_of_subgroup = subgroupMin(value);
  if (subgroupElect()) scratch[gl_SubgroupID] = least_of_subgroup;
  barrier();
  float least = scratch[0];
  for (uint s = 1u; s < gl_NumSubgroups; ++s) least = min(least, scratch[s]);
  barrier();
  return least;
}
float tile_max(float value) { return -tile_min(-value); }

uint tile_sum(uint value) {
  const uint sum_of_subgroup = subgroupAdd(value);
  if (subgroupElect()) hits[gl_SubgroupID] = sum_of_subgroup;
  barrier();
  uint sum = 0u;
  for (uint s = 0u; s < gl_NumSubgroups; ++s) sum += hits[s];
  barrier();
  return sum;
}

//   tile  column, row, sub-region
TilePixel read_pixel(uvec3 tile) {
  TilePixel pixel = read_pixel(thread(), tile);
  pixel.view = view_of(pixel, push.eye, push.right, push.up);
  return pixel;
}

struct TileHalves {
  Tile tile;
  uint half_of_pixel;  // 0 near, 1 far
  uint pixels[2];
};

// Slopes are widened by a few units in the last place, as they bound rounded quotients; those of both halves are one.
TileHalves halve(TilePixel pixel) {
  const float huge = 3e38, depth = pixel.view.z;
  const bool s = pixel.is_surface;
  const float nearest = tile_min(s ? depth : huge), farthest = tile_max(s ? depth : -huge);
  const float middle = 0.5 * (nearest + farthest);
  TileHalves h;
  h.half_of_pixel = depth > middle ? 1u : 0u;
  const bool in_near = s && h.half_of_pixel == 0u, in_far = s && h.half_of_pixel == 1u;
  const uint both = tile_sum((in_near ? 1u : 0u) + (in_far ? 0x10000u : 0u));
  h.pixels[0] = both & 0xffffu;
  h.pixels[1] = both >> 16u;
  const float x = pixel.view.x / depth, y = pixel.view.y / depth;
  const float margin_x = 1e-6 * (1.0 + abs(x)), margin_y = 1e-6 * (1.0 + abs(y));
  h.tile.x_low = tile_min(s ? x - margin_x : huge);
  h.tile.x_high = tile_max(s ? x + margin_x : -huge);
  h.tile.y_low = tile_min(s ? y - margin_y : huge);
  h.tile.y_high = tile_max(s ? y + margin_y : -huge);
  // An empty half: low > high.
  h.tile.near_low = h.pixels[0] > 0u ? nearest * (1.0 - 1e-6) : 1.0;
  h.tile.near_high = h.pixels[0] > 0u ? tile_max(in_near ? depth * (1.0 + 1e-6) : -huge) : 0.0;
  h.tile.far_low = h.pixels[1] > 0u ? tile_min(in_far ? depth * (1.0 - 1e-6) : huge) : 1.0;
  h.tile.far_high = h.pixels[1] > 0u ? farthest * (1.0 + 1e-6) : 0.0;
  return h;
}

PaperTestEllipsoid load_paper_ellipsoid(uint entry) {
  return PaperTestEllipsoid(bound_rows(entry, kPaper), bound_rows(entry, kPaper + 3), bound_rows(entry, kPaper + 6),
                            bound_rows(entry, kPaper + 9));
}

HalfMasks touches(uint entry, Tile tile, SidePlanes sides) {
  HalfMasks result;
  result.near_half = result.far_half = kCulled == 0u;
  const float radius = bound_row(entry, kRadius);
  if (kCulled == 0u || radius < 0.0) return result;
  // The paper's test stands alone, so that its lists are the paper's.
  if (kTileTest == 0u) return touches_tile_as_paper(load_paper_ellipsoid(entry), tile);
  if (!sphere_may_touch(sides, bound_rows(entry, kCentreX), radius)) return result;
  if (kTileTest == 1u) return ellipsoid_touches_tile_exactly(load_ellipsoid(entry), tile);
  return ellipsoid_touches_tile(load_ellipsoid(entry), tile);
}

// Appends the lights that hit to both lists, in the order of the invocations. `counts` are the lists' lengths, the same
// for all invocations.
void append_lights(uint light, bool near_hit, bool far_hit, inout uint counts[2]) {
  const uvec4 near_bits = subgroupBallot(near_hit), far_bits = subgroupBallot(far_hit);
  if (subgroupElect()) {
    hits[gl_SubgroupID] = subgroupBallotBitCount(near_bits) | (subgroupBallotBitCount(far_bits) << 16u);
  }
  barrier();
  uint before = 0u, all = 0u;
  for (uint s = 0u; s < gl_NumSubgroups; ++s) {
    before += s < gl_SubgroupID ? hits[s] : 0u;
    all += hits[s];
  }
  if (near_hit) listed[0][counts[0] + (before & 0xffffu) + subgroupBallotExclusiveBitCount(near_bits)] = light;
  if (far_hit) listed[1][counts[1] + (before >> 16u) + subgroupBallotExclusiveBitCount(far_bits)] = light;
  counts[0] += all & 0xffffu;
  counts[1] += all >> 16u;
  barrier();
}

// Appends the lights [first, end) of a subset that touch the tile, at most kBatch, to its lists.
void list_lights(SubsetRange subset, uint first, uint end, TileHalves halves, SidePlanes sides, inout uint counts[2]) {
  for (uint base = first; base < end; base += kThreads) {
    const uint light = base + thread();
    HalfMasks hit;
    hit.near_half = hit.far_half = false;
    if (light < end) hit = touches(subset.begin + light, halves.tile, sides);
    append_lights(light, hit.near_half, hit.far_half, counts);
  }
}

// The subset whose lights a sub-region sees.
SubsetRange subset_of(uint region) {
  return Subsets(push.subsets).value[(region + push.shift) % (push.interleave * push.interleave)];
}

// asked: lights of the subset that were asked, those of earlier parts with them.
//   tile   column, row, sub-region
//   tiles  columns, rows, sub-regions
void write_counts(uvec3 tile, uvec3 tiles, TileHalves halves, uint lists[2], uint accepted, uint asked) {
  const uint place = (tile.z * tiles.y + tile.y) * tiles.x + tile.x;
  const uint all_accepted = tile_sum(accepted);
  if (thread() != 0u) return;
  TileCounts counts = TileCounts(halves.pixels, lists, all_accepted, asked);
  if (push.first_light > 0u) {
    counts.listed[0] += Counts(push.tile_counts).value[place].listed[0];
    counts.listed[1] += Counts(push.tile_counts).value[place].listed[1];
    counts.accepted += Counts(push.tile_counts).value[place].accepted;
  }
  Counts(push.tile_counts).value[place] = counts;
}

#endif
