// SPDX-License-Identifier: Apache-2.0
#include "scene/digest.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "base/digest.h"

namespace luciole {
namespace {

Scene sample_scene() {
  Scene scene;
  scene.meshes.resize(2);
  for (Mesh& mesh : scene.meshes) {
    mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    mesh.indices = {0, 1, 2};
  }
  scene.materials.resize(2);
  scene.lights.resize(2);
  const auto image = std::make_shared<MipImage>();
  image->levels.resize(1);
  image->levels[0].width = 2, image->levels[0].height = 1;
  image->rgba.assign(8, 100);
  scene.textures = {{"a", image}, {"b", image}};
  scene.environment = {Vec3(1, 1, 1), 2, 1, {Vec3(1, 1, 1), Vec3(2, 2, 2)}};
  return scene;
}

TEST(SceneDigest, changes_with_whatever_a_picture_depends_on) {
  const std::function<void(Scene&)> changes[] = {
      [](Scene&) {},
      [](Scene& s) { s.meshes[1].positions[2].y = 1.0000001f; },
      [](Scene& s) { s.meshes[1].normals.assign(3, Vec3(0, 0, 1)); },
      [](Scene& s) { s.meshes[1].tangents.assign(3, Vec4(1, 0, 0, 1)); },
      [](Scene& s) { s.meshes[1].uv[0].assign(3, Vec2(0, 0)); },
      [](Scene& s) { s.meshes[1].uv[1].assign(3, Vec2(0, 0)); },
      [](Scene& s) { s.meshes[1].colours.assign(3, Vec4(0, 0, 0, 0)); },
      [](Scene& s) {
        s.meshes[1].indices = {0, 2, 1};
      },
      [](Scene& s) { s.meshes[1].material = 1; },
      [](Scene& s) { s.meshes.pop_back(); },
      [](Scene& s) { s.materials[1].roughness = 0.5f; },
      [](Scene& s) { s.materials[1].emission.z = 3; },
      [](Scene& s) { s.materials[1].ggx_alpha_override = 0.1f; },
      [](Scene& s) { s.materials[1].metallic_override = 0.1f; },
      [](Scene& s) { s.materials[1].double_sided = true; },
      [](Scene& s) { s.materials[1].unlit = true; },
      [](Scene& s) { s.materials[1].alpha_mode = AlphaMode::mask; },
      [](Scene& s) { s.materials[1].normal_texture.texture = 0; },
      [](Scene& s) { s.materials[1].emissive_texture.texture = 0; },
      [](Scene& s) { s.materials[1].emissive_texture.offset.y = 2; },
      [](Scene& s) { s.lights[1].intensity.x = 2; },
      [](Scene& s) { s.lights[1].kind = PunctualLight::Kind::spot; },
      [](Scene& s) { s.lights.emplace_back(); },
      [](Scene& s) { s.textures[1].wrap_u = Wrap::clamp_to_edge; },
      [](Scene& s) { s.textures[1].mip_filter = MipFilter::none; },
      [](Scene& s) { s.textures[1].image = nullptr; },
      [](Scene& s) {
        const auto other = std::make_shared<MipImage>(*s.textures[0].image);
        other->rgba[5] = 101;
        s.textures[1].image = other;
      },
      [](Scene& s) { s.environment.radiance.y = 2; },
      [](Scene& s) { s.environment.pixels[1].x = 1; },
      [](Scene& s) { s.environment.width = 1, s.environment.height = 2; },
  };
  std::set<std::string> digests;
  for (const auto& change : changes) {
    Scene scene = sample_scene();
    change(scene);
    EXPECT_TRUE(digests.insert(scene_digest(scene)).second) << digests.size();
  }
}

TEST(SceneDigest, does_not_change_with_names_addresses_and_the_list_of_cameras) {
  Scene scene = sample_scene(), other = sample_scene();  // two images of equal bytes
  other.name = other.meshes[0].name = other.materials[0].name = other.lights[0].name = "another";
  other.cameras.emplace_back();
  other.warnings = {"It rains."};
  EXPECT_EQ(scene_digest(scene), scene_digest(other));
  EXPECT_EQ(scene_digest(scene).size(), 16u);
}

TEST(Digest, every_changed_bit_of_a_buffer_shows) {
  std::string bytes(37, '\0');
  const auto digest = [&] {
    Digest made;
    made.add(bytes);
    return made.value();
  };
  std::set<std::uint64_t> seen = {digest()};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      bytes[i] = static_cast<char>(1 << bit);
      EXPECT_TRUE(seen.insert(digest()).second);
      bytes[i] = 0;
    }
  }
  bytes.push_back('\0');  // a longer buffer of zeros is another one
  EXPECT_TRUE(seen.insert(digest()).second);
}

}  // namespace
}  // namespace luciole
