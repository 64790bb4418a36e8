// SPDX-License-Identifier: Apache-2.0
#include "scene/digest.h"

#include <bit>
#include <map>

#include "base/digest.h"

namespace luciole {
namespace {

#if defined(__GLIBCXX__)
// A new member may change pictures, too: take it below, then mend its line here.
static_assert(sizeof(Mesh) == 208 && sizeof(Material) == 240 && sizeof(TextureSlot) == 32 && sizeof(Texture) == 56 &&
              sizeof(MipImage) == 56 && sizeof(PunctualLight) == 88 && sizeof(Environment) == 48);
#endif

// Structs are taken member by member: the bytes between members are anything.
template <class... Numbers>
void add(Digest& digest, Numbers... numbers) {
  (digest.add_word(std::bit_cast<std::uint32_t>(static_cast<float>(numbers))), ...);
}

void add(Digest& digest, Vec3 v) { add(digest, v.x, v.y, v.z); }

void add(Digest& digest, const TextureSlot& slot) {
  digest.add_word(static_cast<std::uint32_t>(slot.texture));
  digest.add_word(slot.uv_set);
  add(digest, slot.a, slot.b, slot.c, slot.d, slot.offset.x, slot.offset.y);
}

void add(Digest& digest, const Mesh& mesh) {
  digest.add_word(mesh.material);
  digest.add(mesh.positions);
  digest.add(mesh.normals);
  digest.add(mesh.tangents);
  for (const std::vector<Vec2>& uv : mesh.uv) digest.add(uv);
  digest.add(mesh.colours);
  digest.add(mesh.indices);
}

void add(Digest& digest, const Material& material) {
  const Vec4 colour = material.base_colour;
  add(digest, colour.x, colour.y, colour.z, colour.w, material.metallic, material.roughness, material.normal_scale);
  add(digest, material.emission);
  add(digest, material.dielectric_f0);
  add(digest, material.alpha_cutoff, material.dielectric_f90, material.ggx_alpha_override, material.metallic_override);
  for (const TextureSlot* slot : {&material.base_colour_texture, &material.metallic_roughness_texture,
                                  &material.normal_texture, &material.emissive_texture}) {
    add(digest, *slot);
  }
  digest.add_word(static_cast<std::uint64_t>(material.alpha_mode));
  digest.add_word(material.double_sided);
  digest.add_word(material.unlit);
}

void add(Digest& digest, const PunctualLight& light) {
  digest.add_word(static_cast<std::uint64_t>(light.kind));
  for (const Vec3 v : {light.position, light.direction, light.intensity}) add(digest, v);
  add(digest, light.cos_inner, light.cos_outer);
}

// Further mip levels follow from the first.
std::uint64_t digest_of(const MipImage& image) {
  Digest digest;
  digest.add_word(image.levels.size());
  digest.add_word(image.srgb);
  if (!image.levels.empty()) {
    const MipImage::Level& level = image.levels.front();
    digest.add_word(level.width);
    digest.add_word(level.height);
    digest.add_bytes(image.texels(level), std::size_t(level.width) * level.height * 4);
  }
  return digest.value();
}

void add_textures(Digest& digest, const std::vector<Texture>& textures) {
  std::map<const MipImage*, std::uint64_t> images;  // many textures share one
  for (const Texture& texture : textures) {
    const MipImage* image = texture.image.get();
    if (image != nullptr && !images.contains(image)) images[image] = digest_of(*image);
    digest.add_word(image == nullptr ? 0 : images[image]);
    for (const int choice :
         {static_cast<int>(texture.wrap_u), static_cast<int>(texture.wrap_v), int(texture.magnify_linear),
          int(texture.minify_linear), static_cast<int>(texture.mip_filter)}) {
      digest.add_word(static_cast<std::uint64_t>(choice));
    }
  }
}

template <class T>
void add_all(Digest& digest, const std::vector<T>& parts) {
  digest.add_word(parts.size());
  for (const T& part : parts) add(digest, part);
}

}  // namespace

std::string scene_digest(const Scene& scene) {
  Digest digest;
  add_all(digest, scene.meshes);
  add_all(digest, scene.materials);
  digest.add_word(scene.textures.size());
  add_textures(digest, scene.textures);
  add_all(digest, scene.lights);
  add(digest, scene.environment.radiance);
  digest.add_word(scene.environment.width);
  digest.add(scene.environment.pixels);
  return digest.hexadecimal();
}

}  // namespace luciole
