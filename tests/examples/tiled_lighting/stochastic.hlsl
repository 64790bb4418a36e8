// SPDX-License-Identifier: Apache-2.0
// The same shader in HLSL, to show that the headers compile there; the program runs the GLSL one.
#include "equations/random_number.h"
#include "equations/stochastic_range.h"

struct Light {
  float3 position;      // [m]
  float range;          // [m]
  float3 intensity;     // [W/sr]
  float falloff_floor;  // [1/m^2]
};
struct Surface {
  float3 position;  // [m]
  float albedo;     // 0: nothing is seen here
  float3 normal;
  float padding;
};
StructuredBuffer<Light> lights : register(t0);
StructuredBuffer<Surface> surfaces : register(t1);
RWStructuredBuffer<float4> picture : register(u2);  // radiance, number of lights shaded
cbuffer Frame : register(b3) {
  uint width, height, light_count, frame;
};

static const uint kThreads = 256u;
groupshared float3 tile_low[kThreads], tile_high[kThreads];
groupshared Light listed[kThreads];
groupshared float listed_range_sq[kThreads];
groupshared uint list_length;

float light_range_sq(Light light, uint index) {
  return stochastic_range_sq(light.falloff_floor, unit_real(random_words(1u, frame, index, 0u).first));
}

float light_weight(Light light, float distance_sq) {
  return max(light.falloff_floor, 1.0f / distance_sq);
}

void find_tile_bounds(uint thread, Surface surface) {
  bool seen = surface.albedo > 0.0f;
  tile_low[thread] = seen ? surface.position : float3(1e30f, 1e30f, 1e30f);
  tile_high[thread] = seen ? surface.position : float3(-1e30f, -1e30f, -1e30f);
  for (uint half_count = kThreads / 2u; half_count > 0u; half_count /= 2u) {
    GroupMemoryBarrierWithGroupSync();
    if (thread < half_count) {
      tile_low[thread] = min(tile_low[thread], tile_low[thread + half_count]);
      tile_high[thread] = max(tile_high[thread], tile_high[thread + half_count]);
    }
  }
  GroupMemoryBarrierWithGroupSync();
}

void list_if_near(uint index) {
  Light light = lights[index];
  float range_sq = light_range_sq(light, index);
  float3 to_tile = max(max(tile_low[0] - light.position, light.position - tile_high[0]), float3(0, 0, 0));
  if (dot(to_tile, to_tile) < range_sq) {
    uint place;
    InterlockedAdd(list_length, 1u, place);
    listed[place] = light;
    listed_range_sq[place] = range_sq;
  }
}

[numthreads(16, 16, 1)]
void main(uint thread : SV_GroupIndex, uint3 pixel : SV_DispatchThreadID) {
  uint place = pixel.y * width + pixel.x;
  Surface surface = surfaces[place];
  find_tile_bounds(thread, surface);
  float4 sum = float4(0, 0, 0, 0);
  for (uint first = 0u; first < light_count; first += kThreads) {
    if (thread == 0u) list_length = 0u;
    GroupMemoryBarrierWithGroupSync();
    if (first + thread < light_count) list_if_near(first + thread);
    GroupMemoryBarrierWithGroupSync();
    for (uint i = 0u; i < list_length; ++i) {
      float3 to_light = listed[i].position - surface.position;
      float distance_sq = dot(to_light, to_light);
      if (distance_sq < listed_range_sq[i]) {
        float cosine = max(dot(surface.normal, to_light) * rsqrt(distance_sq), 0.0f);
        sum.rgb += listed[i].intensity * (cosine * light_weight(listed[i], distance_sq));
        sum.a += 1.0f;
      }
    }
    GroupMemoryBarrierWithGroupSync();
  }
  picture[place] = float4(sum.rgb * (surface.albedo / 3.14159265f), sum.a);
}
