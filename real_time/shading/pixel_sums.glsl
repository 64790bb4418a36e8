// SPDX-License-Identifier: Apache-2.0
// What lights add to a pixel, whichever way they were listed. Included after the push constants, of which it reads
// `emitters`, `sums`, `eye` and `first_light`, and after the specialisation constants kKind (0 diffuse, 1 glossy, 2 many)
// and kDivideByP (0: clamped and infinite ranges). With LUCIOLE_DIRECT_SHADOWS each accepted light gets a shadow ray; then
// scene.glsl is included before, and `shadows` is the address of a ShadowRecord.
#include "equations/light_emission.h"
#include "real_time/light_range/emitters.h"
#include "real_time/shading/tile_pixel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer DiffuseEmitters { DiffuseEmitter value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer GlossyEmitters { GlossyEmitter value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer ManyEmitters { ManyEmitter value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Sums { PixelSums value[]; };

Emitted emit(DiffuseEmitter light, vec3 from_light) {
  FixedDirectionBrdf f;
  f.normal = vector(light.normal);
  f.fixed_direction = vector(light.incident);
  f.f0 = vec3(0.0);
  f.f0_max = light.f0_max;
  f.f90 = light.f90;
  f.alpha_sq = f.cos_fixed = f.masking = 0.0;
  return emitted_by_diffuse_lobe(f, vector(light.geometric_normal), vector(light.intensity), light.probability_scale,
                                 from_light);
}

Emitted emit(GlossyEmitter light, vec3 from_light) {
  FixedDirectionBrdf f;
  f.normal = vector(light.normal);
  f.fixed_direction = vector(light.incident);
  f.f0 = vector(light.f0);
  f.f90 = light.f90;
  f.f0_max = 0.0;
  f.alpha_sq = light.alpha_sq;
  f.cos_fixed = light.cos_incident;
  f.masking = light.masking;
  return emitted_by_glossy_lobe(f, vector(light.geometric_normal), vector(light.flux), light.probability_scale,
                                from_light);
}

Emitted emit(ManyEmitter light, vec3 from_light) {
  const AxialEmission a =
      AxialEmission(vector(light.axis), light.scale, light.offset, light.two_sided, light.squared);
  return emitted_along_axis(a, vector(light.intensity), light.probability_scale, from_light);
}

struct ShadedPixel {
  vec3 position, geometric_normal;
  FixedDirectionBrdf brdf;
  vec3 diffuse, specular;
  uint accepted;
};

ShadedPixel start_pixel(PixelRecord record) {
  SurfaceBrdf surface;
  surface.diffuse_albedo = vec3(0.0);
  surface.f0 = vector(record.f0);
  surface.f90 = record.f90;
  surface.ggx_alpha = record.ggx_alpha;
  ShadedPixel pixel;
  pixel.position = vector(record.position);
  pixel.geometric_normal = vector(record.geometric_normal);
  pixel.brdf = fix_direction(surface, vector(record.normal), normalize(vector(push.eye) - pixel.position));
  pixel.diffuse = pixel.specular = vec3(0.0);
  pixel.accepted = 0u;
  return pixel;
}

// What earlier parts of the lights came to.
void take_earlier_sums(inout ShadedPixel pixel, uint index) {
  pixel.diffuse = vector(Sums(push.sums).value[index].diffuse);
  pixel.specular = vector(Sums(push.sums).value[index].specular);
}

// [TH17] Eqs. 2 and 3. A function of the emitter's type would be one per kind: this is the text of all three.
#define ADD_LIGHT(light)                                                              \
  {                                                                                   \
    const vec3 d = vector(light.position) - pixel.position;                           \
    const float distance_sq = dot(d, d);                                              \
    const vec3 to_light = d * inverse_sqrt(max(distance_sq, 1e-30));                  \
    const Emitted e = emit(light, -to_light);                                         \
    const float l_sq = distance_sq + light.disc;                                      \
    if (emission_is_accepted(e, l_sq, light.xi)) {                                    \
      add_accepted(pixel, e, to_light, l_sq, vector(light.position));                 \
    }                                                                                 \
  }

#if defined(LUCIOLE_DIRECT_SHADOWS)
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counter { uint value; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Shadows { ShadowRecord value; };

SceneRecord scene() { return SceneAt(Shadows(shadows).value.scene).value; }

// As light_shadows.cpp.
bool is_visible(ShadedPixel pixel, vec3 light_position) {
  const ShadowRecord record = Shadows(shadows).value;
  Ray ray;
  ray.origin = pixel.position + pixel.geometric_normal * record.surface_offset;
  ray.direction = light_position - ray.origin;
  if (dot(ray.direction, ray.direction) == 0.0) return true;
  ray.nearest = 0.0;
  // The emitter's own surface, at the end of the ray, does not count.
  ray.farthest = 1.0 - 2.0 * record.surface_offset / length(ray.direction);
  const Hit hit = trace_scene(ray, true);
  if (!hit.complete) atomicAdd(Counter(record.unfinished).value, 1u);
  return hit.mesh == kNothing;
}
#else
bool is_visible(ShadedPixel pixel, vec3 light_position) { return true; }
#endif

void add_accepted(inout ShadedPixel pixel, Emitted e, vec3 to_light, float l_sq, vec3 light_position) {
  ++pixel.accepted;
  if (!(dot(pixel.geometric_normal, to_light) > 0.0) || !is_visible(pixel, light_position)) return;
  const float weight = kDivideByP != 0u ? fall_off_over_probability(e, l_sq) : inverse(l_sq);
  const vec3 arriving = e.colour * (e.factor * weight);
  const Reflection r = reflection(pixel.brdf, to_light);
  pixel.diffuse += arriving * r.diffuse;
  pixel.specular += arriving * r.specular;
}

void add_light(inout ShadedPixel pixel, uint entry) {
  if (kKind == 0u) {
    const DiffuseEmitter light = DiffuseEmitters(push.emitters).value[entry];
    ADD_LIGHT(light)
  } else if (kKind == 1u) {
    const GlossyEmitter light = GlossyEmitters(push.emitters).value[entry];
    ADD_LIGHT(light)
  } else {
    const ManyEmitter light = ManyEmitters(push.emitters).value[entry];
    ADD_LIGHT(light)
  }
}

void write_sums(TilePixel pixel, ShadedPixel shaded, uint lights) {
  PixelSums sums;
  sums.diffuse = float[3](shaded.diffuse.x, shaded.diffuse.y, shaded.diffuse.z);
  sums.specular = float[3](shaded.specular.x, shaded.specular.y, shaded.specular.z);
  sums.listed = lights;
  sums.accepted = shaded.accepted;
  if (push.first_light > 0u) {
    sums.listed += Sums(push.sums).value[pixel.index].listed;
    sums.accepted += Sums(push.sums).value[pixel.index].accepted;
  }
  if (pixel.is_surface) Sums(push.sums).value[pixel.index] = sums;
}
