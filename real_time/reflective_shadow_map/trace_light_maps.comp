// SPDX-License-Identifier: Apache-2.0
// Passes reflective_shadow_map and the making of virtual point lights: a ray per texel of the primary lights' maps, and
// the light that it leaves where it is reflected. The text follows light_map.cpp, reflective_shadow_map.cpp and
// virtual_point_lights.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "base/vectors.glsl"
#include "real_time/device_scene/scene.glsl"
#include "equations/direction_map.h"
#include "equations/random_number.h"
#include "real_time/light_range/range_records.h"
#include "real_time/reflective_shadow_map/light_map_records.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Maps { LightMapRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Cells { CellRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Lights { VplRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counts { uint value[]; };
layout(push_constant, scalar) uniform Push { LightMapPush push; };

const uint kDimensionTexel = 5u;    // as in reflective_shadow_map.cpp
const float kLeastCosine = 1e-4;    // likewise

SceneRecord scene() { return SceneAt(push.scene).value; }

// The last map that begins at this texel or before it, and has any.
LightMapRecord map_of(uint key) {
  uint low = 0u, high = push.map_count;  // the first map that begins behind it lies in (low, high]
  while (high - low > 1u) {
    const uint middle = (low + high) / 2u;
    if (Maps(push.maps).value[middle].first_texel <= key) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return Maps(push.maps).value[low];
}

vec2 place_in_texel(uint key) {
  const RandomWords words = random_words(push.seed, push.frame, key, kDimensionTexel);
  return push.is_random != 0u ? vec2(unit_real(words.first), unit_real(words.second)) : vec2(0.5);
}

// CellPartition::point.
uint row_start(LightMapRecord map, uint row) { return uint(uint64_t(row) * map.texels / map.rows); }
vec2 point_of(LightMapRecord map, uint key) {
  const CellRecord cell = Cells(push.cells).value[key];
  const vec2 within = place_in_texel(key);
  const uint first = row_start(map, cell.row);
  const float count = float(row_start(map, cell.row + 1u) - first);
  return vec2((float(cell.column) + within.x) / count, (float(first) + within.y * count) / float(map.texels));
}

struct TexelRay {
  vec3 origin, direction, flux;
};

TexelRay ray_of(LightMapRecord map, uint key) {
  const vec2 at = point_of(map, key);
  const vec3 right = vector(map.right), up = vector(map.up), axis = vector(map.axis);
  TexelRay ray;
  ray.origin = vector(map.origin);
  ray.direction = axis;
  ray.flux = vector(map.flux);
  if (map.kind == kSunMap) {
    ray.origin += right * (at.x * map.width) + up * (at.y * map.height);
  } else if (map.kind == kSpotMap) {
    const vec3 local = cone_direction(at, map.cos_outer);
    ray.direction = normalize(right * local.x + up * local.y + axis * local.z);
    const float t = clamp((dot(ray.direction, axis) - map.cos_outer) / map.ramp, 0.0, 1.0);
    ray.flux *= t * t;
  } else {
    ray.direction = octahedral_direction(at);
  }
  return ray;
}

bool reflects(TexelRay ray, Surface met) {
  const vec3 incident = -ray.direction;
  return (ray.flux.x > 0.0 || ray.flux.y > 0.0 || ray.flux.z > 0.0) && dot(incident, met.shading_normal) > 0.0 &&
         dot(incident, met.geometric_normal) > 0.0;
}

void main() {
  const uint key = gl_GlobalInvocationID.x;
  if (key >= push.texel_count) return;
  const LightMapRecord map = map_of(key);
  const TexelRay from = ray_of(map, key);
  Ray ray;
  ray.origin = from.origin;
  ray.direction = from.direction;
  ray.nearest = 0.0;
  ray.farthest = uintBitsToFloat(0x7f800000u);
  const Hit hit = trace_scene(ray, false);
  if (!hit.complete) atomicAdd(Counts(push.unfinished).value[0], 1u);
  VplRecord light;
  light.is_light = 0u;
  if (hit.mesh != kNothing) {
    const float cross_section = map.parallel_area + map.solid_angle * hit.distance * hit.distance;
    const Surface met = surface_at(hit.mesh, hit.triangle, hit.uv, from.direction, sqrt(cross_section));
    light.position = numbers(met.position);
    light.normal = numbers(met.shading_normal);
    light.geometric_normal = numbers(met.geometric_normal);
    light.incident = numbers(-from.direction);
    light.flux = numbers(from.flux);
    light.diffuse_albedo = numbers(met.brdf.diffuse_albedo);
    light.f0 = numbers(met.brdf.f0);
    light.f90 = met.brdf.f90;
    light.ggx_alpha = met.brdf.ggx_alpha;
    light.area = cross_section / max(-dot(from.direction, met.geometric_normal), kLeastCosine);
    light.key = key;
    light.is_light = reflects(from, met) ? 1u : 0u;
  }
  if (light.is_light != 0u) atomicAdd(Counts(push.counts).value[key % push.subsets], 1u);
  Lights(push.lights).value[key] = light;
}
