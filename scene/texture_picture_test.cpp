// SPDX-License-Identifier: Apache-2.0
// Small pictures from data made here: what samplers, colour spaces, mip levels, alpha, normal maps and texture
// transforms do to a hit. Each test also shows that the likely mistake would be seen.
#include <gtest/gtest.h>

#include <cmath>

#include "equations/cpp/float.h"
#include "scene/emissive_triangles.h"
#include "scene/gltf_test_files.h"
#include "scene/srgb.h"
#include "scene/surface.h"
#include "scene/texture_sampling.h"

namespace luciole::test {
namespace {

const Vec3 kForward(0, 0, -1);

// The point (x, y) of the square, (0, 0) being the image's top left corner.
SurfaceHit hit_at(float x, float y) {
  const float px = x, py = 1 - y;
  // Triangle 0 has the corners (0,0) (1,0) (1,1), triangle 1 (0,0) (1,1) (0,1).
  return py <= px ? SurfaceHit{0, 0, px - py, py} : SurfaceHit{0, 1, px, py - px};
}

// The square with a texture as its base colour.
Json textured_square(std::uint32_t width, std::uint32_t height, const Bytes& rgba,
                     const Json& sampler = Json::object()) {
  Json file = square_file();
  const std::size_t texture = add_texture(file, png_file(width, height, rgba), sampler);
  file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
  return file;
}

Scene loaded(const Json& file) {
  Result<Scene> scene = load(file);
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(*scene);
}

float red_at(const Scene& scene, float x, float y, float cone = 0) {
  return evaluate_surface(scene, hit_at(x, y), kForward, cone).base_colour.x;
}

// Two texels, black and white, side by side.
const Bytes kBlackWhite = {0, 0, 0, 255, 255, 255, 255, 255};
const Json kNearestFilter = {{"magFilter", 9728}, {"minFilter", 9728}};

TEST(TexturePicture, rows_run_down_and_columns_to_the_right) {
  const Bytes rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};  // red green / blue white
  const Scene scene = loaded(textured_square(2, 2, rgba, kNearestFilter));
  const auto colour = [&](float x, float y) { return evaluate_surface(scene, hit_at(x, y), kForward, 0).base_colour; };
  EXPECT_EQ(colour(0.25f, 0.25f).x, 1);
  EXPECT_EQ(colour(0.25f, 0.25f).y, 0);
  EXPECT_EQ(colour(0.75f, 0.25f).y, 1);
  EXPECT_EQ(colour(0.75f, 0.25f).x, 0);
  EXPECT_EQ(colour(0.25f, 0.75f).z, 1);
  EXPECT_EQ(colour(0.25f, 0.75f).x, 0);
}

TEST(TexturePicture, filters_are_what_the_sampler_says) {
  const Scene nearest = loaded(textured_square(2, 1, kBlackWhite, kNearestFilter));
  const Scene linear = loaded(textured_square(2, 1, kBlackWhite, {{"magFilter", 9729}, {"wrapS", 33071}}));
  EXPECT_EQ(red_at(nearest, 0.45f, 0.5f), 0.0f);
  EXPECT_EQ(red_at(nearest, 0.55f, 0.5f), 1.0f);
  EXPECT_NEAR(red_at(linear, 0.5f, 0.5f), 0.5f, 1e-6f);
  EXPECT_NEAR(red_at(linear, 0.6f, 0.5f), 0.7f, 1e-5f);
  EXPECT_EQ(red_at(linear, 0.1f, 0.5f), 0.0f);
}

TEST(TexturePicture, wrap_modes_differ_beyond_the_border) {
  Texture texture;
  MipImage image;
  image.levels.push_back({2, 1, 0});
  image.rgba.assign(kBlackWhite.begin(), kBlackWhite.end());
  texture.image = std::make_shared<MipImage>(image);
  texture.magnify_linear = false;
  // u in halves of the image: -0.75 -0.25 | 0.25 0.75 | 1.25 1.75 2.25
  const float u[] = {-0.75f, -0.25f, 0.25f, 0.75f, 1.25f, 1.75f, 2.25f};
  const float expected[3][7] = {{0, 1, 0, 1, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0}, {0, 0, 0, 1, 1, 1, 1}};
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    texture.wrap_u = wrap;
    for (int i = 0; i < 7; ++i) {
      EXPECT_EQ(sample_texture(texture, {u[i], 0.5f}, 0).x, expected[static_cast<int>(wrap)][i]) << i;
    }
  }
}

TEST(TexturePicture, linear_filters_wrap_over_the_border) {
  Json repeat = {{"magFilter", 9729}, {"wrapS", 10497}}, clamp = {{"magFilter", 9729}, {"wrapS", 33071}};
  EXPECT_NEAR(red_at(loaded(textured_square(2, 1, kBlackWhite, repeat)), 0.0f, 0.5f), 0.5f, 1e-6f);
  EXPECT_NEAR(red_at(loaded(textured_square(2, 1, kBlackWhite, clamp)), 0.0f, 0.5f), 0.0f, 1e-6f);
}

TEST(TexturePicture, survives_any_coordinate) {
  Texture texture;
  MipImage image;
  image.levels.push_back({2, 1, 0});
  image.rgba.assign(kBlackWhite.begin(), kBlackWhite.end());
  texture.image = std::make_shared<MipImage>(image);
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    texture.wrap_u = texture.wrap_v = wrap;
    for (const float u : {-1e-9f, 1.0f, 2.0f, 1e30f, -1e30f, INFINITY, -INFINITY, NAN, 0.99999994f, 1.9999999f}) {
      for (const bool linear : {false, true}) {
        texture.magnify_linear = linear;
        const float value = sample_texture(texture, {u, u}, 0).x;
        EXPECT_TRUE(value >= 0 && value <= 1) << u;
      }
    }
  }
}

TEST(TexturePicture, base_colour_is_srgb_and_metallic_roughness_is_not) {
  const Bytes grey = {128, 128, 128, 255};
  Json file = textured_square(1, 1, grey);
  file["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
  const SurfacePoint point = evaluate_surface(loaded(file), hit_at(0.5f, 0.5f), kForward, 0);
  const float number = 128.0f / 255.0f;
  EXPECT_NEAR(point.base_colour.x, 0.2158605f, 1e-6f);       // IEC 61966-2-1 of 128
  EXPECT_GT(std::abs(number - point.base_colour.x), 0.25f);  // read as a number it would be far off
  EXPECT_NEAR(point.ggx_alpha, number * number, 1e-6f);      // green is roughness, alpha its square
}

TEST(TexturePicture, every_srgb_code_survives_decoding_and_encoding) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(srgb8_from_linear(kLinearFromSrgb8[static_cast<std::size_t>(code)]), code);
  }
}

TEST(TexturePicture, mip_levels_average_light_not_codes) {
  const Scene scene = loaded(textured_square(2, 1, kBlackWhite, {{"minFilter", 9987}}));
  const MipImage& image = *scene.textures[0].image;
  ASSERT_EQ(image.levels.size(), 2u);
  EXPECT_EQ(image.texels(image.levels[1])[0], 188);  // half of the light
  EXPECT_NE(image.texels(image.levels[1])[0], 128);  // half of the codes would be a fifth of it
  // The square is 1 m wide and the image 2 x 1 texels: a cone of two metres sees the coarsest level, a thin one the
  // finest.
  EXPECT_NEAR(red_at(scene, 0.25f, 0.5f, 2.0f), 0.5f, 0.005f);
  EXPECT_EQ(red_at(scene, 0.25f, 0.5f, 1e-3f), 0.0f);
}

TEST(TexturePicture, odd_sides_keep_their_mean) {
  Bytes rgba;
  for (int i = 0; i < 7 * 5; ++i) rgba.insert(rgba.end(), {static_cast<std::uint8_t>(i * 7), 0, 0, 255});
  Json file = textured_square(7, 5, rgba);
  file["materials"][0]["normalTexture"] = {{"index", 0}};  // once more, as numbers
  const Scene scene = loaded(file);
  for (const Texture& texture : scene.textures) {
    if (texture.image->srgb) continue;
    const MipImage& image = *texture.image;
    ASSERT_EQ(image.levels.size(), 3u);  // 7x5, 3x2, 1x1
    EXPECT_NEAR(image.texels(image.levels[2])[0], 17 * 7, 1);
  }
}

TEST(TexturePicture, level_of_detail_follows_cone_distance_and_angle) {
  // 256 texels per metre: a cone of 1/64 m covers 4 of them, two octaves.
  EXPECT_NEAR(f32::texture_level_of_detail(1, 256 * 256, 1.0f / 64, 1), 2.0f, 1e-5f);
  EXPECT_NEAR(f32::texture_level_of_detail(1, 256 * 256, 1.0f / 64, 0.5f), 3.0f, 1e-5f);
  EXPECT_NEAR(f32::texture_level_of_detail(4, 256 * 256, 1.0f / 64, 1), 3.0f, 1e-5f);  // tiled twice each way
  EXPECT_LT(f32::texture_level_of_detail(1, 256 * 256, 0, 1), 0.0f);
}

TEST(TexturePicture, alpha_masks_cut_holes_and_opaque_materials_do_not) {
  const Bytes rgba = {255, 255, 255, 100, 255, 255, 255, 200};
  Json file = textured_square(2, 1, rgba, kNearestFilter);
  const auto passes = [&](const char* mode, float cutoff, float x) {
    file["materials"][0]["alphaMode"] = mode;
    file["materials"][0]["alphaCutoff"] = cutoff;
    return alpha_passes(loaded(file), hit_at(x, 0.5f));
  };
  EXPECT_FALSE(passes("MASK", 0.5f, 0.25f));
  EXPECT_TRUE(passes("MASK", 0.5f, 0.75f));
  EXPECT_TRUE(passes("MASK", 0.3f, 0.25f));
  EXPECT_FALSE(passes("MASK", 0.9f, 0.75f));
  EXPECT_TRUE(passes("OPAQUE", 0.5f, 0.25f));
  EXPECT_FALSE(passes("BLEND", 0.1f, 0.25f));  // 0.5, whatever the cutoff
  EXPECT_TRUE(passes("BLEND", 0.9f, 0.75f));
  file["materials"][0]["alphaMode"] = "OPAQUE";
  EXPECT_FALSE(can_have_holes(loaded(file), loaded(file).meshes[0]));
}

// A normal map of one colour: the direction (x, y, z) in tangent space.
Json bent_square(Vec3 direction) {
  Json file = square_file();
  const auto code = [](float v) { return static_cast<std::uint8_t>(std::lround((v * 0.5f + 0.5f) * 255)); };
  const Bytes texel = {code(direction.x), code(direction.y), code(direction.z), 255};
  file["materials"][0]["normalTexture"] = {{"index", add_texture(file, png_file(1, 1, texel))}};
  return file;
}

TEST(TexturePicture, normal_maps_bend_to_the_right_and_up_in_the_image) {
  const Vec3 right =
      evaluate_surface(loaded(bent_square({0.6f, 0, 0.8f})), hit_at(0.5f, 0.5f), kForward, 0).shading_normal;
  EXPECT_NEAR(right.x, 0.6f, 0.01f);
  EXPECT_NEAR(right.y, 0, 0.01f);
  EXPECT_NEAR(right.z, 0.8f, 0.01f);
  const Vec3 up =
      evaluate_surface(loaded(bent_square({0, 0.6f, 0.8f})), hit_at(0.5f, 0.5f), kForward, 0).shading_normal;
  EXPECT_NEAR(up.y, 0.6f, 0.01f);  // green is up: with the other convention this is -0.6
  EXPECT_NEAR(up.z, 0.8f, 0.01f);
}

TEST(TexturePicture, normal_maps_follow_mirrored_and_turned_objects) {
  Json mirrored = bent_square({0.6f, 0, 0.8f});
  mirrored["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = loaded(mirrored);
  const SurfacePoint point = evaluate_surface(scene, {0, 0, 0.3f, 0.3f}, kForward, 0);
  EXPECT_TRUE(point.front);  // the winding was mended
  EXPECT_NEAR(point.shading_normal.x, -0.6f, 0.01f);
  EXPECT_NEAR(point.shading_normal.z, 0.8f, 0.01f);
}

TEST(TexturePicture, flat_meshes_take_normal_maps_too) {
  Json file = bent_square({0.6f, 0, 0.8f});
  file["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
  const Scene scene = loaded(file);
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  EXPECT_NEAR(evaluate_surface(scene, {0, 0, 0.3f, 0.3f}, kForward, 0).shading_normal.x, 0.6f, 0.01f);
}

TEST(TexturePicture, shading_normals_face_the_viewer) {
  const Scene scene = loaded(bent_square({0.96f, 0, 0.28f}));
  // Seen from the left, from behind, and almost along the surface.
  for (const Vec3 ray : {normalize(Vec3(1, 0, -0.2f)), normalize(Vec3(0.3f, 0.2f, 1)), normalize(Vec3(1, 0, -0.01f))}) {
    const SurfacePoint point = evaluate_surface(scene, hit_at(0.5f, 0.4f), ray, 0);
    EXPECT_GT(dot(point.geometric_normal, ray * -1.0f), 0);
    EXPECT_GT(dot(point.shading_normal, ray * -1.0f), 0);
    EXPECT_GT(dot(point.shading_normal, point.geometric_normal), 0);
    EXPECT_NEAR(length(point.shading_normal), 1, 1e-5f);
  }
}

TEST(TexturePicture, texture_transform_shifts_scales_and_turns_counter_clockwise) {
  const Bytes rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
  Json file = textured_square(2, 2, rgba, kNearestFilter);
  Json& use = file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  use["extensions"]["KHR_texture_transform"] = {{"offset", {0.25, 0.5}}, {"rotation", 0.5}, {"scale", {2, 3}}};
  const Scene scene = loaded(file);
  const Vec2 uv = scene.materials[0].base_colour_texture.transform({0.1f, 0.2f});
  const float c = std::cos(0.5f), s = std::sin(0.5f);
  EXPECT_NEAR(uv.x, 0.25f + c * 0.2f + s * 0.6f, 1e-6f);
  EXPECT_NEAR(uv.y, 0.5f - s * 0.2f + c * 0.6f, 1e-6f);
  // A quarter turn shows at the top left what lies at the bottom left: blue. Clockwise it would be green.
  use["extensions"]["KHR_texture_transform"] = {{"rotation", 1.5707963}};
  const SurfacePoint point = evaluate_surface(loaded(file), hit_at(0.25f, 0.25f), kForward, 0);
  EXPECT_EQ(point.base_colour.z, 1);
  EXPECT_EQ(point.base_colour.x, 0);
}

TEST(TexturePicture, texture_transform_may_choose_another_coordinate_set) {
  Json file = textured_square(2, 1, kBlackWhite, kNearestFilter);
  Json& use = file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  use["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}};
  EXPECT_EQ(loaded(file).materials[0].base_colour_texture.uv_set, 1u);
  use["extensions"]["KHR_texture_transform"] = {{"offset", {0, 0}}};
  EXPECT_EQ(loaded(file).materials[0].base_colour_texture.uv_set, 0u);
}

TEST(TexturePicture, light_leaves_single_sided_surfaces_on_the_front_only) {
  Json file = square_file();
  file["materials"][0]["emissiveFactor"] = {1, 0.5, 0};
  file["materials"][0]["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 4}};
  const auto emission = [&](Vec3 ray) { return evaluate_surface(loaded(file), hit_at(0.5f, 0.4f), ray, 0).emission; };
  EXPECT_EQ(emission(kForward).x, 4);
  EXPECT_EQ(emission(kForward).y, 2);
  EXPECT_EQ(emission({0, 0, 1}).x, 0);
  file["materials"][0]["doubleSided"] = true;
  EXPECT_EQ(emission({0, 0, 1}).x, 4);
}

TEST(TexturePicture, unlit_materials_show_their_base_colour_and_neither_reflect_nor_shine) {
  Json file = textured_square(1, 1, {255, 0, 255, 255});
  file["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 0.25, 1};
  const auto at_middle = [](const Scene& scene) { return evaluate_surface(scene, hit_at(0.5f, 0.4f), kForward, 0); };
  EXPECT_EQ(at_middle(loaded(file)).emission.x, 0);
  file["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
  file["extensionsUsed"] = {"KHR_materials_unlit"};
  const Scene scene = loaded(file);
  const SurfacePoint point = at_middle(scene);
  EXPECT_EQ(point.emission.x, 0.5f);
  EXPECT_EQ(point.emission.y, 0);
  EXPECT_EQ(point.emission.z, 0.25f);
  for (const Vec3 reflected : {point.diffuse_albedo, point.f0, Vec3(point.f90, 0, 0)}) {
    EXPECT_EQ(reflected.x + reflected.y + reflected.z, 0);
  }
  EXPECT_TRUE(emissive_triangles(scene).empty());
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(TexturePicture, overrides_of_a_shot_replace_texture_and_factor) {
  Json file = textured_square(1, 1, {255, 128, 255, 255});
  file["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
  Scene scene = loaded(file);
  scene.materials[0].ggx_alpha_override = 0.1f;
  scene.materials[0].metallic_override = 1;
  SurfacePoint point = evaluate_surface(scene, hit_at(0.5f, 0.5f), kForward, 0);
  EXPECT_FLOAT_EQ(point.ggx_alpha, 0.1f);
  EXPECT_FLOAT_EQ(point.metallic, 1);
  scene.materials[0].ggx_alpha_override = 0;
  EXPECT_FLOAT_EQ(evaluate_surface(scene, hit_at(0.5f, 0.5f), kForward, 0).ggx_alpha, kLeastGgxAlpha);
}

}  // namespace
}  // namespace luciole::test
