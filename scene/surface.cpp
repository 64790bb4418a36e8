// SPDX-License-Identifier: Apache-2.0
#include "scene/surface.h"

#include <algorithm>
#include <cmath>

#include "equations/cpp/float.h"
#include "scene/texture_sampling.h"

namespace luciole {
namespace {

// A triangle's corners and the weights of a point in it.
struct Corners {
  std::uint32_t index[3];
  float weight[3];

  Corners(const Mesh& mesh, const SurfaceHit& hit) : weight{1 - hit.u - hit.v, hit.u, hit.v} {
    const std::uint32_t* corner = &mesh.indices[std::size_t(hit.triangle) * 3];
    std::copy(corner, corner + 3, index);
  }
  Vec2 mix(const std::vector<Vec2>& v) const {
    return v[index[0]] * weight[0] + v[index[1]] * weight[1] + v[index[2]] * weight[2];
  }
  Vec3 mix(const std::vector<Vec3>& v) const {
    return v[index[0]] * weight[0] + v[index[1]] * weight[1] + v[index[2]] * weight[2];
  }
  Vec4 mix(const std::vector<Vec4>& v) const {
    return v[index[0]] * weight[0] + v[index[1]] * weight[1] + v[index[2]] * weight[2];
  }
};

// Looks up a material's textures at one hit. Both coordinate sets are interpolated once, for all the slots.
class TextureLookUp {
 public:
  TextureLookUp(const Scene& scene, const Mesh& mesh, const Corners& corners) : scene_(scene) {
    for (std::size_t set = 0; set < 2; ++set) {
      if (!mesh.uv[set].empty()) uv_[set] = corners.mix(mesh.uv[set]);
    }
  }

  // Without this every look-up is at the finest level.
  //   doubled_area    of the triangle [m^2]
  //   cos_at_surface  |cosine| between ray and geometric normal
  void set_cone(const Mesh& mesh, const Corners& corners, float doubled_area, float cone_width, float cos_at_surface) {
    if (!(cone_width > 0) || !(doubled_area > 0)) return;
    cone_width_ = cone_width;
    cos_at_surface_ = cos_at_surface;
    for (std::size_t set = 0; set < 2; ++set) {
      const std::vector<Vec2>& uv = mesh.uv[set];
      if (uv.empty()) continue;
      const Vec2 d1 = uv[corners.index[1]] - uv[corners.index[0]], d2 = uv[corners.index[2]] - uv[corners.index[0]];
      uv_area_per_area_[set] = std::abs(d1.x * d2.y - d2.x * d1.y) / doubled_area;
    }
  }

  // White where the slot has no texture, as the format says.
  Vec4 sample(const TextureSlot& slot) const {
    if (slot.texture < 0) return {1, 1, 1, 1};
    const Texture& texture = scene_.textures[static_cast<std::size_t>(slot.texture)];
    const MipImage::Level& finest = texture.image->levels[0];
    const float density = uv_area_per_area_[slot.uv_set] * std::abs(slot.a * slot.d - slot.b * slot.c);
    const float texels = static_cast<float>(finest.width) * static_cast<float>(finest.height);
    const float lod = f32::texture_level_of_detail(density, texels, cone_width_, cos_at_surface_);
    return sample_texture(texture, slot.transform(uv_[slot.uv_set]), lod);
  }

 private:
  const Scene& scene_;
  Vec2 uv_[2];                          // (0, 0) where the mesh has no such set
  float uv_area_per_area_[2] = {0, 0};  // [1/m^2]
  float cone_width_ = 0, cos_at_surface_ = 1;
};

Vec4 base_colour_and_alpha(const Material& material, const Mesh& mesh, const Corners& corners,
                           const TextureLookUp& textures) {
  Vec4 colour = textures.sample(material.base_colour_texture);
  const Vec4& factor = material.base_colour;
  colour = {colour.x * factor.x, colour.y * factor.y, colour.z * factor.z, colour.w * factor.w};
  if (!mesh.colours.empty()) {
    const Vec4 vertex = corners.mix(mesh.colours);
    colour = {colour.x * vertex.x, colour.y * vertex.y, colour.z * vertex.z, colour.w * vertex.w};
  }
  const auto unit = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
  return {unit(colour.x), unit(colour.y), unit(colour.z), unit(colour.w)};
}

// The interpolated normal, bent by the normal map, on the side where the file's normals point.
Vec3 mapped_normal(const Material& material, const Mesh& mesh, const Corners& corners, const TextureLookUp& textures,
                   Vec3 normal) {
  if (material.normal_texture.texture < 0 || mesh.tangents.empty()) return normal;
  const Vec4 texel = textures.sample(material.normal_texture);
  const Vec4 along = corners.mix(mesh.tangents);
  return f32::mapped_normal(normal, Vec3(along.x, along.y, along.z), along.w < 0 ? -1.0f : 1.0f,
                            Vec3(texel.x, texel.y, texel.z), material.normal_scale);
}

// Normal of the counter-clockwise side times twice the area.
Vec3 doubled_area_vector(const Mesh& mesh, const Corners& corners) {
  const Vec3 a = mesh.positions[corners.index[0]];
  return cross(mesh.positions[corners.index[1]] - a, mesh.positions[corners.index[2]] - a);
}

void set_normals(const Material& material, const Mesh& mesh, const Corners& corners, const TextureLookUp& textures,
                 Vec3 front_normal, Vec3 ray_direction, SurfacePoint& point) {
  point.geometric_normal = point.front ? front_normal : -front_normal;
  Vec3 normal = front_normal;
  if (!mesh.normals.empty()) normal = f32::normalize_or(corners.mix(mesh.normals), front_normal);
  const bool towards_viewer = dot(normal, point.geometric_normal) >= 0;
  normal = mapped_normal(material, mesh, corners, textures, normal);
  point.shading_normal = f32::kept_visible(towards_viewer ? normal : -normal, point.geometric_normal, -ray_direction);
}

void set_reflection(const Material& material, const TextureLookUp& textures, SurfacePoint& point) {
  const Vec4 texel = textures.sample(material.metallic_roughness_texture);
  const float metallic = material.metallic_override >= 0 ? material.metallic_override : material.metallic * texel.z;
  point.metallic = std::clamp(metallic, 0.0f, 1.0f);
  const float roughness = material.roughness * texel.y;
  const float alpha = material.ggx_alpha_override >= 0 ? material.ggx_alpha_override : roughness * roughness;
  const f32::SurfaceBrdf brdf =
      f32::metallic_roughness_brdf(point.base_colour, point.metallic, material.dielectric_f0, material.dielectric_f90,
                                   std::clamp(alpha, kLeastGgxAlpha, 1.0f));
  point.diffuse_albedo = brdf.diffuse_albedo;
  point.f0 = brdf.f0;
  point.f90 = brdf.f90;
  point.ggx_alpha = brdf.ggx_alpha;
}

}  // namespace

SurfacePoint evaluate_surface(const Scene& scene, const SurfaceHit& hit, Vec3 ray_direction, float cone_width) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Material& material = scene.materials[mesh.material];
  const Corners corners(mesh, hit);
  const Vec3 area_vector = doubled_area_vector(mesh, corners);
  const float doubled_area = length(area_vector);
  // A triangle without area is met by no ray, but may be evaluated all the same.
  const Vec3 front_normal = doubled_area > 0 ? area_vector / doubled_area : -ray_direction;
  const float cosine = dot(front_normal, ray_direction);
  TextureLookUp textures(scene, mesh, corners);
  textures.set_cone(mesh, corners, doubled_area, cone_width, std::abs(cosine));

  SurfacePoint point;
  point.position = corners.mix(mesh.positions);
  point.front = cosine <= 0;
  set_normals(material, mesh, corners, textures, front_normal, ray_direction, point);
  const Vec4 colour = base_colour_and_alpha(material, mesh, corners, textures);
  point.base_colour = {colour.x, colour.y, colour.z};
  point.alpha = material.alpha_mode == AlphaMode::opaque ? 1.0f : colour.w;
  set_reflection(material, textures, point);
  point.emission = {0, 0, 0};
  const bool emits = material.emission.x > 0 || material.emission.y > 0 || material.emission.z > 0;
  if (emits && (point.front || material.double_sided)) {
    const Vec4 texel = textures.sample(material.emissive_texture);
    point.emission = material.emission * Vec3(texel.x, texel.y, texel.z);
  }
  return point;
}

float surface_alpha(const Scene& scene, const SurfaceHit& hit) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Material& material = scene.materials[mesh.material];
  if (material.alpha_mode == AlphaMode::opaque) return 1;
  const Corners corners(mesh, hit);
  return base_colour_and_alpha(material, mesh, corners, TextureLookUp(scene, mesh, corners)).w;
}

bool alpha_passes(const Scene& scene, const SurfaceHit& hit) {
  const Material& material = scene.materials[scene.meshes[hit.mesh].material];
  if (material.alpha_mode == AlphaMode::opaque) return true;
  return surface_alpha(scene, hit) >= (material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 0.5f);
}

bool is_blended(const Scene& scene, std::uint32_t mesh) {
  return scene.materials[scene.meshes[mesh].material].alpha_mode == AlphaMode::blend;
}

bool can_have_holes(const Scene& scene, const Mesh& mesh, bool blend_at_random) {
  const Material& material = scene.materials[mesh.material];
  if (material.alpha_mode == AlphaMode::opaque) return false;
  const bool blends = blend_at_random && material.alpha_mode == AlphaMode::blend;
  const float cutoff = blends ? 1.0f : material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 0.5f;
  if (material.base_colour.w < cutoff) return true;
  const std::int32_t texture = material.base_colour_texture.texture;
  if (texture >= 0 && scene.textures[static_cast<std::size_t>(texture)].image->has_alpha) return true;
  return std::any_of(mesh.colours.begin(), mesh.colours.end(), [](const Vec4& colour) { return colour.w < 1; });
}

}  // namespace luciole
