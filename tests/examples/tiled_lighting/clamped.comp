// SPDX-License-Identifier: Apache-2.0
// Tiled lighting as engines have it: every light has a range; a tile lists the lights that reach it and shades those.
#version 450
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 16, local_size_y = 16) in;

struct Light {
  vec3 position;        // [m]
  float range;          // [m], as an artist or an importer set it
  vec3 intensity;       // [W/sr]
  float falloff_floor;  // [1/m^2], for stochastic ranges
};
struct Surface {
  vec3 position;  // [m]
  float albedo;   // 0: nothing is seen here
  vec3 normal;
  float padding;
};
layout(std430, binding = 0) readonly buffer Lights { Light lights[]; };
layout(std430, binding = 1) readonly buffer Surfaces { Surface surfaces[]; };
layout(std430, binding = 2) writeonly buffer Picture { vec4 picture[]; };  // radiance, number of lights shaded
layout(push_constant) uniform Frame { uint width, height, light_count, frame; };

const uint kThreads = 256u;
shared vec3 tile_low[kThreads], tile_high[kThreads];  // bounds of the tile's surfaces, halved until one is left
shared Light listed[kThreads];
shared float listed_range_sq[kThreads];
shared uint list_length;

float light_range_sq(Light light, uint index) {
  return light.range * light.range;
}

float light_weight(Light light, float distance_sq, float range_sq) {
  return pow(1.0 - pow(distance_sq / range_sq, 2.0), 2.0) / distance_sq;
}

void find_tile_bounds(uint thread, Surface surface) {
  bool seen = surface.albedo > 0.0;
  tile_low[thread] = seen ? surface.position : vec3(1e30);
  tile_high[thread] = seen ? surface.position : vec3(-1e30);
  for (uint half_count = kThreads / 2u; half_count > 0u; half_count /= 2u) {
    barrier();
    if (thread < half_count) {
      tile_low[thread] = min(tile_low[thread], tile_low[thread + half_count]);
      tile_high[thread] = max(tile_high[thread], tile_high[thread + half_count]);
    }
  }
  barrier();
}

void list_if_near(uint index) {
  Light light = lights[index];
  float range_sq = light_range_sq(light, index);
  vec3 to_tile = max(max(tile_low[0] - light.position, light.position - tile_high[0]), vec3(0.0));
  if (dot(to_tile, to_tile) < range_sq) {
    uint place = atomicAdd(list_length, 1u);
    listed[place] = light;
    listed_range_sq[place] = range_sq;
  }
}

void main() {
  uint thread = gl_LocalInvocationIndex;
  uvec2 pixel = gl_GlobalInvocationID.xy;
  uint place = pixel.y * width + pixel.x;
  Surface surface = surfaces[place];
  find_tile_bounds(thread, surface);
  vec4 sum = vec4(0.0);
  for (uint first = 0u; first < light_count; first += kThreads) {  // as many lights at once as there are threads
    if (thread == 0u) list_length = 0u;
    barrier();
    if (first + thread < light_count) list_if_near(first + thread);
    barrier();
    for (uint i = 0u; i < list_length; ++i) {
      vec3 to_light = listed[i].position - surface.position;
      float distance_sq = dot(to_light, to_light);
      if (distance_sq >= listed_range_sq[i]) continue;
      float cosine = max(dot(surface.normal, to_light) * inversesqrt(distance_sq), 0.0);
      sum.rgb += listed[i].intensity * (cosine * light_weight(listed[i], distance_sq, listed_range_sq[i]));
      sum.a += 1.0;
    }
    barrier();
  }
  picture[place] = vec4(sum.rgb * (surface.albedo / 3.14159265), sum.a);
}
