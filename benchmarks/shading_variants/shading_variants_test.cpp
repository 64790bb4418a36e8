// SPDX-License-Identifier: Apache-2.0
// Every variant gives the engine's light, so that what the benchmark times is the same work, and none rots.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "benchmarks/shading_variants/comparison.h"
#include "benchmarks/shading_variants/errors.h"
#include "gpu/test_device.h"
#include "real_time/vulkan_test_front.h"

namespace luciole::test {
namespace {

struct Bench {
  Bench(const std::string& address, std::uint32_t interleave)
      : settings(small_settings(interleave)), front(address, settings), device(gpu::test::open_device()) {
    stage = std::move(*DeviceStage::create(*device, {settings, front.geometry, front.vpls, front.many}));
  }

  Settings settings;
  Front front;
  std::unique_ptr<gpu::Device> device;
  std::unique_ptr<DeviceStage> stage;
};

std::vector<std::vector<PixelSums>> shade(Bench& bench, const Variant& variant) {
  EXPECT_TRUE(bench.stage->forget_sums().has_value());
  gpu::CommandList list = gpu::test::make_list(*bench.device);
  for (const LightKind kind : bench.stage->kinds()) {
    list.begin_pass(variant.name);
    variant.record(list, kind);
    if (variant.kinds_together) break;
  }
  EXPECT_TRUE(list.run().has_value()) << variant.name;
  std::vector<std::vector<PixelSums>> sums;
  for (const LightKind kind : bench.stage->kinds()) sums.push_back(std::move(*bench.stage->read_sums(kind)));
  return sums;
}

// Without interleaving a tile asks more lights than a list holds; with it there are sub-regions.
TEST(ShadingVariants, give_the_engines_light) {
  const std::pair<const char*, std::uint32_t> scenes[] = {{"recipe:cornell?glossy=0.1", 1},
                                                          {"recipe:lights?count=500", 4}};
  for (const auto& [address, interleave] : scenes) {
    Bench bench(address, interleave);
    Result<Variants> variants = make_variants(*bench.device, *bench.stage);
    ASSERT_TRUE(variants.has_value()) << variants.error().message;
    const bool software = bench.device->description().kind == gpu::DeviceKind::cpu;  // it translates all kernels alike
    EXPECT_TRUE(variants->left_out.empty() || !software);
    const auto engine = shade(bench, variants->tried.front());
    for (const Variant& variant : variants->tried) {
      const auto found = shade(bench, variant);
      for (std::size_t k = 0; k < engine.size(); ++k) {
        const Comparison c = compare(bench.front.geometry, engine[k], found[k]);
        EXPECT_EQ(complaint(c), "") << variant.name << ", " << address << ", kind " << k;
        EXPECT_GT(c.accepted, 0) << variant.name;
        if (!software) continue;
        EXPECT_EQ(broken_promise(c, variant.agreement), "") << variant.name << ", " << address << ", kind " << k;
      }
    }
  }
}

TEST(ShadingVariants, of_other_light_are_caught) {
  Bench bench("recipe:cornell?glossy=0.1", 8);
  const Variants variants = std::move(*make_variants(*bench.device, *bench.stage));
  const std::vector<PixelSums> engine = shade(bench, variants.tried.front()).front();
  const GeometryBuffer& geometry = bench.front.geometry;
  std::size_t lit = 0;
  while (geometry.depth[lit] == kNoSurface || engine[lit].accepted < 2 || !(engine[lit].diffuse[1] > 0)) ++lit;

  std::vector<PixelSums> other = engine;
  other[lit].diffuse[1] = std::nextafter(other[lit].diffuse[1], 1e9f);
  EXPECT_NE(broken_promise(compare(geometry, engine, other), Agreement::bits), "");
  EXPECT_EQ(broken_promise(compare(geometry, engine, other), Agreement::rounding), "");
  other[lit].diffuse[1] = engine[lit].diffuse[1] * (1 + 1e-4f);
  EXPECT_NE(broken_promise(compare(geometry, engine, other), Agreement::rounding), "");
  other = engine, ++other[lit].accepted;
  EXPECT_NE(broken_promise(compare(geometry, engine, other), Agreement::half_precision), "");
  for (PixelSums& sums : other) ++sums.accepted;
  EXPECT_NE(complaint(compare(geometry, engine, other)), "");
  other = engine;
  for (PixelSums& sums : other) sums.specular[0] *= 1.02f, sums.diffuse[0] *= 1.02f;
  EXPECT_NE(complaint(compare(geometry, engine, other)), "");

  ASSERT_TRUE(bench.stage->forget_sums().has_value());  // what no kernel wrote
  EXPECT_NE(complaint(compare(geometry, engine, *bench.stage->read_sums(bench.stage->kinds().front()))), "");
}

// 2.5D culling and finer tiles are not the same lists by another name.
TEST(ShadingVariants, list_other_lights_where_they_should) {
  Bench bench("recipe:cornell?glossy=0.1", 1);
  const Variants variants = std::move(*make_variants(*bench.device, *bench.stage));
  const auto listed = [&](const char* name) {
    const auto variant =
        std::find_if(variants.tried.begin(), variants.tried.end(), [&](const Variant& v) { return v.name == name; });
    double sum = 0;
    const std::vector<PixelSums> sums = shade(bench, *variant).front();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (bench.front.geometry.depth[i] != kNoSurface) sum += sums[i].listed;
    }
    return sum;
  };
  const double engine = listed("lights by pixel");
  EXPECT_EQ(listed("lights staged"), engine);
  EXPECT_EQ(listed("split kernels"), engine);
  EXPECT_LT(listed("tiles of 8x8"), engine);
  EXPECT_LT(listed("depth masks and halves"), engine);
  EXPECT_NE(listed("depth mask"), engine);
  EXPECT_GT(listed("sphere-at-light bounds, tight test"), engine);
}

TEST(ShadingVariants, refuse_what_they_cannot_do) {
  Bench bench("recipe:cornell?glossy=0.1", 8);
  bench.settings.tile_test = TileTest::paper;
  EXPECT_FALSE(make_variants(*bench.device, *bench.stage).has_value());
  bench.settings.tile_test = TileTest::tight, bench.settings.culling = Culling::none;
  EXPECT_FALSE(make_variants(*bench.device, *bench.stage).has_value());
  bench.settings.culling = Culling::tiled;
  EXPECT_TRUE(make_variants(*bench.device, *bench.stage).has_value());
}

// Half precision errs as its roundings say, a thousand times as much as float, and less than the limit.
TEST(ShadingVariants, in_half_precision_err_as_much_as_eleven_bits_must) {
  Bench bench("recipe:ring?alpha=0.1", 8);
  const Variants variants = std::move(*make_variants(*bench.device, *bench.stage));
  const auto half = std::find_if(variants.tried.begin(), variants.tried.end(),
                                 [](const Variant& v) { return v.agreement == Agreement::half_precision; });
  if (half == variants.tried.end()) GTEST_SKIP() << "the device has no half precision";
  const DoubleReference reference(*bench.stage, bench.front.vpls, bench.front.geometry.pixel_count());
  const double of_engine = reference.median_error(shade(bench, variants.tried.front()));
  const double of_half = reference.median_error(shade(bench, *half));
  std::printf("median relative error against double: float %.2g, half %.2g\n", of_engine, of_half);
  EXPECT_GT(of_half, 10 * of_engine);
  EXPECT_LT(of_half, std::sqrt(most_of_half_precision()));
}

}  // namespace
}  // namespace luciole::test
