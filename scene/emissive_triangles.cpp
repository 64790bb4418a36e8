// SPDX-License-Identifier: Apache-2.0
#include "scene/emissive_triangles.h"

#include <algorithm>
#include <cmath>

#include "scene/surface.h"
#include "scene/texture_sampling.h"

namespace luciole {
namespace {

// At most 1,024 points per triangle. Sixteen would do for smooth textures, but miss the torches of a voxel world, which
// are two texels wide in a tile of sixteen.
constexpr int kMostCells = 32;

bool shines(Vec3 radiance) { return radiance.x > 0 || radiance.y > 0 || radiance.z > 0; }

// Splits a triangle into cells^2 triangles of equal area; the barycentric centre of number (row, place), with 2 row + 1
// places in a row.
SurfaceHit centre_of_part(std::uint32_t mesh, std::uint32_t triangle, float cells, int row, int place) {
  const auto k = static_cast<float>(place / 2), r = static_cast<float>(row);
  const bool upright = place % 2 == 0;
  // Corners of an upright part, in cells: (r - k, k), (r + 1 - k, k), (r - k, k + 1) of (u, v).
  const float third = upright ? 1.0f / 3.0f : 2.0f / 3.0f;
  const float u = upright ? r - k + third : r - k - 1 + third;
  return {mesh, triangle, u / cells, (k + third) / cells};
}

// How many texels of the finest level a triangle covers.
float texels_covered(const Scene& scene, const Mesh& mesh, const TextureSlot& slot, std::uint32_t triangle) {
  if (slot.texture < 0 || mesh.uv[slot.uv_set].empty()) return 1;
  const MipImage::Level& finest = scene.textures[static_cast<std::size_t>(slot.texture)].image->levels[0];
  const std::uint32_t* corner = &mesh.indices[std::size_t(triangle) * 3];
  const Vec2 origin = slot.transform(mesh.uv[slot.uv_set][corner[0]]);
  const Vec2 d1 = slot.transform(mesh.uv[slot.uv_set][corner[1]]) - origin;
  const Vec2 d2 = slot.transform(mesh.uv[slot.uv_set][corner[2]]) - origin;
  return 0.5f * std::abs(d1.x * d2.y - d2.x * d1.y) * static_cast<float>(finest.width) *
         static_cast<float>(finest.height);
}

Vec3 mean_radiance(const Scene& scene, std::uint32_t mesh_index, std::uint32_t triangle) {
  const Mesh& mesh = scene.meshes[mesh_index];
  const Material& material = scene.materials[mesh.material];
  const bool holes = material.alpha_mode != AlphaMode::opaque;
  if (material.emissive_texture.texture < 0 && !holes) return material.emission;
  const float shining_texels = texels_covered(scene, mesh, material.emissive_texture, triangle);
  const float masking_texels = holes ? texels_covered(scene, mesh, material.base_colour_texture, triangle) : 1;
  const float wanted = std::ceil(std::sqrt(std::min(std::max(shining_texels, masking_texels), 1e6f)));
  const int cells = std::clamp(static_cast<int>(wanted), 1, kMostCells);
  const auto points = static_cast<float>(cells * cells);
  const float lod = shining_texels > points ? 0.5f * std::log2(shining_texels / points) : 0.0f;
  Vec3 sum(0, 0, 0);
  for (int row = 0; row < cells; ++row) {
    for (int place = 0; place < 2 * row + 1; ++place) {
      const SurfaceHit hit = centre_of_part(mesh_index, triangle, static_cast<float>(cells), row, place);
      if (!holes || alpha_passes(scene, hit)) sum += emission_at(scene, hit, lod);
    }
  }
  return sum / points;
}

}  // namespace

Vec3 emission_at(const Scene& scene, const SurfaceHit& hit, float level_of_detail) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Material& material = scene.materials[mesh.material];
  const TextureSlot& slot = material.emissive_texture;
  if (slot.texture < 0) return material.emission;
  Vec2 uv(0, 0);
  if (const std::vector<Vec2>& set = mesh.uv[slot.uv_set]; !set.empty()) {
    const std::uint32_t* corner = &mesh.indices[std::size_t(hit.triangle) * 3];
    uv = set[corner[0]] * (1 - hit.u - hit.v) + set[corner[1]] * hit.u + set[corner[2]] * hit.v;
  }
  const Vec4 texel =
      sample_texture(scene.textures[static_cast<std::size_t>(slot.texture)], slot.transform(uv), level_of_detail);
  return material.emission * Vec3(texel.x, texel.y, texel.z);
}

std::vector<EmissiveTriangle> emissive_triangles(const Scene& scene) {
  std::vector<EmissiveTriangle> result;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const Material& material = scene.materials[mesh.material];
    if (material.unlit || !shines(material.emission)) continue;
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
      const std::uint32_t* corner = &mesh.indices[std::size_t(t) * 3];
      const Vec3 a = mesh.positions[corner[0]];
      const float area = 0.5f * length(cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a));
      if (!(area > 0)) continue;
      const Vec3 radiance = mean_radiance(scene, m, t);
      if (shines(radiance)) result.push_back({m, t, area, radiance, material.double_sided});
    }
  }
  return result;
}

Vec3 power(const EmissiveTriangle& triangle) {
  constexpr float kPi = 3.14159265f;
  return triangle.radiance * (kPi * triangle.area * (triangle.both_sides ? 2.0f : 1.0f));
}

}  // namespace luciole
