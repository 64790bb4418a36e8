// SPDX-License-Identifier: Apache-2.0
// The path tracer as a whole: against itself with other choices of lights, and bit for bit.
#include "offline/render.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "image/estimator_statistics.h"
#include "offline/small_pictures.h"
#include "scene/recipes/recipes.h"

namespace luciole::test {
namespace {

std::shared_ptr<const Scene> recipe(const std::string& address) {
  Result<Scene> scene = make_recipe_from_address(address);
  EXPECT_TRUE(scene.has_value()) << address;
  return std::make_shared<const Scene>(std::move(*scene));
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
    settings.width = 16, settings.height = 9;
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
}  // namespace luciole::test
