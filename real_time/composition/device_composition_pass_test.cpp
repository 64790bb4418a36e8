// SPDX-License-Identifier: Apache-2.0
// The picture that a device composes is the CPU's.
#include "real_time/composition/device_composition_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "real_time/composition/composition.h"
#include "real_time/device_bench.h"
#include "real_time/filtering/synthetic_room.h"
#include "real_time/not_finite.h"

namespace luciole::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
constexpr float kWeight = 64;  // of 8x8 interleaving

// All the light of a frame, as the CPU has it and as the device has it.
struct Light {
  std::vector<PixelSums> diffuse, glossy, many_sums;
  Plane3 direct;
  Unpacked unpacked;

  Light(const GeometryBuffer& g, std::uint32_t seed) : Light(g, MadeUpLight(seed)) {}
  Light(const GeometryBuffer& g, MadeUpLight make)
      : diffuse(make.sums(g, 1 / kWeight)),
        glossy(make.sums(g, 1 / kWeight)),
        many_sums(make.sums(g, 1 / kWeight)),
        direct(make.plane3(g.pixel_count())),
        unpacked(g, diffuse, glossy, many_sums, kWeight) {}

  void unpack_again(const GeometryBuffer& g) { unpacked = Unpacked(g, diffuse, glossy, many_sums, kWeight); }
};

struct Picture {
  std::vector<Vec3> pixels;
  std::uint64_t not_finite = 0;
};

Picture composed_on_cpu(const GeometryBuffer& g, const Light& light) {
  Frame frame;
  frame.width = g.width, frame.height = g.height;
  const ShadedRadiance& radiance = light.unpacked.out.radiance;
  compose({g, light.direct, radiance.indirect, radiance.from_many, radiance, light.unpacked.out, {}, {}}, {}, frame);
  const std::uint64_t not_finite = blacken_not_finite(frame.picture);
  return {std::move(frame.picture), not_finite};
}

std::vector<PixelColour> colours(const Plane3& planes) {
  std::vector<PixelColour> out(planes[0].size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {{planes[0][i], planes[1][i], planes[2][i]}};
  return out;
}

std::vector<PixelLight> filtered(const Radiance& light) {
  std::vector<PixelLight> out(light.diffuse[0].size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      out[i].diffuse[c] = light.diffuse[c][i], out[i].specular[c] = light.specular[c][i];
  }
  return out;
}

// What of the light the device gets, and with which mistake.
struct Parts {
  bool filtered = false, direct = true, glossy = true, many = true, emission = true;
  float weight = kWeight;
};

class ComposerOnDevice {
 public:
  explicit ComposerOnDevice(bool validated = false) : bench_(validated) {
    Result<DeviceCompositionPass> pass = DeviceCompositionPass::create(bench_.device());
    EXPECT_TRUE(pass.has_value()) << pass.error().message;
    pass_ = std::move(*pass);
  }

  Picture run(const GeometryBuffer& g, const Light& light, const Parts& parts = {}) {
    const ShadedRadiance& radiance = light.unpacked.out.radiance;
    const gpu::Buffer sent[] = {bench_.send(pixel_records(g)),
                                bench_.send(surface_records(g)),
                                bench_.send(colours(light.direct)),
                                bench_.send(filtered(radiance.indirect)),
                                bench_.send(filtered(radiance.from_many)),
                                bench_.send(light.diffuse),
                                bench_.send(light.glossy),
                                bench_.send(light.many_sums)};
    const gpu::Buffer picture = bench_.make(g.pixel_count() * sizeof(PixelColour));
    const gpu::Buffer counts = bench_.make(sizeof(CompositionCounts));
    const auto if_wanted = [&](bool wanted, std::size_t i) { return wanted ? &sent[i] : nullptr; };
    gpu::CommandList list = bench_.list();
    list.begin_pass("composition");
    pass_.record(list,
                 {.pixels = &sent[0],
                  .surfaces = &sent[1],
                  .direct = if_wanted(parts.direct, 2),
                  .indirect = if_wanted(parts.filtered, 3),
                  .many = if_wanted(parts.filtered && parts.many, 4),
                  .sums = if_wanted(!parts.filtered, 5),
                  .more_sums = if_wanted(!parts.filtered && parts.glossy, 6),
                  .many_sums = if_wanted(!parts.filtered && parts.many, 7),
                  .weight = parts.weight,
                  .with_emission = parts.emission,
                  .picture = &picture,
                  .counts = &counts},
                 g.width, g.height);
    bench_.run(list);
    Picture made;
    for (const PixelColour& c : bench_.receive<PixelColour>(picture, g.pixel_count()))
      made.pixels.emplace_back(c.rgb[0], c.rgb[1], c.rgb[2]);
    made.not_finite = bench_.receive<CompositionCounts>(counts, 1)[0].not_finite;
    return made;
  }

 private:
  DeviceBench bench_;
  DeviceCompositionPass pass_;
};

// What both may differ by. No term goes through more than six roundings (weight, sum of two kinds, albedo, and three
// sums), each of 2^-24 of what it rounds on the CPU, which rounds to nearest, and of 2^-23 on a device, which may round
// either way; and what it rounds is not more than all terms together. A device may take what is below the least normal
// number for zero, in each of the six.
double tolerance(const GeometryBuffer& g, const Light& light, std::size_t i, std::size_t c) {
  double size = std::abs(double(light.direct[c][i])) + std::abs(double(g.emission[c][i]));
  if (g.depth[i] != kNoSurface) {
    for (const std::vector<PixelSums>* sums : {&light.diffuse, &light.glossy, &light.many_sums}) {
      size += kWeight * (std::abs(double((*sums)[i].diffuse[c])) * double(g.diffuse_albedo[c][i]) +
                         std::abs(double((*sums)[i].specular[c])));
    }
  }
  return 6 * ((0x1p-24 + 0x1p-23) * size + double(std::numeric_limits<float>::min()));
}

double channel(Vec3 v, std::size_t c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

// Pixels that differ by more than rounding, and those with the same bits.
struct Comparison {
  std::size_t pixels = 0, beyond = 0, same_bits = 0;
};
Comparison compare_pictures(const GeometryBuffer& g, const Light& light, const Picture& a, const Picture& b) {
  Comparison result;
  for (std::size_t i = 0; i < g.pixel_count(); ++i) {
    bool beyond = false, same = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const double apart = std::abs(channel(a.pixels[i], c) - channel(b.pixels[i], c));
      same = same && apart == 0;
      beyond = beyond || (apart > 0 && !(apart <= tolerance(g, light, i, c)));
    }
    ++result.pixels, result.beyond += beyond, result.same_bits += same;
  }
  return result;
}

TEST(CompositionOnTheDevice, is_the_cpus_picture) {
  ComposerOnDevice composer;
  for (const char* address : kBenchScenes) {
    const BenchScene bench(address);
    const GeometryBuffer g = geometry_of(bench.rays, bench.scene->cameras.at(0), 70, 45);
    const Light light(g, 1);
    const Picture cpu = composed_on_cpu(g, light);
    for (const bool of_filter : {false, true}) {
      const Picture device = composer.run(g, light, {.filtered = of_filter});
      const Comparison c = compare_pictures(g, light, device, cpu);
      std::printf("%s, %s light: %zu of %zu pixels have the CPU's bits\n", address, of_filter ? "filtered" : "noisy",
                  c.same_bits, c.pixels);
      EXPECT_EQ(c.beyond, 0u) << address;
      EXPECT_EQ(device.not_finite, 0u) << "the sky's sums are nobody's";
    }
  }
}

TEST(CompositionOnTheDevice, of_any_size_is_the_cpus_picture) {
  ComposerOnDevice composer;
  for (const auto& [width, height] : {std::pair{1u, 1u}, std::pair{33u, 5u}, std::pair{31u, 3u}, std::pair{5u, 41u}}) {
    SyntheticRoom room = make_synthetic_room(width, height);
    GeometryBuffer& g = room.geometry;
    MadeUpLight colours(3);
    g.diffuse_albedo = colours.plane3(g.pixel_count()), g.emission = colours.plane3(g.pixel_count());
    const Light light(g, 2);
    EXPECT_EQ(compare_pictures(g, light, composer.run(g, light), composed_on_cpu(g, light)).beyond, 0u)
        << width << "x" << height;
  }
}

// The tolerance tells every part of the light from its absence.
TEST(CompositionOnTheDevice, with_a_part_forgotten_is_caught) {
  ComposerOnDevice composer;
  SyntheticRoom room = make_synthetic_room(70, 45);
  GeometryBuffer& g = room.geometry;
  MadeUpLight colours(5);
  g.diffuse_albedo = colours.plane3(g.pixel_count()), g.emission = colours.plane3(g.pixel_count());
  const Light light(g, 4);
  const Picture cpu = composed_on_cpu(g, light);
  const auto beyond = [&](const Parts& parts) {
    const Comparison c = compare_pictures(g, light, composer.run(g, light, parts), cpu);
    return double(c.beyond) / double(c.pixels);
  };
  EXPECT_EQ(beyond({}), 0.0);
  EXPECT_GT(beyond({.direct = false}), 0.9);
  EXPECT_GT(beyond({.emission = false}), 0.9);
  EXPECT_GT(beyond({.glossy = false}), 0.5);
  EXPECT_GT(beyond({.many = false}), 0.5);
  EXPECT_GT(beyond({.filtered = true, .many = false}), 0.5);
  EXPECT_GT(beyond({.weight = 1}), 0.5) << "the weight forgotten";
  EXPECT_GT(beyond({.weight = kWeight - 1}), 0.5) << "63 for 64";
  GeometryBuffer white = g;
  for (Plane& plane : white.diffuse_albedo) std::fill(plane.begin(), plane.end(), 1.0f);
  const Comparison c = compare_pictures(g, light, composer.run(white, light), cpu);
  EXPECT_GT(double(c.beyond) / double(c.pixels), 0.5) << "the albedo forgotten";
}

// A layer is a picture of some of the light.
TEST(CompositionOnTheDevice, makes_the_layer_of_indirect_light) {
  const BenchScene bench(kBenchScenes[0]);
  const GeometryBuffer g = geometry_of(bench.rays, bench.scene->cameras.at(0), 70, 45);
  const Light light(g, 6);
  Frame frame;
  frame.width = g.width, frame.height = g.height;
  const ShadedRadiance& radiance = light.unpacked.out.radiance;
  compose({g, light.direct, radiance.indirect, radiance.from_many, radiance, light.unpacked.out, {}, {}}, {"indirect"},
          frame);
  const Picture layer{frame.layers.colours("indirect"), 0};
  ComposerOnDevice composer;
  const Picture found = composer.run(g, light, {.direct = false, .many = false, .emission = false});
  EXPECT_EQ(compare_pictures(g, light, found, layer).beyond, 0u);
}

TEST(CompositionOnTheDevice, blackens_and_counts_what_is_not_finite) {
  const BenchScene bench(kBenchScenes[1]);
  const GeometryBuffer g = geometry_of(bench.rays, bench.scene->cameras.at(0), 70, 45);
  Light light(g, 7);
  std::uint32_t planted = 0;
  for (std::size_t i = 3; i < g.pixel_count(); i += 29, ++planted) {
    const float value = planted % 3 == 0 ? kNan : planted % 3 == 1 ? kInfinite : -kInfinite;
    if (planted % 4 == 0) light.diffuse[i].diffuse[planted % 3] = value;
    if (planted % 4 == 1) light.glossy[i].specular[planted % 3] = value;
    if (planted % 4 == 2) light.many_sums[i].diffuse[planted % 3] = value;
    if (planted % 4 == 3) light.direct[planted % 3][i] = value;
  }
  light.unpack_again(g);
  const Picture cpu = composed_on_cpu(g, light);
  ComposerOnDevice composer;
  for (const bool of_filter : {false, true}) {
    const Picture device = composer.run(g, light, {.filtered = of_filter});
    EXPECT_GT(device.not_finite, planted / 2);
    EXPECT_EQ(device.not_finite, cpu.not_finite);
    EXPECT_EQ(compare_pictures(g, light, device, cpu).beyond, 0u);
    for (std::size_t i = 0; i < g.pixel_count(); ++i) {
      ASSERT_EQ(is_black(device.pixels[i]), is_black(cpu.pixels[i])) << "pixel " << i;
    }
  }
}

TEST(CompositionOnTheDevice, gives_validation_nothing_to_say) {
  const SyntheticRoom room = make_synthetic_room(33, 5);
  ComposerOnDevice composer(/*validated=*/true);
  composer.run(room.geometry, Light(room.geometry, 8));  // a message fails the run
}

}  // namespace
}  // namespace luciole::test
