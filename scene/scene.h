// SPDX-License-Identifier: Apache-2.0
// What a scene is, once it is read: the door between files or recipes and the renderers. World space, metres,
// right-handed, +Y up; linear Rec. 709; photometric values of glTF are taken 1:1 as radiometric.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/affine.h"
#include "base/aligned_vector.h"
#include "base/vector.h"
#include "scene/texture_modes.h"

namespace luciole {

// An image with its mip pyramid, 8 bits per channel RGBA, as textures use it. level[0] is the full image, row 0 on top;
// each further level halves (rounding down, at least 1). Mip levels are averaged in linear light.
struct MipImage {
  struct Level {
    std::uint32_t width = 0, height = 0;
    std::uint32_t first_texel = 0;  // number of the level's first texel in rgba
  };
  std::vector<Level> levels;
  // All levels, the finest first, four bytes per texel: in one piece, so that a texel of any level is found by its
  // number, and on huge pages, as each row of a texture would be a page.
  AlignedVector<std::uint8_t> rgba;
  bool srgb = false;       // colour channels are sRGB-encoded; alpha is always linear
  bool has_alpha = false;  // some texel has alpha < 255

  const std::uint8_t* texels(const Level& level) const { return rgba.data() + std::size_t(level.first_texel) * 4; }
};

struct Texture {
  std::string name;
  std::shared_ptr<const MipImage> image;
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool magnify_linear = true, minify_linear = true;
  MipFilter mip_filter = MipFilter::linear;
};

// A material's use of a texture. texture < 0: none. uv' = (a b; c d) uv + offset, KHR_texture_transform resolved.
struct TextureSlot {
  std::int32_t texture = -1;
  std::uint32_t uv_set = 0;  // 0 or 1
  float a = 1, b = 0, c = 0, d = 1;
  Vec2 offset{0, 0};
  Vec2 transform(Vec2 uv) const { return {a * uv.x + b * uv.y + offset.x, c * uv.x + d * uv.y + offset.y}; }
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

// glTF 2.0 metallic-roughness, with KHR_materials_specular, _ior and _emissive_strength folded in.
struct Material {
  std::string name;
  Vec4 base_colour{1, 1, 1, 1};  // factor, linear
  TextureSlot base_colour_texture;
  float metallic = 1;
  float roughness = 1;                     // glTF's perceptual roughness; alpha = roughness^2, times the texture first
  TextureSlot metallic_roughness_texture;  // blue: metallic, green: roughness
  TextureSlot normal_texture;
  float normal_scale = 1;
  Vec3 emission{0, 0, 0};  // factor times strength: radiance leaving the front side [W/(m^2 sr)]
  TextureSlot emissive_texture;
  bool unlit = false;  // KHR_materials_unlit: `emission` is what is seen, nothing is reflected, and nothing else is lit
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  Vec3 dielectric_f0{0.04f, 0.04f, 0.04f};  // ((ior-1)/(ior+1))^2 * specularColor, at most 1, times specular
  float dielectric_f90 = 1;                 // KHR_materials_specular's factor
  // Shots may override what the file says; negative: not overridden.
  float ggx_alpha_override = -1;  // [TH17] alpha, replaces roughness^2 and its texture
  float metallic_override = -1;
};

// Triangles of one material: one glTF primitive of one node, moved to world space.
struct Mesh {
  std::string name;
  std::uint32_t material = 0;
  std::vector<Vec3> positions;          // [m]
  std::vector<Vec3> normals;            // unit; one per position, or none: flat
  std::vector<Vec4> tangents;           // xyz unit, w = handedness +-1; one per position, or none
  std::array<std::vector<Vec2>, 2> uv;  // one per position, or none
  std::vector<Vec4> colours;            // linear, multiplies base colour; one per position, or none
  std::vector<std::uint32_t> indices;   // three per triangle, counter-clockwise seen from the front
};

// KHR_lights_punctual. Light leaves along `direction`.
struct PunctualLight {
  enum class Kind : std::uint8_t { point, spot, directional };
  Kind kind = Kind::point;
  std::string name;
  Vec3 position{0, 0, 0};         // [m]; not for directional
  Vec3 direction{0, 0, -1};       // unit; spot and directional
  Vec3 intensity{1, 1, 1};        // point, spot: radiant intensity on the axis [W/sr]; directional: irradiance [W/m^2]
  float cos_inner = 1.0f;         // spot: full intensity inside this cone
  float cos_outer = 0.70710678f;  // spot: nothing outside; between them glTF's squared ramp
};

struct Camera {
  std::string name;
  Vec3 eye{0, 0, 0};                                    // [m]
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  // orthonormal; `view` looks along -Z = forward
  float vertical_fov = 0.9f;                            // [rad]; perspective
};

// Radiance from infinitely far away: constant, or an equirectangular image (row 0 on top is +Y, centre column is -Z).
struct Environment {
  Vec3 radiance{0, 0, 0};  // [W/(m^2 sr)], multiplies the image if there is one
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> pixels;  // width * height
};

struct Bounds {
  Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
  void grow(Vec3 p) { low = min(low, p), high = max(high, p); }
  Vec3 centre() const { return (low + high) * 0.5f; }
  float diagonal() const { return length(high - low); }
};

struct Animation;  // scene/animation.h

struct Scene {
  std::string name;
  std::vector<Mesh> meshes;
  std::vector<Material> materials;  // at least one
  std::vector<Texture> textures;
  std::vector<PunctualLight> lights;
  std::vector<Camera> cameras;
  Environment environment;
  std::shared_ptr<const Animation> animation;  // what moves, and how; none: nothing
  std::vector<std::string> warnings;           // one sentence each, once each

  std::uint64_t triangle_count() const;
  Bounds bounds() const;
};

// Right, up and forward of a camera at `eye` that looks at `target` with +Y up.
Camera look_at(Vec3 eye, Vec3 target, float vertical_fov);

}  // namespace luciole
