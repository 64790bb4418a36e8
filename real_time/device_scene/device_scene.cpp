// SPDX-License-Identifier: Apache-2.0
#include "real_time/device_scene/device_scene.h"

#include <map>

#include "real_time/device_scene/upload.h"
#include "scene/srgb.h"
#include "scene/surface.h"

namespace luciole {
namespace {

static_assert(kWrapRepeat == word_(Wrap::repeat) && kWrapMirrored == word_(Wrap::mirrored_repeat) &&
              kWrapClamp == word_(Wrap::clamp_to_edge));
static_assert(kMipNone == word_(MipFilter::none) && kMipNearest == word_(MipFilter::nearest) &&
              kMipLinear == word_(MipFilter::linear));

constexpr std::uint64_t kWord = 4;

void copy(float (&to)[3], Vec3 from) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

// Words of a buffer, filled piece by piece.
class Words {
 public:
  // Where the values begin [words].
  template <class T>
  std::uint64_t add(const std::vector<T>& values) {
    static_assert(sizeof(T) % kWord == 0);
    return add(values.data(), values.size() * sizeof(T) / kWord);
  }
  std::uint64_t add(const void* from, std::size_t count) {
    const std::uint64_t begin = words_.size();
    words_.resize(begin + count);
    if (count > 0) std::memcpy(words_.data() + begin, from, count * kWord);
    return begin;
  }
  const std::vector<std::uint32_t>& words() const { return words_; }

 private:
  std::vector<std::uint32_t> words_;
};

// Vertices of all meshes one after the other, and where they begin; moved by the buffer's address once it is known.
struct FlatMeshes {
  Words vertices;
  std::vector<MeshRecord> meshes;  // addresses in bytes from the first word; 0: none

  explicit FlatMeshes(const Scene& scene) {
    vertices.add(std::vector<std::uint32_t>{0});  // nobody's, so that nothing lies at 0
    for (const Mesh& from : scene.meshes) {
      const auto placed = [&](const auto& values) { return values.empty() ? 0 : vertices.add(values) * kWord; };
      MeshRecord& mesh = meshes.emplace_back();
      mesh.positions = placed(from.positions), mesh.normals = placed(from.normals);
      mesh.tangents = placed(from.tangents), mesh.colours = placed(from.colours);
      for (std::size_t set = 0; set < 2; ++set) mesh.uv[set] = placed(from.uv[set]);
      mesh.indices = placed(from.indices);
      mesh.material = from.material, mesh.unused = 0;
    }
  }
  void move_to(std::uint64_t address) {
    const auto move = [&](address_& at) { at = at == 0 ? 0 : address + at; };
    for (MeshRecord& mesh : meshes) {
      for (address_* at :
           {&mesh.positions, &mesh.normals, &mesh.tangents, &mesh.colours, &mesh.uv[0], &mesh.uv[1], &mesh.indices}) {
        move(*at);
      }
    }
  }
};

// Images, each once, with their levels' places and the table of sRGB before them.
struct FlatTextures {
  Words small;                          // the table, then the levels' first texels
  std::vector<const MipImage*> images;  // one after the other
  std::uint64_t texels = 0;             // of all images
  std::vector<TextureRecord> textures;  // addresses in bytes from the first of its kind

  explicit FlatTextures(const Scene& scene) {
    small.add(kLinearFromSrgb8.data(), kLinearFromSrgb8.size());
    struct Place {
      std::uint64_t texels, levels;
    };
    std::map<const MipImage*, Place> known;
    for (const Texture& from : scene.textures) {
      const MipImage& image = *from.image;
      const auto [place, is_new] = known.try_emplace(&image);
      if (is_new) {
        std::vector<std::uint32_t> first;
        for (const MipImage::Level& level : image.levels) first.push_back(level.first_texel);
        place->second = {texels * kWord, small.add(first) * kWord};
        texels += image.rgba.size() / kWord;
        images.push_back(&image);
      }
      textures.push_back({place->second.texels, place->second.levels, image.levels[0].width, image.levels[0].height,
                          static_cast<word_>(image.levels.size()), image.srgb, word_(from.wrap_u), word_(from.wrap_v),
                          word_(from.mip_filter), from.magnify_linear, from.minify_linear, 0});
    }
  }
  void move_to(std::uint64_t texel_address, std::uint64_t small_address) {
    for (TextureRecord& texture : textures) texture.texels += texel_address, texture.levels += small_address;
  }
  void fill_texels(void* to) const {
    auto* at = static_cast<std::uint8_t*>(to);
    for (const MipImage* image : images) {
      std::memcpy(at, image->rgba.data(), image->rgba.size());  // red is in the lowest byte, as this processor has it
      at += image->rgba.size();
    }
  }
};

SlotRecord slot_of(const TextureSlot& from) {
  return {from.texture < 0 ? kNoTexture : static_cast<word_>(from.texture),
          from.uv_set,
          from.a,
          from.b,
          from.c,
          from.d,
          {from.offset.x, from.offset.y}};
}

MaterialRecord material_of(const Material& from) {
  MaterialRecord made{};
  made.base_colour_texture = slot_of(from.base_colour_texture);
  made.metallic_roughness_texture = slot_of(from.metallic_roughness_texture);
  made.normal_texture = slot_of(from.normal_texture), made.emissive_texture = slot_of(from.emissive_texture);
  const Vec4& colour = from.base_colour;
  made.base_colour[0] = colour.x, made.base_colour[1] = colour.y, made.base_colour[2] = colour.z;
  made.base_colour[3] = colour.w;
  copy(made.emission, from.emission), copy(made.dielectric_f0, from.dielectric_f0);
  made.dielectric_f90 = from.dielectric_f90;
  made.metallic = from.metallic, made.roughness = from.roughness, made.normal_scale = from.normal_scale;
  made.metallic_override = from.metallic_override, made.ggx_alpha_override = from.ggx_alpha_override;
  if (from.alpha_mode == AlphaMode::mask) made.least_alpha = from.alpha_cutoff;
  if (from.alpha_mode == AlphaMode::blend) made.least_alpha = 0.5f;
  made.emits = from.emission.x > 0 || from.emission.y > 0 || from.emission.z > 0;
  made.double_sided = from.double_sided;
  return made;
}

MeshBounds bounds_of(const Scene& scene, const Mesh& mesh) {
  Bounds bounds;
  for (const Vec3& position : mesh.positions) bounds.grow(position);
  MeshBounds made{};
  copy(made.low, bounds.low), copy(made.high, bounds.high);
  made.triangles = static_cast<word_>(mesh.indices.size() / 3);
  made.has_holes = can_have_holes(scene, mesh);
  return made;
}

}  // namespace

Result<DeviceScene> DeviceScene::create(gpu::Device& device, const Scene& scene, const Hierarchy& hierarchy) {
  Result<Upload> upload = Upload::begin(device);
  if (!upload) return upload.error();
  DeviceScene made;
  FlatMeshes flat(scene);
  FlatTextures images(scene);
  std::vector<MaterialRecord> materials;
  for (const Material& material : scene.materials) materials.push_back(material_of(material));
  Status sent = upload->add(hierarchy.nodes, made.nodes_);
  if (sent) sent = upload->add(hierarchy.triangles, made.triangles_);
  if (sent) sent = upload->add(flat.vertices.words(), made.vertices_);
  if (sent) sent = upload->add(images.small.words(), made.tables_);
  if (sent)
    sent = upload->add(
        images.texels * kWord, [&](void* to) { images.fill_texels(to); }, made.texels_);
  if (sent) sent = upload->add(scene.environment.pixels, made.environment_);
  if (sent) sent = upload->add(materials, made.materials_);
  if (!sent) return sent.error();
  flat.move_to(made.vertices_.address());
  images.move_to(made.texels_.address(), made.tables_.address());
  sent = upload->add(flat.meshes, made.meshes_);
  if (sent) sent = upload->add(images.textures, made.textures_);
  std::vector<MeshBounds> bounds;
  for (const Mesh& mesh : scene.meshes) {
    bounds.push_back(bounds_of(scene, mesh));
    for (const Vec3& position : mesh.positions) made.bounds_.grow(position);
  }
  if (sent) sent = upload->add(bounds, made.mesh_bounds_);
  made.mesh_count_ = static_cast<std::uint32_t>(bounds.size());
  if (!sent) return sent.error();
  SceneRecord record{};
  record.nodes = made.nodes_.address(), record.triangles = made.triangles_.address();
  record.meshes = made.meshes_.address(), record.materials = made.materials_.address();
  record.textures = made.textures_.address(), record.linear_from_srgb = made.tables_.address();
  record.environment = made.environment_.address();
  record.root = hierarchy.root;
  if (!scene.environment.pixels.empty()) {
    record.environment_width = scene.environment.width, record.environment_height = scene.environment.height;
  }
  copy(record.environment_radiance, scene.environment.radiance);
  sent = upload->add(std::vector<SceneRecord>{record}, made.record_);
  if (sent) sent = upload->finish();
  if (!sent) return sent.error();
  return made;
}

std::uint64_t DeviceScene::bytes() const {
  std::uint64_t sum = 0;
  for (const gpu::Buffer* buffer : {&record_, &nodes_, &triangles_, &vertices_, &texels_, &tables_, &meshes_,
                                    &materials_, &textures_, &environment_, &mesh_bounds_}) {
    sum += buffer->bytes();
  }
  return sum;
}

}  // namespace luciole
