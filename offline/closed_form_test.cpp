// SPDX-License-Identifier: Apache-2.0
// The path tracer against closed forms, within measured standard errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "offline/path/camera_rays.h"
#include "offline/small_pictures.h"

namespace luciole::test {
namespace {

// A box seen from inside, two triangles per wall.
Mesh box_inside(float half) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-half, half}) {
      const auto corner = [&](float u, float v) {
        return axis == 0 ? Vec3(side, u, v) : axis == 1 ? Vec3(u, side, v) : Vec3(u, v, side);
      };
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const Vec3& p : {corner(-half, -half), corner(half, -half), corner(half, half), corner(-half, half)}) {
        mesh.positions.push_back(p);
      }
      for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + k);
    }
  }
  return mesh;
}

double mean_of(const Film& film, const char* channel) {
  const Image image = film.image();
  double sum = 0;
  for (const float value : image.channels.at(channel)) sum += value;
  return sum / static_cast<double>(image.pixel_count());
}

// A picture's mean, from independent runs.
struct Measured {
  double mean = 0, standard_error = 0;
  // Within five standard errors, or what rounding makes of a sum.
  bool agrees_with(double expected) const {
    return std::abs(mean - expected) < 5 * standard_error + 1e-6 * std::abs(expected);
  }
};

Measured measure(const std::shared_ptr<const Scene>& scene, const Camera& camera, PathSettings settings,
                 std::uint32_t samples, const char* channel = "R") {
  constexpr int kMeasuredRuns = 16;
  double sum = 0, squares = 0;
  for (int run = 0; run < kMeasuredRuns; ++run) {
    settings.seed = 200 + static_cast<std::uint64_t>(run);
    const double mean = mean_of(render(scene, camera, settings, samples), channel);
    sum += mean, squares += mean * mean;
  }
  const double mean = sum / kMeasuredRuns;
  return {mean, std::sqrt(std::max(squares / kMeasuredRuns - mean * mean, 0.0) / (kMeasuredRuns - 1))};
}

// The closed form, and not one that is off by a hundredth.
void expect_mean(const Measured& found, double expected, const std::string& what) {
  EXPECT_TRUE(found.agrees_with(expected))
      << what << ": " << found.mean << " +- " << found.standard_error << ", not " << expected;
  EXPECT_FALSE(found.agrees_with(1.01 * expected)) << what << ": tells nothing, +- " << found.standard_error;
}

// In a room whose walls all shine alike with radiance 1 and reflect half, n scatterings give 1 + 1/2 + ... + 2^-n.
TEST(PathTracer, gives_the_closed_form_of_a_room_of_shining_walls) {
  Scene scene;
  Material wall;
  wall.base_colour = {0.5f, 0.5f, 0.5f, 1}, wall.metallic = 0, wall.roughness = 1;
  wall.dielectric_f0 = {0, 0, 0}, wall.dielectric_f90 = 0;
  wall.emission = {1, 1, 1}, wall.double_sided = true;
  scene.materials.push_back(wall);
  scene.meshes.push_back(box_inside(1));
  const auto shared = std::make_shared<const Scene>(scene);
  const Camera camera = look_at({0.2f, 0.1f, 0.3f}, {1, 0.5f, -0.4f}, 1);
  for (const LightChoice lights : {LightChoice::culling, LightChoice::tree, LightChoice::uniform}) {
    for (const std::uint32_t bounces : {1u, 3u}) {
      const double expected = 2 - std::pow(0.5, bounces);
      expect_mean(measure(shared, camera, small(bounces, lights), 16), expected,
                  name_of(lights) + " " + std::to_string(bounces));
    }
  }
}

Scene white_floor() {
  Scene scene;
  Material white;
  white.base_colour = {1, 1, 1, 1}, white.metallic = 0, white.roughness = 1;
  white.dielectric_f0 = {0, 0, 0}, white.dielectric_f90 = 0;
  scene.materials.push_back(white);
  Mesh floor;
  floor.positions = {{-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}};
  floor.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back(floor);
  return scene;
}

// A white floor under a constant sky, and under a sky that is an image of the same radiance: both send back the sky.
TEST(PathTracer, finds_a_constant_sky_and_its_image_alike) {
  for (const bool as_image : {false, true}) {
    Scene scene = white_floor();
    scene.environment.radiance = {2, 2, 2};
    if (as_image) {
      scene.environment.width = 8, scene.environment.height = 4;
      scene.environment.pixels.assign(32, Vec3(1, 1, 1));
    }
    const auto shared = std::make_shared<const Scene>(scene);
    const Camera camera = look_at({0, 2, 0}, {0.5f, 0, 0.5f}, 0.8f);
    expect_mean(measure(shared, camera, small(1), 64), 2, as_image ? "image" : "constant");
  }
}

// A sun of irradiance pi over a white floor leaves with radiance cos.
TEST(PathTracer, finds_a_sun) {
  Scene scene = white_floor();
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::directional, sun.direction = normalize(Vec3(0.6f, -0.8f, 0));
  sun.intensity = {3.14159265f, 3.14159265f, 3.14159265f};
  scene.lights.push_back(sun);
  const Camera camera = look_at({0, 2, 0}, {0.5f, 0, 0.5f}, 0.8f);
  expect_mean(measure(std::make_shared<const Scene>(scene), camera, small(2), 1), 0.8, "sun");
}

// Two blended panes of alpha 1/4 and 1/2 before a sky of radiance 1, black themselves: 3/4 of 1/2 passes; and of a
// lamp's light as much.
TEST(PathTracer, looks_and_shines_through_blended_surfaces) {
  Scene scene;
  for (const float alpha : {0.25f, 0.5f}) {
    Material pane;
    pane.base_colour = {0, 0, 0, alpha}, pane.alpha_mode = AlphaMode::blend, pane.double_sided = true;
    pane.metallic = 0, pane.dielectric_f0 = {0, 0, 0}, pane.dielectric_f90 = 0;
    Mesh mesh;
    mesh.material = static_cast<std::uint32_t>(scene.materials.size());
    const float depth = -1 - alpha;
    mesh.positions = {{-9, -9, depth}, {9, -9, depth}, {9, 9, depth}, {-9, 9, depth}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.materials.push_back(pane);
    scene.meshes.push_back(mesh);
  }
  const Camera camera = look_at({0, 0, 0}, {0, 0, -1}, 0.5f);
  Scene sky = scene;
  sky.environment.radiance = {1, 1, 1};
  expect_mean(measure(std::make_shared<const Scene>(sky), camera, small(1), 64), 0.375, "sky");
  Material wall;
  wall.base_colour = {1, 1, 1, 1}, wall.metallic = 0, wall.dielectric_f0 = {0, 0, 0}, wall.dielectric_f90 = 0;
  wall.double_sided = true;
  Mesh mesh;
  mesh.material = 2;
  mesh.positions = {{-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.materials.push_back(wall);
  scene.meshes.push_back(mesh);
  PunctualLight lamp;
  lamp.position = {0, 0, -100}, lamp.intensity = {10201 * 3.14159265f, 10201 * 3.14159265f, 10201 * 3.14159265f};
  scene.lights.push_back(lamp);
  const Camera back = look_at({0, 0, 0.5f}, {0, 0, 1}, 0.1f);
  expect_mean(measure(std::make_shared<const Scene>(scene), back, small(1), 128), 0.375, "lamp");
}

// What all pixels together see of a triangle on the film: their filters integrated over it. Of box and tent that is its
// area; the sum of gaussians around the pixels has ripples.
double seen_by_all(PixelFilter filter, Vec2 a, Vec2 b, Vec2 c) {
  constexpr int kCells = 300;
  double sum = 0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const float s = (static_cast<float>(i) + 0.5f) / kCells, v = (static_cast<float>(j) + 0.5f) / kCells;
      const Vec2 p = a + (b - a) * (s * (1 - v)) + (c - a) * (s * v);
      for (int y = 4; y < 14; ++y) {
        for (int x = 11; x < 21; ++x) {
          const auto column = static_cast<float>(x), row = static_cast<float>(y);
          sum += s * filter_density(filter, {p.x - column - 0.5f, p.y - row - 0.5f});
        }
      }
    }
  }
  return sum * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / (kCells * kCells);
}

// A triangle of radiance 1 that lies within the film is seen as large as it is, however the camera's rays and the
// projected points share it.
TEST(PathTracer, sees_emitters_as_large_as_they_are) {
  Scene scene;
  Material glow;
  glow.base_colour = {0, 0, 0, 1}, glow.emission = {1, 1, 1}, glow.double_sided = true;
  glow.dielectric_f0 = {0, 0, 0}, glow.dielectric_f90 = 0;
  scene.materials.push_back(glow);
  Mesh mesh;
  mesh.positions = {{-0.1f, -0.08f, -4}, {0.13f, -0.05f, -4}, {0.02f, 0.12f, -4}};
  mesh.indices = {0, 1, 2};
  scene.meshes.push_back(mesh);
  const auto shared = std::make_shared<const Scene>(scene);
  const Camera camera = look_at({0, 0, 0}, {0, 0, -1}, 1);
  const float pixel = 2 * std::tan(0.5f) / 18 * 4;
  const auto on_film = [&](std::size_t k) {
    return Vec2(16 + mesh.positions[k].x / pixel, 9 - mesh.positions[k].y / pixel);
  };
  for (const PixelFilter filter : {PixelFilter::box, PixelFilter::tent, PixelFilter::gaussian}) {
    const double expected = seen_by_all(filter, on_film(0), on_film(1), on_film(2));
    for (const float aperture : {0.0f, 0.05f}) {
      PathSettings settings = small(1);
      settings.pixel_filter = filter, settings.aperture = aperture, settings.focus = 4;
      Measured seen = measure(shared, camera, settings, 128);
      seen.mean *= 32 * 18, seen.standard_error *= 32 * 18;
      expect_mean(seen, expected, name_of(filter) + " " + std::to_string(aperture));
    }
  }
}

// A red lamp, and a blue one behind a wall: one is chosen per sample, and each channel is set right by the other lamp's
// share. No blue arrives, on average: not were the correction left out where the shadow ray is blocked.
TEST(PathTracer, sets_colours_right_without_bias) {
  Scene scene = white_floor();
  Mesh wall;
  wall.positions = {{2.5f, 0, -50}, {2.5f, 0, 50}, {2.5f, 50, 50}, {2.5f, 50, -50}};
  wall.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back(wall);
  PunctualLight lamp;
  lamp.position = {0, 2, 0}, lamp.intensity = {9, 0, 0};
  scene.lights.push_back(lamp);
  lamp.position = {3.5f, 2, 0}, lamp.intensity = {0, 0, 60};
  scene.lights.push_back(lamp);
  const auto shared = std::make_shared<const Scene>(scene);
  const Camera camera = look_at({0, 1.5f, 0}, {0.5f, 0, 0.5f}, 0.8f);
  const Measured red = measure(shared, camera, small(1), 16), blue = measure(shared, camera, small(1), 16, "B");
  EXPECT_LT(std::abs(blue.mean), 5 * blue.standard_error);
  EXPECT_TRUE(red.agrees_with(measure(shared, camera, small(1, LightChoice::uniform), 256).mean));
  // It is at work: single samples take blue away, and what they would take alone, without giving, is seen at once.
  const Image one = render(shared, camera, small(1), 1).image();
  double taken = 0;
  for (const float value : one.channels.at("B")) taken += std::min(value, 0.0f);
  EXPECT_GT(-taken / static_cast<double>(one.pixel_count()), 20 * blue.standard_error);
}

}  // namespace
}  // namespace luciole::test
