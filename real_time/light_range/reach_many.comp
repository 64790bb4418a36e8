// SPDX-License-Identifier: Apache-2.0
// Pass light_range: punctual lights and points of emitting triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/light_range/range_common.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Lights { ManyLightRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Emitters { ManyEmitter value[]; };

void main() {
  const uint entry = gl_GlobalInvocationID.x;
  if (entry >= push.count) return;
  const ManyLightRecord light = Lights(push.lights).value[entry];
  const RangeFrame f = Frame(push.frame).value;
  const vec3 position = vector(light.position), axis = vector(light.axis);
  ManyEmitter e;
  e.position = light.position;
  e.axis = light.axis;
  e.intensity = light.intensity;
  e.probability_scale = peak_over_delta(f, vector(light.intensity));
  e.xi = xi_of(f, light_bits(f, light.key, 1u));
  e.disc = disc_of(f, light.area);
  e.scale = light.scale;
  e.offset = light.offset;
  e.two_sided = light.two_sided;
  e.squared = light.squared;
  Emitters(push.emitters).value[entry] = e;
  if (light.is_light == 0u || !(e.probability_scale > 0.0)) {
    store_no_bound(entry);
    return;
  }
  const float reach = sqrt(e.probability_scale / e.xi);
  // One-sided emitters are Lambert lobes; others shine as far in all directions that they shine in.
  const bool lambert = light.scale > 0.0 && light.offset >= 0.0 && light.two_sided <= 0.0;
  const bool one_sided = light.scale > 0.0 && light.offset <= 0.0 && light.two_sided <= 0.0;
  BoundingSphere bound = sphere_at_light(position, reach);
  if (kBounds != kSphereAtLight && lambert) bound = diffuse_bounding_sphere(position, axis, reach);
  store_bound(f, entry, ellipsoid_of(bound), position, one_sided ? axis : vec3(0.0));
}
