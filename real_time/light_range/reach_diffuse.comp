// SPDX-License-Identifier: Apache-2.0
// Pass light_range: the diffuse lobes of the virtual point lights.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/light_range/range_common.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Lights { VplRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Emitters { DiffuseEmitter value[]; };

void main() {
  const uint entry = gl_GlobalInvocationID.x;
  if (entry >= push.count) return;
  const VplRecord light = Lights(push.lights).value[entry];
  const RangeFrame f = Frame(push.frame).value;
  const vec3 position = vector(light.position), normal = vector(light.normal);
  const vec3 intensity = vector(light.flux) * vector(light.diffuse_albedo);
  DiffuseEmitter e;
  e.position = light.position;
  e.normal = light.normal;
  e.geometric_normal = light.geometric_normal;
  e.incident = light.incident;
  e.intensity = numbers(intensity);
  e.probability_scale = peak_over_delta(f, intensity);
  e.xi = xi_of(f, light_bits(f, light.key, 0u));
  e.disc = disc_of(f, light.area);
  e.f0_max = largest_channel(vector(light.f0));
  e.f90 = light.f90;
  Emitters(push.emitters).value[entry] = e;
  if (light.is_light == 0u || !(e.probability_scale > 0.0)) {
    store_no_bound(entry);
    return;
  }
  const float reach = diffuse_reach(diffuse_peak_flux(e.probability_scale, e.f0_max, e.f90) / e.xi);
  BoundingSphere bound = sphere_at_light(position, reach);
  if (kBounds != kSphereAtLight) bound = diffuse_bounding_sphere(position, normal, reach);
  store_bound(f, entry, ellipsoid_of(bound), position, vector(light.geometric_normal));
}
