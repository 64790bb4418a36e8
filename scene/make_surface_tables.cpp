// SPDX-License-Identifier: Apache-2.0
#include "scene/make_surface_tables.h"

#include <algorithm>

#include "base/assert.h"
#include "scene/srgb.h"

namespace luciole {
namespace {

void copy(float (&to)[3], Vec3 from) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

SurfaceTexture table_of(const Texture& from) {
  const MipImage& image = *from.image;
  LUCIOLE_ASSERT_LE(image.levels.size(), std::size_t(kMostMipLevels));
  SurfaceTexture made;
  // Four bytes each, on a 64-byte boundary; the processors of the kernels keep the lowest byte first.
  made.texels = reinterpret_cast<const std::uint32_t*>(image.rgba.data());
  made.width = image.levels[0].width, made.height = image.levels[0].height;
  for (std::size_t i = 0; i < image.levels.size(); ++i) made.first_texel[i] = image.levels[i].first_texel;
  made.coarsest = static_cast<float>(image.levels.size() - 1);
  made.linear_from_srgb = image.srgb ? kLinearFromSrgb8.data() : nullptr;
  made.wrap_u = from.wrap_u, made.wrap_v = from.wrap_v;
  made.mip_filter = from.mip_filter;
  made.magnify_linear = from.magnify_linear, made.minify_linear = from.minify_linear;
  return made;
}

bool reads_same_places(const SurfaceTexture& a, const SurfaceTexture& b) {
  return a.width == b.width && a.height == b.height && a.coarsest == b.coarsest && a.wrap_u == b.wrap_u &&
         a.wrap_v == b.wrap_v && a.mip_filter == b.mip_filter && a.magnify_linear == b.magnify_linear &&
         a.minify_linear == b.minify_linear;
}

bool reads_same_places(const SurfaceSlot& a, const SurfaceSlot& b) {
  return a.uv_set == b.uv_set && a.a == b.a && a.b == b.b && a.c == b.c && a.d == b.d && a.offset[0] == b.offset[0] &&
         a.offset[1] == b.offset[1] && reads_same_places(*a.texture, *b.texture);
}

}  // namespace

SurfaceTables::SurfaceTables(const Scene& scene) {
  for (const Texture& texture : scene.textures) textures_.push_back(table_of(texture));
  for (const Mesh& from : scene.meshes) {
    const auto floats = [](const auto& values) { return values.empty() ? nullptr : &values.front().x; };
    SurfaceMesh& mesh = meshes_.emplace_back();
    mesh.positions = floats(from.positions), mesh.normals = floats(from.normals);
    mesh.tangents = floats(from.tangents), mesh.colours = floats(from.colours);
    for (std::size_t set = 0; set < 2; ++set) mesh.uv[set] = floats(from.uv[set]);
    mesh.indices = from.indices.data();
    mesh.material = material(scene.materials[from.material], !from.tangents.empty());
  }
}

SurfaceSlot SurfaceTables::slot(const TextureSlot& from) const {
  SurfaceSlot made;
  if (from.texture < 0) return made;
  made.texture = &textures_[static_cast<std::size_t>(from.texture)];
  made.uv_set = static_cast<int>(from.uv_set);
  made.a = from.a, made.b = from.b, made.c = from.c, made.d = from.d;
  made.offset[0] = from.offset.x, made.offset[1] = from.offset.y;
  return made;
}

SurfaceMaterial SurfaceTables::material(const Material& from, bool has_tangents) const {
  SurfaceMaterial made;
  copy(made.base_colour, Vec3(from.base_colour.x, from.base_colour.y, from.base_colour.z));
  copy(made.emission, from.emission);
  copy(made.dielectric_f0, from.dielectric_f0);
  made.dielectric_f90 = from.dielectric_f90;
  made.metallic = from.metallic, made.roughness = from.roughness;
  made.metallic_override = from.metallic_override, made.ggx_alpha_override = from.ggx_alpha_override;
  made.normal_scale = from.normal_scale;
  made.emits = from.emission.x > 0 || from.emission.y > 0 || from.emission.z > 0;
  made.double_sided = from.double_sided;
  // Textures that nothing comes of are not read.
  made.slot[kBaseColourSlot] = slot(from.base_colour_texture);
  if (has_tangents) made.slot[kNormalSlot] = slot(from.normal_texture);
  if (from.metallic_override < 0 || from.ggx_alpha_override < 0) {
    made.slot[kReflectionSlot] = slot(from.metallic_roughness_texture);
  }
  if (made.emits) made.slot[kEmissiveSlot] = slot(from.emissive_texture);
  for (int i = 0; i < kSurfaceSlots; ++i) {
    int first = 0;
    while (first < i && !(made.slot[i].texture != nullptr && made.slot[first].texture != nullptr &&
                          reads_same_places(made.slot[first], made.slot[i]))) {
      ++first;
    }
    made.slot[i].same_texels_as = first;
  }
  return made;
}

}  // namespace luciole
