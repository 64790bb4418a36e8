// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "scene/box_scene.h"
#include "scene/default_lights.h"
#include "scene/describe.h"
#include "scene/emissive_triangles.h"
#include "scene/gltf_test_files.h"

namespace luciole::test {
namespace {

Json light_file(const Json& light, const Json& node = Json::object()) {
  Json file = square_file();
  file["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
  file["nodes"].push_back(node);
  file["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file["scenes"][0]["nodes"] = {0, 1};
  return file;
}

TEST(PunctualLights, are_placed_by_their_node_and_not_scaled) {
  const Result<Scene> scene = load(
      light_file({{"type", "spot"},
                  {"color", {1, 0.5, 0}},
                  {"intensity", 10},
                  {"range", 3},
                  {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}},
                 {{"translation", {1, 2, 3}}, {"rotation", {-0.70710678, 0, 0, 0.70710678}}, {"scale", {5, 5, 5}}}));
  ASSERT_TRUE(scene) << scene.error().message;
  const PunctualLight& light = scene->lights.at(0);
  EXPECT_EQ(light.position.y, 2);
  EXPECT_NEAR(light.direction.y, -1, 1e-6f);  // -z turned down
  EXPECT_EQ(light.intensity.x, 10);
  EXPECT_EQ(light.intensity.y, 5);
  EXPECT_FLOAT_EQ(light.cos_inner, std::cos(0.2f));
  EXPECT_FLOAT_EQ(light.cos_outer, std::cos(0.4f));
  EXPECT_EQ(scene->warnings.size(), 1u);  // range
}

TEST(PunctualLights, need_a_cone_that_opens) {
  const Json closed = {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.4}, {"outerConeAngle", 0.4}}}};
  EXPECT_NE(fault_of(light_file(closed)).find("KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES"), std::string::npos);
}

// Emitted flux is the integral of the intensity over the sphere.
TEST(PunctualLights, have_the_power_that_they_send_out) {
  PunctualLight spot;
  spot.kind = PunctualLight::Kind::spot;
  spot.cos_inner = 0.9f, spot.cos_outer = 0.6f;
  double flux = 0;
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = 1 - (i + 0.5) * 2 / kSteps;
    const double ramp = std::clamp((cosine - 0.6) / (0.9 - 0.6), 0.0, 1.0);
    flux += ramp * ramp * 2 * 3.14159265358979 * 2 / kSteps;
  }
  EXPECT_NEAR(power(spot, 1), flux, 1e-4 * flux);
}

TEST(PunctualLights, the_strongest_four_are_primary_in_file_order) {
  Scene scene;
  for (const float intensity : {1.0f, 9.0f, 3.0f, 7.0f, 5.0f, 9.0f}) {
    PunctualLight light;
    light.intensity = {intensity, intensity, intensity};
    scene.lights.push_back(light);
  }
  EXPECT_EQ(strongest_lights(scene), (std::vector<std::size_t>{1, 3, 4, 5}));
  scene.lights.resize(2);
  EXPECT_EQ(strongest_lights(scene), (std::vector<std::size_t>{0, 1}));
}

TEST(EmissiveTriangles, carry_the_mean_of_their_texture) {
  Json file = square_file();
  file["materials"][0]["emissiveFactor"] = {1, 1, 1};
  EXPECT_EQ(emissive_triangles(*load(file)).size(), 2u);
  // Left half black, right half white, 16 x 16 texels: the lower right triangle sees three quarters of white.
  Bytes rgba;
  for (int i = 0; i < 256; ++i) {
    const std::uint8_t code = i % 16 < 8 ? 0 : 255;
    rgba.insert(rgba.end(), {code, code, code, 255});
  }
  file["materials"][0]["emissiveTexture"] = {{"index", add_texture(file, png_file(16, 16, rgba))}};
  const std::vector<EmissiveTriangle> triangles = emissive_triangles(*load(file));
  ASSERT_EQ(triangles.size(), 2u);
  EXPECT_FLOAT_EQ(triangles[0].area, 0.5f);
  EXPECT_NEAR(triangles[0].radiance.x, 0.75f, 0.02f);
  EXPECT_NEAR(triangles[1].radiance.x, 0.25f, 0.02f);
  EXPECT_NEAR(power(triangles[0]).x, 3.14159265f * 0.5f * 0.75f, 0.05f);
}

TEST(EmissiveTriangles, do_not_shine_through_their_holes) {
  Json file = square_file();
  file["materials"][0]["emissiveFactor"] = {1, 1, 1};
  file["materials"][0]["alphaMode"] = "MASK";
  file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", add_texture(file, png_file(1, 1, {255, 255, 255, 0}))}};
  EXPECT_TRUE(emissive_triangles(*load(file)).empty());
}

TEST(DefaultLights, come_only_where_nothing_shines) {
  Result<Scene> dark = load(square_file());
  EXPECT_FALSE(add_default_lights(*dark).empty());
  EXPECT_EQ(dark->lights.size(), 1u);
  EXPECT_TRUE(add_default_lights(*dark).empty());
  Json glowing = square_file();
  glowing["materials"][0]["emissiveFactor"] = {1, 1, 1};
  Result<Scene> lit = load(glowing);
  EXPECT_TRUE(add_default_lights(*lit).empty());
}

// A box of 6 m x 3 m x 4 m, area 108 m^2, and in it or on it a shining cube of 0.24 m^2.
Scene box_with_indicator(bool room, float radiance) {
  Scene scene;
  add_box(scene, {-3, 0, -2}, {3, 3, 2}, room);
  const float high = room ? 2.9f : 3.2f;
  add_box(scene, {-0.1f, high - 0.2f, -0.1f}, {0.1f, high, 0.1f}, false);
  scene.materials.emplace_back();
  scene.materials[1].emission = {radiance, radiance, radiance};
  scene.meshes[1].material = 1;
  return scene;
}

TEST(DefaultLights, come_where_the_scenes_own_light_does_not_show_it) {
  constexpr float kPi = 3.14159265f;
  const auto radiance_for = [](float irradiance, float area) { return irradiance * area / (kPi * 0.24f); };
  const float on_object = radiance_for(0.3f, 112), in_room = radiance_for(0.01f, 108);
  for (const auto& [room, limit] : {std::pair(false, on_object), std::pair(true, in_room)}) {
    Scene weak = box_with_indicator(room, 0.99f * limit), strong = box_with_indicator(room, 1.01f * limit);
    EXPECT_NE(add_default_lights(weak).find("own light"), std::string::npos) << room;
    EXPECT_EQ(weak.lights.size(), 1u);
    EXPECT_TRUE(add_default_lights(strong).empty()) << room;
  }
  // One rule for both would spoil one of them.
  Scene object = box_with_indicator(false, 2 * in_room);
  EXPECT_FALSE(add_default_lights(object).empty());
}

TEST(Describe, tells_what_is_there) {
  Json file = light_file({{"type", "point"}, {"name", "bulb"}});
  file["materials"][0]["emissiveFactor"] = {1, 1, 1};
  file["extensionsUsed"] = {"VENDOR_x"};
  const std::string text = describe(*load(file));
  for (const char* part :
       {"2 in 1 meshes", "\"bulb\", 12.566 W", "emissive triangles  2, 3.1416 W from 1 m^2", "VENDOR_x"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

}  // namespace
}  // namespace luciole::test
