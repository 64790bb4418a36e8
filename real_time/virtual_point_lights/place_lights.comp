// SPDX-License-Identifier: Apache-2.0
// Pass virtual_point_lights: brings the texels that are lights together, by interleaving subset and in the order of
// their keys. A workgroup per subset, which has its place behind those of the subsets before it, filled up to 16.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "real_time/light_range/range_records.h"
#include "real_time/shading/shading_records.h"
#include "real_time/virtual_point_lights/placement_records.h"

const uint kThreads = 256u;
layout(local_size_x = 256) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Texels { VplRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Counts { uint value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Lights { VplRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Ranges { SubsetRange value[]; };
layout(push_constant, scalar) uniform Push { PlacementPush push; };

shared uint hits[kThreads / 4u];  // one per subgroup; none has fewer than 4 invocations

uint filled_up(uint count) { return (count + 15u) & ~15u; }

// This invocation's place in the workgroup: subgroups one after the other, which ballots count on.
uint thread() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// How many of the invocations before this one are chosen, and of all.
uvec2 chosen_before(bool chosen) {
  const uvec4 bits = subgroupBallot(chosen);
  if (subgroupElect()) hits[gl_SubgroupID] = subgroupBallotBitCount(bits);
  barrier();
  uint before = subgroupBallotExclusiveBitCount(bits), all = 0u;
  for (uint s = 0u; s < gl_NumSubgroups; ++s) {
    before += s < gl_SubgroupID ? hits[s] : 0u;
    all += hits[s];
  }
  barrier();
  return uvec2(before, all);
}

void main() {
  const uint subset = gl_WorkGroupID.x, count = Counts(push.counts).value[subset];
  uint begin = 0u;
  for (uint s = 0u; s < subset; ++s) begin += filled_up(Counts(push.counts).value[s]);
  if (thread() == 0u) Ranges(push.ranges).value[subset] = SubsetRange(begin, count);
  uint placed = 0u;
  for (uint first = subset; first < push.texel_count; first += kThreads * push.subsets) {
    const uint key = first + thread() * push.subsets;
    const bool is_light = key < push.texel_count && Texels(push.texels).value[key].is_light != 0u;
    const uvec2 chosen = chosen_before(is_light);
    if (is_light) Lights(push.lights).value[begin + placed + chosen.x] = Texels(push.texels).value[key];
    placed += chosen.y;
  }
  if (thread() < filled_up(count) - count) Lights(push.lights).value[begin + count + thread()].is_light = 0u;
}
