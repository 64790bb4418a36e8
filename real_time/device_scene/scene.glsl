// SPDX-License-Identifier: Apache-2.0
// A scene on the device: rays through it, the surfaces that they meet, and the sky that they see where there is none.
// The text of surfaces follows scene/surface.cpp and scene/texture_sampling.h, which define what a surface is.
// Whoever includes this says where the scene is:
//   SceneRecord scene()
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "equations/ggx_brdf.h"
#include "equations/shading_normal.h"
#include "equations/texture_level_of_detail.h"
#include "ray_tracing/trace.glsl"
#include "real_time/device_scene/scene_records.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer SceneAt { SceneRecord value; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer MeshRecords { MeshRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer MaterialRecords { MaterialRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SlotRecords { SlotRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer TextureRecords { TextureRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FloatsAt { float value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer WordsAt { uint value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Words3At { uvec3 value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Floats2At { vec2 value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Floats3At { vec3 value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Floats4At { vec4 value[]; };

SceneRecord scene();

#include "real_time/device_scene/texture.glsl"

struct Corners {
  uvec3 index;
  vec3 weight;
};

Corners corners_of(MeshRecord mesh, uint triangle, vec2 uv) {
  Corners c;
  c.index = Words3At(mesh.indices).value[triangle];
  c.weight = vec3(1.0 - uv.x - uv.y, uv.x, uv.y);
  return c;
}

vec2 floats2(uint64_t at, uint i) { return Floats2At(at).value[i]; }
vec3 floats3(uint64_t at, uint i) { return Floats3At(at).value[i]; }
vec4 floats4(uint64_t at, uint i) { return Floats4At(at).value[i]; }
vec3 mixed3(uint64_t at, Corners c) {
  return floats3(at, c.index.x) * c.weight.x + floats3(at, c.index.y) * c.weight.y + floats3(at, c.index.z) * c.weight.z;
}
vec4 mixed4(uint64_t at, Corners c) {
  return floats4(at, c.index.x) * c.weight.x + floats4(at, c.index.y) * c.weight.y + floats4(at, c.index.z) * c.weight.z;
}

// What all look-ups of a hit share, per set of coordinates.
struct Coordinates {
  vec2 uv[2];               // (0, 0) where the mesh has no such set
  float area_per_area[2];   // of the triangle in texture space over its area in the world [1/m^2]
  float cone_width;         // diameter of the ray cone at the hit [m]; 0: finest level
  float cos_at_surface;
};

void set_coordinates(inout Coordinates made, int set, uint64_t at, Corners c, float doubled_area) {
  made.uv[set] = vec2(0.0);
  made.area_per_area[set] = 0.0;
  if (at == 0ul) return;
  const vec2 a = floats2(at, c.index.x), b = floats2(at, c.index.y), d = floats2(at, c.index.z);
  made.uv[set] = a * c.weight.x + b * c.weight.y + d * c.weight.z;
  const vec2 along = b - a, across = d - a;
  if (doubled_area > 0.0) made.area_per_area[set] = abs(along.x * across.y - across.x * along.y) / doubled_area;
}

//   doubled_area  of the triangle [m^2]; 0: finest level
Coordinates coordinates_of(MeshRecord mesh, Corners c, float doubled_area, float cone_width, float cos_at_surface) {
  Coordinates made;
  set_coordinates(made, 0, mesh.uv[0], c, doubled_area);
  set_coordinates(made, 1, mesh.uv[1], c, doubled_area);
  made.cone_width = cone_width;
  made.cos_at_surface = cos_at_surface;
  return made;
}

vec2 moved_by(SlotRecord slot, vec2 uv) {
  return vec2(slot.a * uv.x + slot.b * uv.y + slot.offset[0], slot.c * uv.x + slot.d * uv.y + slot.offset[1]);
}

vec4 look_up(SlotRecord slot, Coordinates at) {
  const TextureRecord texture_ = TextureRecords(scene().textures).value[slot.texture];
  const bool second = slot.uv_set != 0u;
  const float density = (second ? at.area_per_area[1] : at.area_per_area[0]) * abs(slot.a * slot.d - slot.b * slot.c);
  const float texels = float(texture_.width) * float(texture_.height);
  const float lod = texture_level_of_detail(density, texels, at.cone_width, at.cos_at_surface);
  return sample_texture(texture_, moved_by(slot, second ? at.uv[1] : at.uv[0]), lod);
}

// What the slots of a material hold at a point, white where they have no texture, as the format says.
struct SlotTexels {
  vec4 value[kMaterialSlots];
};

// One text of a look-up, in a loop over the slots: kernels with four took software Vulkan seconds to compile.
//   wanted  bit s: slot s
SlotTexels look_up_slots(uint material, uint wanted, Coordinates at) {
  SlotRecords slots = SlotRecords(scene().materials + uint64_t(material) * kMaterialBytes);
  SlotTexels texels;
  for (uint s = 0u; s < kMaterialSlots; ++s) {
    texels.value[s] = vec4(1.0);
    if ((wanted >> s & 1u) != 0u && slots.value[s].texture != kNoTexture) {
      texels.value[s] = look_up(slots.value[s], at);
    }
  }
  return texels;
}

vec4 base_colour_and_alpha(MeshRecord mesh, MaterialRecord material, Corners c, vec4 texel) {
  vec4 colour = texel * vec4(material.base_colour[0], material.base_colour[1], material.base_colour[2],
                             material.base_colour[3]);
  if (mesh.colours != 0ul) colour *= mixed4(mesh.colours, c);
  return clamp(colour, vec4(0.0), vec4(1.0));
}

// surface_alpha and alpha_passes of scene/surface.h, for rays that cut blended surfaces at one half.
bool stops_ray(uint mesh_index, uint triangle, vec2 uv) {
  const MeshRecord mesh = MeshRecords(scene().meshes).value[mesh_index];
  const MaterialRecord material = MaterialRecords(scene().materials).value[mesh.material];
  const Corners c = corners_of(mesh, triangle, uv);
  const SlotRecord slot = material.base_colour_texture;
  vec4 texel = vec4(1.0);
  if (slot.texture != kNoTexture) {
    Coordinates at;
    set_coordinates(at, 0, slot.uv_set != 0u ? mesh.uv[1] : mesh.uv[0], c, 0.0);
    texel = sample_finest_level(TextureRecords(scene().textures).value[slot.texture], moved_by(slot, at.uv[0]));
  }
  return base_colour_and_alpha(mesh, material, c, texel).w >= material.least_alpha;
}

Hit trace_scene(Ray ray, bool any) {
  const SceneRecord s = scene();
  return trace(HierarchyAddress(s.nodes, s.triangles, s.root), ray, any);
}

// SurfacePoint of scene/surface.h: what a renderer of opaque surfaces asks for.
struct Surface {
  vec3 position, geometric_normal, shading_normal;
  SurfaceBrdf brdf;
  vec3 emission;
  uint material;
};

bool has_normal_map(MeshRecord mesh, MaterialRecord material) {
  return material.normal_texture.texture != kNoTexture && mesh.tangents != 0ul;
}

vec3 shading_normal_of(MeshRecord mesh, MaterialRecord material, Corners c, vec4 texel, vec3 front_normal,
                       vec3 geometric_normal, vec3 ray_direction) {
  vec3 normal = front_normal;
  if (mesh.normals != 0ul) normal = normalize_or(mixed3(mesh.normals, c), front_normal);
  const bool towards_viewer = dot(normal, geometric_normal) >= 0.0;
  if (has_normal_map(mesh, material)) {
    const vec4 along = mixed4(mesh.tangents, c);
    normal = mapped_normal(normal, along.xyz, along.w < 0.0 ? -1.0 : 1.0, texel.xyz, material.normal_scale);
  }
  return kept_visible(towards_viewer ? normal : -normal, geometric_normal, -ray_direction);
}

SurfaceBrdf reflection_of(MaterialRecord material, vec3 base_colour, vec4 texel) {
  const float least_alpha = 1e-3;  // kLeastGgxAlpha of scene/surface.h
  const float metallic = material.metallic_override >= 0.0 ? material.metallic_override : material.metallic * texel.z;
  const float roughness = material.roughness * texel.y;
  const float ggx_alpha = material.ggx_alpha_override >= 0.0 ? material.ggx_alpha_override : roughness * roughness;
  return metallic_roughness_brdf(base_colour, clamp(metallic, 0.0, 1.0), vector(material.dielectric_f0),
                                 material.dielectric_f90, clamp(ggx_alpha, least_alpha, 1.0));
}

//   ray_direction  unit, from the viewer to the surface
//   cone_width     diameter of the ray cone at the hit [m], for the textures' level of detail; 0: finest level
Surface surface_at(uint mesh_index, uint triangle, vec2 uv, vec3 ray_direction, float cone_width) {
  const MeshRecord mesh = MeshRecords(scene().meshes).value[mesh_index];
  const MaterialRecord material = MaterialRecords(scene().materials).value[mesh.material];
  const Corners c = corners_of(mesh, triangle, uv);
  const vec3 corner = floats3(mesh.positions, c.index.x);
  const vec3 area_vector =
      cross(floats3(mesh.positions, c.index.y) - corner, floats3(mesh.positions, c.index.z) - corner);
  const float doubled_area = length(area_vector);
  // A triangle without area is met by no ray, but may be evaluated all the same.
  const vec3 front_normal = doubled_area > 0.0 ? area_vector / doubled_area : -ray_direction;
  const float cosine = dot(front_normal, ray_direction);
  const bool front = cosine <= 0.0;
  const Coordinates at = coordinates_of(mesh, c, doubled_area, cone_width, abs(cosine));
  const bool asks_roughness = material.metallic_override < 0.0 || material.ggx_alpha_override < 0.0;
  const bool emits = material.emits != 0u && (front || material.double_sided != 0u);
  const uint wanted = 1u << kSlotOfBaseColour | (asks_roughness ? 1u << kSlotOfRoughness : 0u) |
                      (has_normal_map(mesh, material) ? 1u << kSlotOfNormal : 0u) | (emits ? 1u << kSlotOfEmission : 0u);
  const SlotTexels texels = look_up_slots(mesh.material, wanted, at);
  Surface made;
  made.material = mesh.material;
  made.position = mixed3(mesh.positions, c);
  made.geometric_normal = front ? front_normal : -front_normal;
  made.shading_normal =
      shading_normal_of(mesh, material, c, texels.value[kSlotOfNormal], front_normal, made.geometric_normal, ray_direction);
  const vec4 colour = base_colour_and_alpha(mesh, material, c, texels.value[kSlotOfBaseColour]);
  made.brdf = reflection_of(material, colour.xyz, texels.value[kSlotOfRoughness]);
  made.emission = emits ? vector(material.emission) * texels.value[kSlotOfEmission].xyz : vec3(0.0);
  return made;
}

vec3 sky_pixel(SceneRecord s, int column, int row) {
  const int width = int(s.environment_width);
  const uint wrapped = uint((column % width + width) % width);
  return floats3(s.environment, uint(clamp(row, 0, int(s.environment_height) - 1)) * s.environment_width + wrapped);
}

// sky_radiance of scene/sky.h.
//   direction  unit, from the eye to the sky
vec3 sky_radiance(vec3 direction) {
  const SceneRecord s = scene();
  const vec3 factor = vector(s.environment_radiance);
  if (s.environment_width == 0u) return factor;
  const float pi = 3.14159265358979;
  const float x = (0.5 + atan(direction.x, -direction.z) / (2.0 * pi)) * float(s.environment_width) - 0.5;
  const float y = acos(clamp(direction.y, -1.0, 1.0)) / pi * float(s.environment_height) - 0.5;
  const int column = int(floor(x)), row = int(floor(y));
  const float across = x - float(column), down = y - float(row);
  const vec3 above = sky_pixel(s, column, row) * (1.0 - across) + sky_pixel(s, column + 1, row) * across;
  const vec3 below = sky_pixel(s, column, row + 1) * (1.0 - across) + sky_pixel(s, column + 1, row + 1) * across;
  return factor * (above * (1.0 - down) + below * down);
}
