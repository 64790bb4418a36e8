// SPDX-License-Identifier: Apache-2.0
// Pass light_range on the device against the CPU's, on the same lights.
#include <cmath>
#include <cstring>
#include <span>

#include "real_time/vulkan_test_front.h"

namespace luciole::test {
namespace {

// Random numbers and all that is copied or multiplied once are the same bits; roots and sums of products are not.
template <class Emitter>
void expect_same_emitters(const ReachingLights<Emitter>& lights, const std::vector<char>& bytes, float Emitter::*root,
                          const char* what) {
  ASSERT_EQ(bytes.size(), lights.emitters.size() * sizeof(Emitter));
  const std::span found(reinterpret_cast<const Emitter*>(bytes.data()), lights.emitters.size());
  double largest = 0;
  for (std::size_t s = 0; s < lights.begin.size(); ++s) {
    for (std::uint32_t k = lights.begin[s]; k < lights.begin[s] + lights.count[s]; ++k) {
      const Emitter &cpu = lights.emitters[k], &device = found[k];
      ASSERT_EQ(std::memcmp(&cpu.xi, &device.xi, 4), 0) << what << " " << k;
      ASSERT_EQ(std::memcmp(cpu.position, device.position, 12), 0) << what << " " << k;
      ASSERT_EQ(cpu.probability_scale, device.probability_scale) << what << " " << k;
      ASSERT_EQ(cpu.disc, device.disc) << what << " " << k;
      if (root != nullptr) largest = std::max<double>(largest, std::abs(device.*root / cpu.*root - 1));
    }
  }
  EXPECT_LE(largest, 4 * 1.2e-7) << what << ": a root of a product and two sums, within 2.5 units in the last place";
}

TEST(LightRangeOnTheDevice, draws_the_same_numbers_and_prepares_the_same_lights) {
  for (const char* address : kScenes) {
    for (const bool stratified : {false, true}) {
      Settings settings = small_settings();
      settings.stratified_ranges = stratified;
      const Front front(address, settings);
      const Reached cpu = reach(front, settings, range_of(front, settings));
      const auto engine = open_engine(settings);
      shade_on(*engine, front, settings);
      if (!cpu.diffuse.emitters.empty()) {
        expect_same_emitters(cpu.diffuse, *engine->read_emitters(kDiffuseLights), {}, "diffuse lobe");
        expect_same_emitters(cpu.glossy, *engine->read_emitters(kGlossyLights), &GlossyEmitter::masking, "glossy lobe");
      }
      if (!cpu.many.emitters.empty()) {
        expect_same_emitters(cpu.many, *engine->read_emitters(kManyLights), {}, "light");
      }
    }
  }
}

// Radius of each bound against the same in double precision: SPIR-V allows 5 times the error of C++ (gpu/
// equations_device_test.cpp). The tight one may keep another of two equally good ellipsoids, here and there.
TEST(LightRangeOnTheDevice, bounds_lights_as_the_cpu_does) {
  for (const BoundingVolume bounds : {BoundingVolume::sphere, BoundingVolume::spheroid, BoundingVolume::tight}) {
    Settings settings = small_settings();
    settings.bounds = bounds;
    const Front front("recipe:ring?alpha=0.1", settings);
    const Reached cpu = reach(front, settings, range_of(front, settings));
    const auto engine = open_engine(settings);
    shade_on(*engine, front, settings);
    for (const bool glossy : {false, true}) {
      const auto& expected = glossy ? cpu.glossy.bounds : cpu.diffuse.bounds;
      const std::vector<char> bytes = *engine->read_bounds(glossy ? kGlossyLights : kDiffuseLights);
      ASSERT_EQ(bytes.size(), expected.size() * sizeof(BoundBlock));
      std::size_t lights = 0, others = 0;
      for (std::size_t b = 0; b < expected.size(); ++b) {
        BoundBlock found;
        std::memcpy(&found, bytes.data() + b * sizeof(BoundBlock), sizeof(found));
        for (int lane = 0; lane < 16; ++lane) {
          const float right = expected[b].row[BoundBlock::kRadius][lane], is = found.row[BoundBlock::kRadius][lane];
          ASSERT_EQ(right < 0, is < 0) << "whether it reaches anything";
          if (right < 0) continue;
          ++lights;
          others += std::abs(is / right - 1) > 1e-5f;
        }
      }
      EXPECT_LE(others, lights / 1000) << to_string(bounds) << (glossy ? ", glossy" : ", diffuse");
    }
  }
}

}  // namespace
}  // namespace luciole::test
