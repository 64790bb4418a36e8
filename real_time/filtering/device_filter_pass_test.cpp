// SPDX-License-Identifier: Apache-2.0
// The filter on the device against its definition, in double: on a room of formulas and on frames.
#include "real_time/filtering/device_filter_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "gpu/test_device.h"
#include "real_time/filtering/bilateral_filter.h"
#include "real_time/filtering/reference_filter.h"
#include "real_time/filtering/synthetic_room.h"
#include "real_time/vulkan_test_front.h"
#include "real_time/vulkan_transfer.h"

namespace luciole::test {
namespace {

constexpr float kUlp = std::numeric_limits<float>::epsilon();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kInterleave = 8;

std::vector<const Plane*> planes_of(const Radiance& light) {
  return {&light.diffuse[0],  &light.diffuse[1],  &light.diffuse[2],
          &light.specular[0], &light.specular[1], &light.specular[2]};
}

// Sums of which `share` of the light comes. Nobody writes those of the sky: there they are no numbers.
std::vector<PixelSums> sums_of(const GeometryBuffer& g, const Radiance& light, float share) {
  std::vector<PixelSums> sums(g.pixel_count());
  const float scale = share / (kInterleave * kInterleave);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const bool sky = g.depth[i] == kNoSurface;
    for (std::size_t c = 0; c < 3; ++c) {
      sums[i].diffuse[c] = sky ? kNan : light.diffuse[c][i] * scale;
      sums[i].specular[c] = sky ? kNan : light.specular[c][i] * scale;
    }
  }
  return sums;
}

struct Filtered {
  Radiance light;
  std::uint32_t not_finite = 0;
};

// The pass by itself, of light that lies in one buffer of sums or half in each of two.
class FilterOnDevice {
 public:
  explicit FilterOnDevice(FilterRadius radius) : device_(gpu::test::open_device()) {
    Result<DeviceFilterPass> pass = DeviceFilterPass::create(*device_, radius, kInterleave);
    EXPECT_TRUE(pass.has_value()) << pass.error().message;
    pass_ = std::move(*pass);
  }

  Filtered run(const GeometryBuffer& geometry, const Radiance& noisy, bool in_two = false) {
    const std::size_t pixels = geometry.pixel_count();
    std::vector<PixelRecord> records(pixels);
    pack(geometry, records.data());
    gpu::CommandList list = gpu::test::make_list(*device_);
    list.begin_pass("transfer");
    const std::vector<PixelSums> sums = sums_of(geometry, noisy, in_two ? 0.5f : 1.0f);
    const gpu::Buffer on_device[] = {send(list, records), send(list, sums), send(list, sums)};
    const gpu::Buffer filtered = made(pixels * sizeof(PixelLight), gpu::BufferUse::device);
    const gpu::Buffer counts = made(sizeof(FilterCounts), gpu::BufferUse::device);
    list.begin_pass("filtering");
    const gpu::Buffer* more = in_two ? &on_device[2] : nullptr;
    pass_.record(list, {&on_device[0], &on_device[1], more, &filtered, &counts}, geometry);
    list.begin_pass("transfer");
    const gpu::Buffer received = made(pixels * sizeof(PixelLight), gpu::BufferUse::readback);
    const gpu::Buffer received_counts = made(sizeof(FilterCounts), gpu::BufferUse::readback);
    list.copy(filtered, received, pixels * sizeof(PixelLight));
    list.copy(counts, received_counts, sizeof(FilterCounts));
    const Status done = list.run();
    EXPECT_TRUE(done.has_value()) << done.error().message;
    sent_.clear();
    Filtered result;
    unpack(received.as<PixelLight>(), pixels, result.light);
    result.not_finite = received_counts.as<FilterCounts>()->not_finite;
    return result;
  }

 private:
  gpu::Buffer made(std::uint64_t bytes, gpu::BufferUse use) { return gpu::test::make_buffer(*device_, bytes, use); }

  template <class T>
  gpu::Buffer send(gpu::CommandList& list, const std::vector<T>& values) {
    sent_.push_back(gpu::test::upload_of(*device_, values));
    gpu::Buffer buffer = made(values.size() * sizeof(T), gpu::BufferUse::device);
    list.copy(sent_.back(), buffer, values.size() * sizeof(T));
    return buffer;
  }

  std::unique_ptr<gpu::Device> device_;
  DeviceFilterPass pass_;
  std::vector<gpu::Buffer> sent_;
};

// Largest error over what is allowed, and how many pixels are beyond it. The definition says by how much C++'s float
// may differ; SPIR-V allows operations 5 times the error of C++'s.
struct Comparison {
  double largest = 0;
  std::size_t beyond = 0, surfaces = 0;
};
Comparison compare_light(const GeometryBuffer& g, const Radiance& found, const ReferenceLight& right) {
  constexpr double kAllowed = 5;
  Comparison c;
  for (std::size_t i = 0; i < g.pixel_count(); ++i) {
    double largest = 0;
    for (std::size_t p = 0; p < 6; ++p) {
      const double light = (*planes_of(right.light)[p])[i], rounding = (*planes_of(right.rounding)[p])[i];
      const double error = std::abs(double((*planes_of(found)[p])[i]) - light);
      if (error == 0) continue;
      largest = std::max(largest, error / (kAllowed * (rounding + double(kUlp) * std::abs(light)) + 1e-30));
    }
    c.largest = std::max(c.largest, largest);
    c.beyond += !(largest <= 1);
    c.surfaces += g.depth[i] != kNoSurface;
  }
  return c;
}

TEST(FilterOnTheDevice, agrees_with_its_definition) {
  for (const FilterRadius radius : {FilterRadius{8, 8}, FilterRadius{0, 3}, FilterRadius{5, 0}, FilterRadius{0, 0}}) {
    FilterOnDevice filter(radius);
    ReferenceFilter definition;
    definition.radius = radius;
    for (const auto& [width, height] :
         {std::pair{150u, 90u}, std::pair{16u, 16u}, std::pair{1u, 1u}, std::pair{17u, 3u}, std::pair{5u, 41u}}) {
      const SyntheticRoom room = make_synthetic_room(width, height);
      const Radiance noisy = interleaved_noise(room, kInterleave, 3);
      const ReferenceLight right = filter_by_definition(definition, room.geometry, noisy);
      for (const bool in_two : {false, true}) {
        const Filtered found = filter.run(room.geometry, noisy, in_two);
        EXPECT_LE(compare_light(room.geometry, found.light, right).largest, 1)
            << width << "x" << height << ", radius " << radius.x << ", " << radius.y;
        EXPECT_EQ(found.not_finite, 0u) << "the sky's sums are nobody's";
      }
    }
  }
}

// The tolerance above tells the weights from others that are nearly the same.
TEST(FilterOnTheDevice, of_another_weight_is_caught) {
  const SyntheticRoom room = make_synthetic_room(97, 72);
  const Radiance noisy = interleaved_noise(room, kInterleave, 3);
  const Radiance found = FilterOnDevice({8, 8}).run(room.geometry, noisy).light;
  const auto beyond = [&](const ReferenceFilter& wrong) {
    const Comparison c = compare_light(room.geometry, found, filter_by_definition(wrong, room.geometry, noisy));
    return double(c.beyond) / double(c.surfaces);
  };
  EXPECT_EQ(beyond({}), 0.0);
  EXPECT_GT(beyond({{8, 8}, 1.0}), 0.5) << "ends that weigh as much as the others";
  EXPECT_GT(beyond({{8, 7}}), 0.5) << "a row too few";
  EXPECT_GT(beyond({{8, 8}, 0.5, false}), 0.5) << "no guides";
  EXPECT_GT(beyond({{8, 8}, 0.5, true, false}), 0.5) << "not divided by the weights";
}

// Light that is 1/2 where it is demodulated, so that any mean of it is.
float half_modulated(const GeometryBuffer& g, std::size_t i, std::size_t channel) {
  const float left = 1.0f - std::max({g.f0[0][i], g.f0[1][i], g.f0[2][i]});
  return 0.5f * (channel < 3 ? std::max(left, 0.0625f) : std::max(g.f0[channel - 3][i], 0.02f));
}

TEST(FilterOnTheDevice, replaces_and_counts_light_that_is_not_finite) {
  const SyntheticRoom room = make_synthetic_room(90, 60);
  const GeometryBuffer& g = room.geometry;
  Radiance noisy;
  noisy.resize(g.pixel_count());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < g.pixel_count(); ++i) {
      noisy.diffuse[c][i] = half_modulated(g, i, c), noisy.specular[c][i] = half_modulated(g, i, c + 3);
    }
  }
  std::uint32_t bad = 0;
  for (std::size_t i = 7; i < g.pixel_count(); i += 31) {
    if (g.material[i] != 4 && g.material[i] != 5) continue;  // walls, where every pixel has its like
    const float value = bad % 3 == 0 ? kNan : bad % 3 == 1 ? kInfinite : -kInfinite;
    (bad % 2 == 0 ? noisy.diffuse : noisy.specular)[bad % 3][i] = value;
    ++bad;
  }
  ASSERT_GT(bad, 20u);
  const Filtered found = FilterOnDevice({8, 8}).run(g, noisy);
  EXPECT_EQ(found.not_finite, bad);
  // A sum rounds once per tap of a row and once per row; divisions by SPIR-V err by 2.5 units in the last place.
  constexpr float kRounded = (17 + 17 + 4 * 2.5f) * kUlp;
  for (std::size_t i = 0; i < g.pixel_count(); ++i) {
    const bool sky = g.depth[i] == kNoSurface;
    for (std::size_t p = 0; p < 6; ++p) {
      const float right = sky ? 0.0f : half_modulated(g, i, p);
      ASSERT_NEAR((*planes_of(found.light)[p])[i], right, kRounded * right) << "pixel " << i;
    }
  }
}

VulkanShaded filtered_by(VulkanEngine& engine, const Front& front, const Settings& settings, bool noisy_too) {
  Result<VulkanShaded> shaded = engine.shade(
      {1, front.geometry, front.vpls, front.many, range_of(front, settings), kShift, false, false, true, noisy_too});
  EXPECT_TRUE(shaded.has_value()) << shaded.error().message;
  return std::move(*shaded);
}

TEST(FilterOnTheDevice, filters_frames_as_it_is_defined) {
  for (const char* address : kScenes) {
    Settings settings = small_settings();
    settings.width = 75, settings.height = 45, settings.filter = Filter::bilateral;
    const Front front(address, settings);
    const auto engine = open_engine(settings);
    const VulkanShaded both = filtered_by(*engine, front, settings, true);
    ASSERT_TRUE(both.filtered.has_value());
    const ReferenceLight right = filter_by_definition({}, front.geometry, both.shaded.radiance.indirect);
    const Comparison indirect = compare_light(front.geometry, both.filtered->indirect, right);
    EXPECT_LE(indirect.largest, 1) << address << ": " << indirect.beyond << " of " << indirect.surfaces;
    EXPECT_GT(compare_light(front.geometry, both.shaded.radiance.indirect, right).beyond, indirect.surfaces / 2)
        << "noisy light is caught";
    EXPECT_EQ(both.filtered->from_many.diffuse[0].empty(), front.many.size() == 0) << address;
    if (front.many.size() > 0) {
      const ReferenceLight many = filter_by_definition({}, front.geometry, both.shaded.radiance.from_many);
      EXPECT_LE(compare_light(front.geometry, both.filtered->from_many, many).largest, 1) << address;
    }
    EXPECT_EQ(both.filtered->not_finite, 0u);

    const VulkanShaded alone = filtered_by(*engine, front, settings, false);
    EXPECT_TRUE(alone.shaded.radiance.indirect.diffuse[0].empty()) << "what nobody asked for stays on the device";
    EXPECT_EQ(alone.filtered->indirect.diffuse, both.filtered->indirect.diffuse) << address;
    EXPECT_EQ(alone.filtered->indirect.specular, both.filtered->indirect.specular) << address;
    EXPECT_EQ(alone.shaded.glossy.accepted, both.shaded.glossy.accepted) << address;
  }
}

}  // namespace
}  // namespace luciole::test
