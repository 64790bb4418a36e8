// SPDX-License-Identifier: Apache-2.0
// Pass light_range: the glossy lobes of the virtual point lights.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/light_range/range_common.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Lights { VplRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Emitters { GlossyEmitter value[]; };

BoundingEllipsoid glossy_bound(GlossyLobe lobe, float f0, float f90, float flux_per_threshold) {
  const float size = lobe_size(lobe, f0, f90, flux_per_threshold);
  if (kBounds == kSphereAtLight) return ellipsoid_of(sphere_at_light(lobe.position, glossy_reach(lobe, size)));
  if (kBounds == kSphere) return ellipsoid_of(sphere_around(bounding_spheroid(lobe, size)));
  if (kBounds == kSpheroid) return bounding_spheroid(lobe, size);
  return tight_ellipsoid(lobe, f0, f90, flux_per_threshold);
}

void main() {
  const uint entry = gl_GlobalInvocationID.x;
  if (entry >= push.count) return;
  const VplRecord light = Lights(push.lights).value[entry];
  const RangeFrame f = Frame(push.frame).value;
  const vec3 position = vector(light.position), normal = vector(light.normal), incident = vector(light.incident);
  const vec3 flux = vector(light.flux), f0 = vector(light.f0);
  SurfaceBrdf surface;
  surface.diffuse_albedo = vec3(0.0);
  surface.f0 = f0;
  surface.f90 = light.f90;
  surface.ggx_alpha = light.ggx_alpha;
  const FixedDirectionBrdf fixed_direction = fix_direction(surface, normal, incident);
  GlossyEmitter e;
  e.position = light.position;
  e.normal = light.normal;
  e.geometric_normal = light.geometric_normal;
  e.incident = light.incident;
  e.flux = light.flux;
  e.probability_scale = f.exposure_over_delta;
  // The second lobe takes the complement of the first one's bits: xi = 1 - xi, the least variance of the sum.
  e.xi = xi_of(f, complement_bits(light_bits(f, light.key, 0u)));
  e.disc = disc_of(f, light.area);
  e.f0 = light.f0;
  e.f90 = light.f90;
  e.alpha_sq = fixed_direction.alpha_sq;
  e.cos_incident = fixed_direction.cos_fixed;
  e.masking = fixed_direction.masking;
  Emitters(push.emitters).value[entry] = e;
  if (light.is_light == 0u || !(largest_channel(flux) * max(largest_channel(f0), light.f90) > 0.0)) {
    store_no_bound(entry);
    return;
  }
  const GlossyLobe lobe = glossy_lobe(position, normal, incident, light.ggx_alpha);
  const BoundingEllipsoid bound =
      glossy_bound(lobe, bounding_f0(flux, f0), light.f90, peak_over_delta(f, flux) / e.xi);
  store_bound(f, entry, bound, position, vector(light.geometric_normal));
}
