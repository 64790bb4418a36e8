// SPDX-License-Identifier: Apache-2.0
// evaluate_surface over registers. All lanes are hits of one mesh, so what depends on the mesh and its material is
// decided once, and only vertices and texels are gathered. Slots of a material that read their textures at the same
// places, as the maps of one surface mostly do, share coordinates, level of detail, addresses and weights.
#include "scene/surface_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
namespace {
#include "equations/cpp/wide_gather.inc"

constexpr float kLeastAlpha = 1e-3f;  // kLeastGgxAlpha of surface.h

LUCIOLE_FN real3 broadcast3(const float (&v)[3]) { return real3(real(v[0]), real(v[1]), real(v[2])); }
LUCIOLE_FN real3 load3(const float (&planes)[3][kSurfaceLanes], int lane) {
  return real3(load(planes[0] + lane), load(planes[1] + lane), load(planes[2] + lane));
}
LUCIOLE_FN void store3(float (&planes)[3][kSurfaceLanes], int lane, real3 value) {
  store(planes[0] + lane, value.x);
  store(planes[1] + lane, value.y);
  store(planes[2] + lane, value.z);
}

// The corners of each lane's triangle and the weights of its point.
struct Corners {
  uint_ index[3];
  real weight[3];
};

LUCIOLE_FN Corners corners_of(const SurfaceMesh& mesh, const SurfaceQueries& in, int lane) {
  const uint_ triangle = load(in.triangle + lane), first = triangle + triangle + triangle;
  const real u = load(in.u + lane), v = load(in.v + lane);
  Corners corners;
  for (int corner = 0; corner < 3; ++corner) corners.index[corner] = gather(mesh.indices + corner, first);
  corners.weight[0] = 1.0f - u - v, corners.weight[1] = u, corners.weight[2] = v;
  return corners;
}

LUCIOLE_FN real2 gather2(const float* values, uint_ vertex) {
  const uint_ first = vertex + vertex;
  return real2(gather(values, first), gather(values + 1, first));
}
LUCIOLE_FN real3 gather3(const float* values, uint_ vertex) {
  const uint_ first = vertex + vertex + vertex;
  return real3(gather(values, first), gather(values + 1, first), gather(values + 2, first));
}
LUCIOLE_FN real4 gather4(const float* values, uint_ vertex) {
  const uint_ first = vertex << 2u;
  return real4(gather(values, first), gather(values + 1, first), gather(values + 2, first), gather(values + 3, first));
}
template <class T>
LUCIOLE_FN T mixed(const Corners& corners, T a, T b, T c) {
  return a * corners.weight[0] + b * corners.weight[1] + c * corners.weight[2];
}
LUCIOLE_FN real3 mix3(const float* values, const Corners& c) {
  return mixed(c, gather3(values, c.index[0]), gather3(values, c.index[1]), gather3(values, c.index[2]));
}
LUCIOLE_FN real4 mix4(const float* values, const Corners& c) {
  return mixed(c, gather4(values, c.index[0]), gather4(values, c.index[1]), gather4(values, c.index[2]));
}

#include "scene/texture_lanes.inc"

// One set of texture coordinates at the hits.
struct Coordinates {
  real2 uv;
  real area_per_area;  // of the triangle in texture space over its area in the world [1/m^2]
};

LUCIOLE_FN Coordinates coordinates_of(const float* uv, const Corners& c, real doubled_area) {
  const real2 a = gather2(uv, c.index[0]), b = gather2(uv, c.index[1]), d = gather2(uv, c.index[2]);
  const real2 along = b - a, across = d - a;
  const real zero(0.0f);
  Coordinates made;
  made.uv = mixed(c, a, b, d);
  made.area_per_area = select(doubled_area > zero, abs(along.x * across.y - across.x * along.y) / doubled_area, zero);
  return made;
}

// The texels that all the slots of the material read, each place once.
struct LookUps {
  TexelPlaces places[kSurfaceSlots];
};

LUCIOLE_FN void place_look_ups(const SurfaceMesh& mesh, const Corners& corners, real doubled_area, real cone_width,
                               real cos_at_surface, LookUps& look_ups) {
  Coordinates sets[2];
  for (int set = 0; set < 2; ++set) {
    if (mesh.uv[set] != nullptr) sets[set] = coordinates_of(mesh.uv[set], corners, doubled_area);
  }
  for (int i = 0; i < kSurfaceSlots; ++i) {
    const SurfaceSlot& slot = mesh.material.slot[i];
    if (slot.texture == nullptr || slot.same_texels_as != i) continue;
    const Coordinates& at = sets[slot.uv_set];
    const float scale = slot.a * slot.d - slot.b * slot.c;
    const float texels = static_cast<float>(slot.texture->width) * static_cast<float>(slot.texture->height);
    const real lod = texture_level_of_detail(at.area_per_area * real(scale < 0 ? -scale : scale), real(texels),
                                             cone_width, cos_at_surface);
    const real2 uv(at.uv.x * slot.a + at.uv.y * slot.b + slot.offset[0],
                   at.uv.x * slot.c + at.uv.y * slot.d + slot.offset[1]);
    look_ups.places[i] = texel_places(*slot.texture, uv, lod);
  }
}

// White where the slot has no texture.
LUCIOLE_FN real3 look_up(const SurfaceMaterial& material, const LookUps& look_ups, int name) {
  const SurfaceSlot& slot = material.slot[name];
  if (slot.texture == nullptr) return real3(real(1.0f), real(1.0f), real(1.0f));
  return texel_mean(*slot.texture, look_ups.places[slot.same_texels_as]);
}

struct Normals {
  real3 geometric, shading;
};

LUCIOLE_FN Normals normals_of(const SurfaceMesh& mesh, const Corners& corners, const LookUps& look_ups,
                              real3 front_normal, mask front, real3 ray_direction) {
  Normals made;
  made.geometric = select(front, front_normal, -front_normal);
  const real3 normal = mesh.normals == nullptr ? front_normal : normalize_or(mix3(mesh.normals, corners), front_normal);
  real3 bent = normal;
  if (mesh.material.slot[kNormalSlot].texture != nullptr && mesh.tangents != nullptr) {
    const real4 along = mix4(mesh.tangents, corners);
    const real handedness = select(along.w < 0.0f, real(-1.0f), real(1.0f));
    bent = mapped_normal(normal, real3(along.x, along.y, along.z), handedness,
                         look_up(mesh.material, look_ups, kNormalSlot), real(mesh.material.normal_scale));
  }
  const mask towards_viewer = dot(normal, made.geometric) >= 0.0f;
  made.shading = kept_visible(select(towards_viewer, bent, -bent), made.geometric, -ray_direction);
  return made;
}

LUCIOLE_FN real unit_range(real x) { return clamp(x, real(0.0f), real(1.0f)); }

LUCIOLE_FN SurfaceBrdf reflection_of(const SurfaceMesh& mesh, const Corners& corners, const LookUps& look_ups) {
  const SurfaceMaterial& material = mesh.material;
  real3 colour = look_up(material, look_ups, kBaseColourSlot) * broadcast3(material.base_colour);
  if (mesh.colours != nullptr) {
    const real4 vertex = mix4(mesh.colours, corners);
    colour = colour * real3(vertex.x, vertex.y, vertex.z);
  }
  colour = real3(unit_range(colour.x), unit_range(colour.y), unit_range(colour.z));
  const real3 texel = look_up(material, look_ups, kReflectionSlot);
  const real metallic =
      material.metallic_override >= 0 ? real(material.metallic_override) : texel.z * material.metallic;
  const real roughness = texel.y * material.roughness;
  const real alpha = material.ggx_alpha_override >= 0 ? real(material.ggx_alpha_override) : roughness * roughness;
  return metallic_roughness_brdf(colour, unit_range(metallic), broadcast3(material.dielectric_f0),
                                 real(material.dielectric_f90), clamp(alpha, real(kLeastAlpha), real(1.0f)));
}

LUCIOLE_FN void evaluate_lanes(const SurfaceMesh& mesh, const SurfaceQueries& in, int lane, SurfaceAnswers& out) {
  const Corners corners = corners_of(mesh, in, lane);
  const real3 ray_direction = normalize(load3(in.ray_direction, lane));
  const real3 a = gather3(mesh.positions, corners.index[0]), b = gather3(mesh.positions, corners.index[1]),
              c = gather3(mesh.positions, corners.index[2]);
  const real3 area_vector = cross(b - a, c - a);
  const real doubled_area = length(area_vector);
  const real3 front_normal = select(doubled_area > 0.0f, area_vector / doubled_area, -ray_direction);
  const real cosine = dot(front_normal, ray_direction);
  const mask front = cosine <= 0.0f;

  LookUps look_ups;
  place_look_ups(mesh, corners, doubled_area, load(in.cone_width + lane), abs(cosine), look_ups);
  const Normals normals = normals_of(mesh, corners, look_ups, front_normal, front, ray_direction);
  const SurfaceBrdf brdf = reflection_of(mesh, corners, look_ups);
  const SurfaceMaterial& material = mesh.material;
  real3 emission;
  if (material.emits) {
    emission = look_up(material, look_ups, kEmissiveSlot) * broadcast3(material.emission);
    if (!material.double_sided) emission = select(front, emission, real3());
  }
  store3(out.position, lane, mixed(corners, a, b, c));
  store3(out.geometric_normal, lane, normals.geometric);
  store3(out.shading_normal, lane, normals.shading);
  store3(out.diffuse_albedo, lane, brdf.diffuse_albedo);
  store3(out.f0, lane, brdf.f0);
  store(out.f90 + lane, brdf.f90);
  store(out.ggx_alpha + lane, brdf.ggx_alpha);
  store3(out.emission, lane, emission);
}

}  // namespace

void evaluate_surfaces(const SurfaceMesh& mesh, const SurfaceQueries& queries, SurfaceAnswers& answers) {
  for (int lane = 0; lane < kSurfaceLanes; lane += kLanes) evaluate_lanes(mesh, queries, lane, answers);
}

}  // namespace luciole::LUCIOLE_ISA
