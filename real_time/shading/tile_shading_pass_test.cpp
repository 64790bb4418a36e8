// SPDX-License-Identifier: Apache-2.0
// Passes culling and shading on the device: the CPU's lights, to the same light, whatever culling, part or batch.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "real_time/double_reference.h"
#include "real_time/vulkan_test_front.h"

namespace luciole::test {
namespace {

bool same_bits(const Plane3& a, const Plane3& b) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (a[c].size() != b[c].size()) return false;
    if (!a[c].empty() && std::memcmp(a[c].data(), b[c].data(), 4 * a[c].size()) != 0) return false;
  }
  return true;
}
bool same_bits(const Radiance& a, const Radiance& b) {
  return same_bits(a.diffuse, b.diffuse) && same_bits(a.specular, b.specular);
}

// Relative errors of pixels that are at no tie, against double precision.
struct Errors {
  double median = 0, largest = 0;
};

double light_of(const Radiance& radiance, std::size_t pixel, std::size_t channel) {
  return (channel < 3 ? radiance.diffuse : radiance.specular)[channel % 3][pixel];
}

Errors errors_of(const std::vector<DoublePixel>& right, const Radiance& found) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < right.size(); ++i) {
    const double most = *std::max_element(right[i].light.begin(), right[i].light.end());
    if (right[i].at_a_tie || most <= 0) continue;
    double error = 0;
    for (std::size_t c = 0; c < 6; ++c) error = std::max(error, std::abs(light_of(found, i, c) - right[i].light[c]));
    errors.push_back(error / most);
  }
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors.back()};
}

// SPIR-V allows operations 5 times the error of C++'s; the CPU's wide ones err 2 units where C++ errs 1/2.
void expect_no_worse(const Errors& device, const Errors& cpu, const std::string& what) {
  constexpr double kAllowed = 5, kHalfUnit = 6e-8;
  EXPECT_LE(device.median, kAllowed * std::max(cpu.median, kHalfUnit)) << what;
  EXPECT_LE(device.largest, kAllowed * std::max(cpu.largest, kHalfUnit)) << what;
}

struct Compared {
  std::vector<DoublePixel> indirect, many;
  ShadingOutputs cpu;
  std::size_t surfaces = 0;
};

Compared in_double(const Front& front, const Settings& settings) {
  const Reached reached = reach(front, settings, range_of(front, settings));
  Compared c;
  c.cpu = shade({front.geometry, reached.diffuse, reached.glossy, reached.many, settings, kShift, nullptr, true, true});
  c.indirect.resize(front.geometry.pixel_count()), c.many.resize(front.geometry.pixel_count());
  add_lights(front.geometry, reached.diffuse, settings.interleave, kShift, c.indirect);
  add_lights(front.geometry, reached.glossy, settings.interleave, kShift, c.indirect);
  add_lights(front.geometry, reached.many, settings.interleave, kShift, c.many);
  for (const float depth : front.geometry.depth) c.surfaces += depth != kNoSurface;
  return c;
}

// Pixels that cannot be compared light by light.
struct SetApart {
  std::size_t ties = 0;      // some |p/xi - 1| < 1e-5
  std::size_t others = 0;    // float lost more than that of p, near a lobe's horizon: another number of lights
  double expected_ties = 0;  // of random xi: without interleaving a pixel meets all lights, and hundreds may be near
};

SetApart set_apart(Compared& right, const ShadingOutputs& found) {
  SetApart apart;
  for (std::size_t i = 0; i < right.indirect.size(); ++i) {
    DoublePixel &indirect = right.indirect[i], &many = right.many[i];
    const auto accepted = static_cast<float>(indirect.accepted + many.accepted);
    const bool other = found.lights_listed[i] - found.lights_false[i] != accepted;
    const bool tie = indirect.at_a_tie || many.at_a_tie;
    apart.ties += tie, apart.others += other && !tie, apart.expected_ties += indirect.ties + many.ties;
    indirect.at_a_tie = many.at_a_tie = tie || other;
  }
  return apart;
}

TEST(ShadingOnTheDevice, accepts_the_cpus_lights_and_adds_them_to_the_same_light) {
  for (const char* address : kScenes) {
    for (const std::uint32_t interleave : {1u, 8u}) {
      const std::string what = std::string(address) + ", interleave " + std::to_string(interleave);
      const Settings settings = small_settings(interleave);
      const Front front(address, settings);
      Compared right = in_double(front, settings);
      const auto engine = open_engine(settings);
      const ShadingOutputs device = shade_on(*engine, front, settings);
      const SetApart apart = set_apart(right, device);
      EXPECT_LE(double(apart.ties), apart.expected_ties + 5 * std::sqrt(apart.expected_ties) + 1) << what;
      EXPECT_LE(apart.others, right.surfaces / 1000) << what;
      std::printf("%s: %zu ties and %zu others of %zu pixels set apart\n", what.c_str(), apart.ties, apart.others,
                  right.surfaces);
      set_apart(right, right.cpu);
      EXPECT_EQ(device.pixels, right.cpu.pixels) << what;
      expect_no_worse(errors_of(right.indirect, device.radiance.indirect),
                      errors_of(right.indirect, right.cpu.radiance.indirect), what);
      if (front.many.size() == 0) continue;
      expect_no_worse(errors_of(right.many, device.radiance.from_many),
                      errors_of(right.many, right.cpu.radiance.from_many), what + ", many lights");
    }
  }
}

TEST(ShadingOnTheDevice, of_one_light_too_many_is_caught) {
  const Settings settings = small_settings();
  const Front front("recipe:cornell?glossy=0.1", settings);
  const Compared right = in_double(front, settings);
  const auto engine = open_engine(settings);
  Radiance device = std::move(shade_on(*engine, front, settings).radiance.indirect);
  const Errors cpu = errors_of(right.indirect, right.cpu.radiance.indirect);
  for (std::size_t i = 0; i < right.indirect.size(); ++i) device.diffuse[0][i] *= 1 + 1e-4f;
  EXPECT_GT(errors_of(right.indirect, device).median, 5 * cpu.median);
}

TEST(CullingOnTheDevice, changes_the_cost_but_never_the_picture) {
  for (const char* address : {"recipe:ring?alpha=0.1", "recipe:lights?count=500"}) {
    for (const std::uint32_t interleave : {1u, 8u}) {
      Settings settings = small_settings(interleave);
      const Front front(address, settings);
      settings.culling = Culling::none;
      const ShadingOutputs all = shade_on(*open_engine(settings), front, settings);
      settings.culling = Culling::tiled;
      for (const BoundingVolume bounds :
           {BoundingVolume::sphere_at_light, BoundingVolume::sphere, BoundingVolume::spheroid, BoundingVolume::tight}) {
        const TileTest test = bounds == BoundingVolume::tight      ? TileTest::tight
                              : bounds == BoundingVolume::spheroid ? TileTest::exact
                                                                   : TileTest::paper;
        settings.bounds = bounds, settings.tile_test = test;
        const ShadingOutputs culled = shade_on(*open_engine(settings), front, settings);
        const std::string what = std::string(address) + ", " + to_string(bounds) + ", " + to_string(test);
        EXPECT_TRUE(same_bits(culled.radiance.indirect, all.radiance.indirect)) << what;
        EXPECT_TRUE(same_bits(culled.radiance.from_many, all.radiance.from_many)) << what;
        EXPECT_LT(culled.diffuse.listed + culled.glossy.listed + culled.many.listed,
                  all.diffuse.listed + all.glossy.listed + all.many.listed)
            << what;
        EXPECT_EQ(culled.diffuse.accepted + culled.glossy.accepted + culled.many.accepted,
                  all.diffuse.accepted + all.glossy.accepted + all.many.accepted)
            << what;
      }
    }
  }
}

// More lights than a list holds, in parts and in batches, are added in the same order.
TEST(ShadingOnTheDevice, is_the_same_in_parts_of_any_length) {
  Settings settings = small_settings(1);
  settings.vpls = 3000;
  const Front front("recipe:cornell?glossy=0.1", settings);
  ASSERT_GT(front.vpls.size(), 2048u);
  const ShadingOutputs whole = shade_on(*open_engine(settings), front, settings);
  for (const std::uint32_t part : {100u, 1024u, 1500u}) {
    const ShadingOutputs parts = shade_on(*open_engine(settings, part), front, settings);
    EXPECT_TRUE(same_bits(parts.radiance.indirect, whole.radiance.indirect)) << part;
    EXPECT_TRUE(same_bits(parts.radiance.from_glossy, whole.radiance.from_glossy)) << part;
    EXPECT_EQ(parts.glossy.accepted, whole.glossy.accepted) << part;
    EXPECT_EQ(parts.glossy.listed, whole.glossy.listed) << part;
    EXPECT_EQ(parts.lights_listed, whole.lights_listed) << part;
  }
}

// More lights than one part may have: each light of each part takes turns of the loops that software Vulkan counts.
TEST(ShadingOnTheDevice, of_parts_as_long_as_they_may_be_loses_no_light) {
  Settings settings = small_settings(1);
  settings.width = settings.height = 16, settings.vpls = 40000, settings.culling = Culling::none;
  const Front front("recipe:cornell?glossy=0.1", settings);
  const auto engine = open_engine(settings);
  if (engine->device().kind == gpu::DeviceKind::cpu) {
    ASSERT_GT(front.vpls.size(), engine->largest_part());
  }
  const ShadingOutputs whole = shade_on(*engine, front, settings);
  const ShadingOutputs parts = shade_on(*open_engine(settings, 1000), front, settings);
  EXPECT_TRUE(same_bits(whole.radiance.indirect, parts.radiance.indirect));
  EXPECT_EQ(whole.diffuse.accepted, parts.diffuse.accepted);
  EXPECT_GT(whole.diffuse.accepted, 0);
}

// The tile test of the device lists what the CPU's lists, but for ties.
TEST(CullingOnTheDevice, lists_what_the_cpu_lists) {
  for (const TileTest test : {TileTest::paper, TileTest::exact, TileTest::tight}) {
    Settings settings = small_settings();
    settings.tile_test = test;
    const Front front("recipe:ring?alpha=0.1", settings);
    const Reached reached = reach(front, settings, range_of(front, settings));
    const ShadingOutputs cpu =
        shade({front.geometry, reached.diffuse, reached.glossy, reached.many, settings, kShift, nullptr, true, true});
    const ShadingOutputs device = shade_on(*open_engine(settings), front, settings);
    const auto share = [](std::uint64_t a, std::uint64_t b) { return std::abs(double(a) / double(b) - 1); };
    EXPECT_LE(share(device.diffuse.listed, cpu.diffuse.listed), 1e-3) << to_string(test);
    EXPECT_LE(share(device.glossy.listed, cpu.glossy.listed), 1e-3) << to_string(test);
    EXPECT_EQ(device.list_lengths.size(), cpu.list_lengths.size()) << to_string(test);
  }
}

}  // namespace
}  // namespace luciole::test
