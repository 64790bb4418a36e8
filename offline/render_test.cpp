// SPDX-License-Identifier: Apache-2.0
// The path tracer as a whole: against closed forms, against itself with other choices of lights, and bit for bit.
#include "offline/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "image/estimator_statistics.h"
#include "offline/path/camera_rays.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

std::shared_ptr<const Scene> recipe(const std::string& address) {
  Result<Scene> scene = make_recipe_from_address(address);
  EXPECT_TRUE(scene.has_value()) << address;
  return std::make_shared<const Scene>(std::move(*scene));
}

PathSettings small(std::uint32_t bounces, LightChoice lights = LightChoice::culling) {
  PathSettings settings;
  settings.width = 32, settings.height = 18, settings.bounces = bounces, settings.lights = lights;
  settings.pixel_filter = PixelFilter::box, settings.exposure = 0.1f;
  return settings;
}

Film render(const std::shared_ptr<const Scene>& scene, const Camera& camera, const PathSettings& settings,
            std::uint32_t samples) {
  Result<PathTracer> tracer = PathTracer::create(scene, camera, settings);
  EXPECT_TRUE(tracer.has_value());
  Film film(settings.width, settings.height, settings.exposure);
  for (std::uint32_t i = 0; i < samples; ++i) EXPECT_TRUE(tracer->add_sample(film));
  return film;
}

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

// Pixels of independent runs as values: z of the difference of two samplers' means.
struct Runs {
  std::vector<Colour> sum, squares;
  double count = 0;
};

Runs independent_runs(const std::shared_ptr<const Scene>& scene, PathSettings settings, std::uint32_t runs,
                      std::uint32_t samples) {
  Runs all;
  for (std::uint32_t run = 0; run < runs; ++run) {
    settings.seed = 100 + run;
    const std::vector<Vec3> pixels = render(scene, scene->cameras.at(0), settings, samples).image().colours("");
    // 4x2 pixels together: their means are close to normal.
    const std::size_t columns = settings.width / 4, rows = settings.height / 2;
    all.sum.resize(columns * rows), all.squares.resize(columns * rows);
    for (std::size_t block = 0; block < columns * rows; ++block) {
      Colour mean{};
      for (std::size_t k = 0; k < 8; ++k) {
        const std::size_t x = block % columns * 4 + k % 4, y = block / columns * 2 + k / 4;
        const Colour pixel = colour_of(pixels[y * settings.width + x]);
        for (std::size_t c = 0; c < 3; ++c) mean[c] += pixel[c] / 8;
      }
      for (std::size_t c = 0; c < 3; ++c) {
        all.sum[block][c] += mean[c], all.squares[block][c] += mean[c] * mean[c];
      }
    }
    ++all.count;
  }
  return all;
}

struct Agreement {
  double largest = 0, mean_square = 0;  // of z
  double values = 0;
};

Agreement compare(const Runs& a, const Runs& b) {
  Agreement agreement;
  for (std::size_t i = 0; i < a.sum.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double mean_a = a.sum[i][c] / a.count, mean_b = b.sum[i][c] / b.count;
      const double variance = (a.squares[i][c] / a.count - mean_a * mean_a) / (a.count - 1) +
                              (b.squares[i][c] / b.count - mean_b * mean_b) / (b.count - 1);
      if (!(variance > 1e-14)) continue;
      const double z = (mean_a - mean_b) / std::sqrt(variance);
      agreement.largest = std::max(agreement.largest, std::abs(z));
      agreement.mean_square += z * z, ++agreement.values;
    }
  }
  agreement.mean_square /= agreement.values;
  return agreement;
}

constexpr std::uint32_t kRuns = 48, kSamplesPerRun = 12;

// A right sampler's differences are close to normal (Student's t, with a mean square a little above one), and their
// number is hundreds, so the mean square says more than the largest.
bool agree(const Agreement& a, std::uint32_t runs = kRuns) {
  const double freedom = 2 * (runs - 1.0), spread = std::sqrt(2 / a.values) * 3;  // a block's channels go together
  return a.mean_square < freedom / (freedom - 2) + 0.01 + 3.3 * spread && a.largest < 6;
}

class SamplersAgree : public testing::TestWithParam<std::string> {};

TEST_P(SamplersAgree, with_the_exhaustive_choice) {
  const std::shared_ptr<const Scene> scene = recipe(GetParam());
  const PathSettings settings = small(2, LightChoice::exhaustive);
  const Runs truth = independent_runs(scene, settings, kRuns, kSamplesPerRun);
  const auto check = [&](const PathSettings& tested, const std::string& name) {
    const Agreement found = compare(independent_runs(scene, tested, kRuns, kSamplesPerRun), truth);
    EXPECT_TRUE(agree(found)) << name << ": mean square " << found.mean_square << ", largest " << found.largest;
  };
  // Not by flux or count: few of their samples make most of the light, and means of so few are not normal. The tests of
  // single lights (light_sampler_test) hold them.
  for (const LightChoice lights : {LightChoice::culling, LightChoice::tree}) {
    PathSettings tested = settings;
    tested.lights = lights;
    check(tested, name_of(lights));
  }
  PathSettings list = settings;
  list.lights = LightChoice::culling, list.resampling = Resampling::list;
  check(list, "list");
  PathSettings stratified = settings;
  stratified.lights = LightChoice::culling, stratified.range_samples = RangeNumbers::stratified;
  check(stratified, "stratified");
}

INSTANTIATE_TEST_SUITE_P(Scenes, SamplersAgree,
                         testing::Values("recipe:lamps?count=1", "recipe:lamps?count=200",
                                         "recipe:lamps?count=1000&textured=1", "recipe:lights?count=500",
                                         "recipe:cornell?glossy=0.1"));

// As many lights as weighing them all for each choice allows.
TEST(PathTracer, samplers_agree_among_sixty_thousand_lights) {
  constexpr std::uint32_t kFewRuns = 24;
  const std::shared_ptr<const Scene> scene = recipe("recipe:lamps?count=60000");
  const auto runs_of = [&](LightChoice lights) {
    PathSettings settings = small(1, lights);
    settings.width = 24, settings.height = 12;
    return independent_runs(scene, settings, kFewRuns, kSamplesPerRun);
  };
  const Runs truth = runs_of(LightChoice::exhaustive);
  for (const LightChoice lights : {LightChoice::culling, LightChoice::tree}) {
    const Agreement found = compare(runs_of(lights), truth);
    EXPECT_TRUE(agree(found, kFewRuns)) << name_of(lights) << ": mean square " << found.mean_square << ", largest "
                                        << found.largest;
  }
  EXPECT_FALSE(agree(compare(runs_of(LightChoice::clamped), truth), kFewRuns));
}

TEST(PathTracer, clamped_ranges_are_told_apart) {
  const std::shared_ptr<const Scene> scene = recipe("recipe:lamps?count=200");
  const Runs truth = independent_runs(scene, small(2, LightChoice::exhaustive), kRuns, kSamplesPerRun);
  EXPECT_FALSE(agree(compare(independent_runs(scene, small(2, LightChoice::clamped), kRuns, kSamplesPerRun), truth)));
}

TEST(PathTracer, same_bits_on_any_number_of_threads) {
  const std::shared_ptr<const Scene> scene = recipe("recipe:lamps?count=400");
  std::vector<std::vector<Film::Pixel>> films;
  for (const int threads : {1, 2, 3}) {
    with_threads(threads, [&] {
      PathSettings settings = small(3);
      settings.width = 70, settings.height = 41;  // no whole tiles
      films.push_back(render(scene, scene->cameras.at(0), settings, 3).pixels());
    });
  }
  EXPECT_EQ(films[0], films[1]);
  EXPECT_EQ(films[0], films[2]);
}

TEST(PathTracer, parts_add_up_to_the_whole) {
  const std::shared_ptr<const Scene> scene = recipe("recipe:lamps?count=100");
  const PathSettings settings = small(2);
  Result<PathTracer> tracer = PathTracer::create(scene, scene->cameras.at(0), settings);
  ASSERT_TRUE(tracer.has_value());
  Film whole(32, 18, settings.exposure), first(32, 18, settings.exposure), second(32, 18, settings.exposure, 3);
  for (int i = 0; i < 8; ++i) tracer->add_sample(whole);
  for (int i = 0; i < 5; ++i) tracer->add_sample(second);
  for (int i = 0; i < 3; ++i) tracer->add_sample(first);
  ASSERT_TRUE(second.merge(first));
  EXPECT_EQ(whole.pixels(), second.pixels());
}

}  // namespace
}  // namespace luciole
