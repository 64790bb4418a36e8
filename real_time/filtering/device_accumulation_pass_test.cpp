// SPDX-License-Identifier: Apache-2.0
// The mean over frames on a device and on the CPU: both are the one of double precision, but where rounding decides
// whether a surface is the same.
#include "real_time/filtering/device_accumulation_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "real_time/device_bench.h"
#include "real_time/filtering/device_filter_pass.h"
#include "real_time/filtering/reference_accumulation.h"
#include "real_time/filtering/synthetic_room.h"
#include "real_time/filtering/temporal_accumulation.h"

namespace luciole::test {
namespace {

constexpr std::uint32_t kInterleave = 8, kLongest = 5;
constexpr float kWeight = 64;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();

// The light of a frame, in sums and as the CPU unpacks them.
struct FrameLight {
  std::vector<PixelSums> diffuse, glossy, many;
  Radiance indirect, from_many;

  FrameLight(const GeometryBuffer& g, std::uint32_t seed) {
    MadeUpLight make(seed);
    diffuse = make.sums(g, 1 / kWeight), glossy = make.sums(g, 1 / kWeight), many = make.sums(g, 1 / kWeight);
    unpack(g);
  }
  void unpack(const GeometryBuffer& g) {
    Unpacked unpacked(g, diffuse, glossy, many, kWeight);
    indirect = std::move(unpacked.out.radiance.indirect), from_many = std::move(unpacked.out.radiance.from_many);
  }
};

// What accumulation made of a frame.
struct Accumulated {
  std::vector<PixelSums> indirect, many;
  std::vector<float> frames;
  AccumulationCounts counts{};
};

FrameView view_of(const GeometryBuffer& g, std::uint64_t number) {
  return {g.camera, g.sub_pixel_x, g.sub_pixel_y, g.width, g.height, number, false};
}

class AccumulatorOnDevice {
 public:
  explicit AccumulatorOnDevice(std::uint32_t longest, std::uint32_t interleave = kInterleave, bool validated = false)
      : bench(validated) {
    Result<DeviceAccumulationPass> made = DeviceAccumulationPass::create(bench.device(), interleave, longest);
    EXPECT_TRUE(made.has_value()) << made.error().message;
    pass = std::move(*made);
  }

  Accumulated run(const GeometryBuffer& g, std::uint64_t number, const FrameLight& light, bool with_many = true) {
    const std::size_t pixels = g.pixel_count();
    const gpu::Buffer sent[] = {bench.send(pixel_records(g)), bench.send(surface_records(g)), bench.send(light.diffuse),
                                bench.send(light.glossy), bench.send(light.many)};
    const gpu::Buffer frames = bench.make(pixels * sizeof(float)), counts = bench.make(sizeof(AccumulationCounts));
    gpu::CommandList list = bench.list();
    list.begin_pass("temporal_accumulation");
    const Status recorded = pass.record(list,
                                        {.pixels = &sent[0],
                                         .surfaces = &sent[1],
                                         .sums = &sent[2],
                                         .more_sums = &sent[3],
                                         .many_sums = with_many ? &sent[4] : nullptr,
                                         .frames = &frames,
                                         .counts = &counts},
                                        view_of(g, number));
    EXPECT_TRUE(recorded.has_value()) << recorded.error().message;
    bench.run(list);
    Accumulated made;
    made.indirect = bench.receive<PixelSums>(*pass.indirect(), pixels);
    EXPECT_EQ(pass.many() != nullptr, with_many);
    if (pass.many() != nullptr) made.many = bench.receive<PixelSums>(*pass.many(), pixels);
    made.frames = bench.receive<float>(frames, pixels);
    made.counts = bench.receive<AccumulationCounts>(counts, 1)[0];
    return made;
  }

  DeviceBench bench;
  DeviceAccumulationPass pass;
};

// The same by the CPU's pass.
class AccumulatorOnCpu {
 public:
  explicit AccumulatorOnCpu(std::uint32_t longest) : longest_(longest) {}

  Accumulated run(const GeometryBuffer& g, std::uint64_t number, const FrameLight& light) {
    Radiance indirect = light.indirect, many = light.from_many;
    pass_.run({g, number, longest_}, indirect, many);
    Accumulated made;
    made.indirect = sums_of(indirect), made.many = sums_of(many);
    made.frames = {pass_.frames().begin(), pass_.frames().end()};
    return made;
  }

 private:
  static std::vector<PixelSums> sums_of(const Radiance& light) {
    std::vector<PixelSums> sums(light.diffuse[0].size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        sums[i].diffuse[c] = light.diffuse[c][i], sums[i].specular[c] = light.specular[c][i];
    }
    return sums;
  }

  std::uint32_t longest_;
  TemporalAccumulationPass pass_;
};

struct Comparison {
  std::size_t surfaces = 0, contested = 0;
  std::size_t beyond = 0;   // of the others, not the reference within rounding
  std::size_t history = 0;  // that go on from the frame before
};

Comparison compare_with(const ReferenceAccumulation& right, const GeometryBuffer& g, const Accumulated& found) {
  Comparison c;
  for (std::size_t i = 0; i < g.pixel_count(); ++i) {
    if (g.depth[i] == kNoSurface) continue;
    const ReferenceAccumulation::Pixel& pixel = right.pixels()[i];
    ++c.surfaces, c.contested += pixel.contested, c.history += pixel.diffuse_frames.value > 1;
    if (pixel.contested) continue;
    const auto within = [](double value, const Uncertain& wanted) {
      return std::abs(value - wanted.value) <= wanted.error;
    };
    bool good = within(found.frames[i], pixel.diffuse_frames);
    for (std::size_t k = 0; k < 12; ++k) {
      const PixelSums& sums = k < 6 ? found.indirect[i] : found.many[i];
      good = good && within(k % 6 < 3 ? sums.diffuse[k % 3] : sums.specular[k % 3], pixel.light[k]);
    }
    c.beyond += !good;
  }
  return c;
}

TEST(AccumulationOnTheDevice, of_a_moving_view_is_the_mean_of_double_precision) {
  for (const char* address : kBenchScenes) {
    const Walk walk(address);
    AccumulatorOnDevice device(kLongest);
    AccumulatorOnCpu cpu(kLongest);
    ReferenceAccumulation reference(kLongest);
    std::size_t surfaces = 0, contested = 0;
    for (std::uint32_t frame = 0; frame < 8; ++frame) {
      const GeometryBuffer g = walk.geometry(frame);
      const FrameLight light(g, frame);
      reference.run(g, frame, light.indirect, light.from_many);
      const Accumulated found = device.run(g, frame, light);
      const Comparison of_device = compare_with(reference, g, found);
      EXPECT_EQ(of_device.beyond, 0u) << address << ", frame " << frame;
      EXPECT_EQ(compare_with(reference, g, cpu.run(g, frame, light)).beyond, 0u) << address << ", frame " << frame;
      surfaces += of_device.surfaces, contested += of_device.contested;
      if (frame > 0) {
        EXPECT_GT(of_device.history, of_device.surfaces / 2) << "a walk that goes on from what it saw";
      }
      EXPECT_EQ(found.counts.not_finite, 0u) << "the sky's sums are nobody's";
    }
    std::printf("%s: rounding decides for %zu of %zu pixels\n", address, contested, surfaces);
    EXPECT_LE(contested, surfaces / 1000);  // set apart, and counted
  }
}

// Fractions of surfaces that are not the reference in the last frame of a walk, with a mistake in each frame.
template <class Mistake>
double beyond_after(AccumulatorOnDevice& device, const Mistake& mistake) {
  const Walk walk(kBenchScenes[0]);
  ReferenceAccumulation reference(kLongest);
  Comparison last;
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    GeometryBuffer g = walk.geometry(frame);
    const FrameLight light(g, frame);
    reference.run(g, frame, light.indirect, light.from_many);
    mistake(g, frame);
    last = compare_with(reference, g, device.run(g, frame, light));
  }
  return double(last.beyond) / double(last.surfaces);
}

TEST(AccumulationOnTheDevice, with_another_history_or_weight_is_caught) {
  const auto none = [](GeometryBuffer&, std::uint32_t) {};
  AccumulatorOnDevice right(kLongest), longer(kLongest + 1), other_weight(kLongest, 7), forgetful(kLongest);
  AccumulatorOnDevice elsewhere(kLongest), in_the_middle(kLongest);
  EXPECT_EQ(beyond_after(right, none), 0.0);
  EXPECT_EQ(beyond_after(longer, none), 0.0) << "no mean is as long yet";
  EXPECT_GT(beyond_after(other_weight, none), 0.9) << "49 for 64";
  EXPECT_GT(beyond_after(forgetful, [&](GeometryBuffer&, std::uint32_t) { forgetful.pass.forget(); }), 0.5);
  EXPECT_GT(beyond_after(elsewhere,
                         [](GeometryBuffer& g, std::uint32_t frame) {
                           if (frame == 2) g.camera.eye = g.camera.eye + g.camera.up * 0.01f;
                         }),
            0.3)
      << "the past camera a centimetre too high";
  EXPECT_GT(beyond_after(in_the_middle, [](GeometryBuffer& g, std::uint32_t) { g.sub_pixel_x = 0.5f; }), 0.3)
      << "samples taken for those in the middle of their pixels";
}

// Frames of the same geometry, whatever their number: every pixel is the mean of what it had.
TEST(AccumulationOnTheDevice, of_a_view_that_stands_still_is_the_mean_of_its_frames) {
  constexpr std::uint32_t kFrames = 6;
  const GeometryBuffer g = Walk(kBenchScenes[1]).geometry(0);
  AccumulatorOnDevice device(100);
  Accumulated found;
  std::vector<std::array<double, 6>> sum(g.pixel_count());
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const FrameLight light(g, frame);
    found = device.run(g, 1, light);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        sum[i][c] += light.indirect.diffuse[c][i], sum[i][c + 3] += light.from_many.specular[c][i];
    }
  }
  // Each frame rounds the weighted light (3), a difference, a quotient (2.5) and a product of it, and a sum; and
  // nothing that is rounded is larger than all the light together.
  constexpr double kRounded = kFrames * (3 + 1 + 2.5 + 1 + 1) * 0x1p-23;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (g.depth[i] == kNoSurface) continue;
    ASSERT_EQ(found.frames[i], float(kFrames));
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(found.indirect[i].diffuse[c], sum[i][c] / kFrames, kRounded * sum[i][c]) << "pixel " << i;
      ASSERT_NEAR(found.many[i].specular[c], sum[i][c + 3] / kFrames, kRounded * sum[i][c + 3]) << "pixel " << i;
    }
  }
}

TEST(AccumulationOnTheDevice, starts_anew_where_nothing_was_seen) {
  const Walk walk(kBenchScenes[0]);
  AccumulatorOnDevice device(kLongest);
  ReferenceAccumulation reference(kLongest);
  std::size_t anew = 0, goes_on = 0;
  for (const std::uint32_t frame : {0u, 1u}) {
    const GeometryBuffer g = walk.geometry(frame, 0.8f);  // behind the boxes, and beside what was on the screen
    const FrameLight light(g, frame);
    reference.run(g, frame, light.indirect, light.from_many);
    const Accumulated found = device.run(g, frame, light);
    for (std::size_t i = 0; frame == 1 && i < g.pixel_count(); ++i) {
      const ReferenceAccumulation::Pixel& right = reference.pixels()[i];
      if (g.depth[i] == kNoSurface || right.contested) continue;
      const bool fresh = right.diffuse_frames.value == 1;
      ASSERT_EQ(found.frames[i] == 1.0f, fresh) << "pixel " << i;
      (fresh ? anew : goes_on) += 1;
      if (!fresh) continue;
      // The frame's own light: less nothing, by one frame, on top of nothing.
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(found.indirect[i].diffuse[c], light.indirect.diffuse[c][i],
                    8 * 0x1p-23 * light.indirect.diffuse[c][i]);
      }
    }
  }
  EXPECT_GT(anew, 30u);
  EXPECT_GT(goes_on, 300u);
}

TEST(AccumulationOnTheDevice, of_another_size_or_other_lights_starts_anew) {
  AccumulatorOnDevice device(kLongest);
  std::uint64_t number = 0;
  for (const auto& [width, height] : {std::pair{70u, 45u}, std::pair{33u, 5u}, std::pair{1u, 1u}, std::pair{5u, 41u}}) {
    const SyntheticRoom room = make_synthetic_room(width, height);
    const GeometryBuffer& g = room.geometry;
    const auto most = [&](const Accumulated& found) {
      return *std::max_element(found.frames.begin(), found.frames.end());
    };
    const bool any = std::any_of(g.depth.begin(), g.depth.end(), [](float d) { return d != kNoSurface; });
    const FrameLight light(g, 1);
    EXPECT_EQ(most(device.run(g, ++number, light)), any ? 1.0f : 0.0f) << width << "x" << height;
    EXPECT_EQ(most(device.run(g, ++number, light)), any ? 2.0f : 0.0f);
    EXPECT_EQ(most(device.run(g, ++number, light, /*with_many=*/false)), any ? 1.0f : 0.0f);
    EXPECT_EQ(most(device.run(g, number, light, /*with_many=*/false)), any ? 2.0f : 0.0f);
  }
}

TEST(AccumulationOnTheDevice, leaves_out_and_counts_light_that_is_not_finite) {
  const GeometryBuffer g = Walk(kBenchScenes[0]).geometry(0);
  AccumulatorOnDevice device(kLongest);
  AccumulatorOnCpu cpu(kLongest);
  for (const std::uint32_t first_bad : {0u, 1u}) {  // without a mean to go on from, and with one
    device.pass.forget();
    cpu = AccumulatorOnCpu(kLongest);
    for (std::uint32_t frame = 0; frame <= first_bad; ++frame) {
      FrameLight light(g, frame);
      std::uint32_t bad = 0, bad_many = 0;
      for (std::size_t i = 5; i < g.pixel_count() && frame == first_bad; i += 17) {
        if (g.depth[i] == kNoSurface) continue;
        const float value = i % 3 == 0 ? kNan : i % 3 == 1 ? kInfinite : -kInfinite;
        (i % 2 == 0 ? light.glossy : light.many)[i].specular[i % 3] = value;
        (i % 2 == 0 ? bad : bad_many) += 1;
      }
      light.unpack(g);
      const Accumulated found = device.run(g, 1, light), right = cpu.run(g, 1, light);
      EXPECT_EQ(found.counts.not_finite, bad);
      EXPECT_EQ(found.counts.many_not_finite, bad_many);
      EXPECT_TRUE(frame < first_bad || (bad > 20 && bad_many > 20));
      for (std::size_t i = 0; i < g.pixel_count(); ++i) {
        ASSERT_EQ(found.frames[i], right.frames[i]) << "pixel " << i;
        if (g.depth[i] == kNoSurface) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(std::isfinite(found.many[i].specular[c]), std::isfinite(right.many[i].specular[c]));
          ASSERT_EQ(std::isfinite(found.indirect[i].specular[c]), std::isfinite(right.indirect[i].specular[c]));
        }
      }
    }
  }
}

// The filter takes the means for sums that have their weight.
TEST(AccumulationOnTheDevice, is_what_the_filter_reads) {
  const GeometryBuffer g = Walk(kBenchScenes[0]).geometry(0);
  AccumulatorOnDevice device(kLongest);
  const FrameLight light(g, 1);
  device.run(g, 1, light);
  const std::size_t pixels = g.pixel_count();
  const gpu::Buffer records = device.bench.send(pixel_records(g)), counts = device.bench.make(sizeof(FilterCounts));
  const gpu::Buffer filtered = device.bench.make(pixels * sizeof(PixelLight));
  const auto filter = [&](std::uint32_t interleave, bool weighed) {
    const Result<DeviceFilterPass> pass = DeviceFilterPass::create(device.bench.device(), {8, 8}, interleave);
    EXPECT_TRUE(pass.has_value());
    gpu::CommandList list = device.bench.list();
    list.begin_pass("filtering");
    pass->record(list, {&records, device.pass.indirect(), nullptr, &filtered, &counts, weighed}, g);
    device.bench.run(list);
    std::vector<float> values;
    for (const PixelLight& l : device.bench.receive<PixelLight>(filtered, pixels)) {
      values.insert(values.end(), l.diffuse, l.diffuse + 3);
      values.insert(values.end(), l.specular, l.specular + 3);
    }
    return values;
  };
  EXPECT_EQ(filter(kInterleave, true), filter(1, false));
  EXPECT_NE(filter(kInterleave, true), filter(kInterleave, false)) << "weighed twice";
}

TEST(AccumulationOnTheDevice, gives_validation_nothing_to_say) {
  AccumulatorOnDevice device(kLongest, kInterleave, /*validated=*/true);  // a message fails the run
  const SyntheticRoom room = make_synthetic_room(33, 5);
  for (std::uint32_t frame = 0; frame < 3; ++frame) device.run(room.geometry, frame, FrameLight(room.geometry, frame));
}

}  // namespace
}  // namespace luciole::test
