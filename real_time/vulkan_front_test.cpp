// SPDX-License-Identifier: Apache-2.0
// What the device makes of a view is what the CPU's passes make of it, but where rounding decides which surface a ray
// meets.
#include "real_time/vulkan_front.h"

#include <algorithm>
#include <cmath>

#include "equations/cpp/double.h"
#include "gpu/test_device.h"
#include "real_time/direct_light/direct_light.h"
#include "real_time/direct_light/direct_sources.h"
#include "real_time/light_range/subset_layout.h"
#include "real_time/vulkan_test_front.h"

namespace luciole::test {
namespace {

constexpr double kU = 0x1p-24;

Vec3 at(const Plane3& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }
f64::real3 wide(Vec3 v) { return {double(v.x), double(v.y), double(v.z)}; }
f64::real3 wide(const float (&v)[3]) { return {double(v[0]), double(v[1]), double(v[2])}; }

// The plain box gets lights of the other kinds.
PrimaryLights primaries_for(const std::string& address, const PrimaryLights& own) {
  if (address != "recipe:cornell") return own;
  PunctualLight spot = own.at(0), sun = own.at(0);
  spot.kind = PunctualLight::Kind::spot, spot.cos_outer = 0.6f, spot.cos_inner = 0.9f;
  spot.direction = normalize(Vec3(0.2f, -1, -0.3f));
  sun.kind = PunctualLight::Kind::directional, sun.direction = normalize(Vec3(0.1f, -0.2f, -1));
  return {own.at(0), spot, sun};
}

// A view by both: the CPU's is `front`.
struct Seen {
  Seen(const std::string& address, const Settings& wanted)
      : settings(wanted), front(address, wanted), rays(std::move(*RayScene::create(front.scene))) {
    front.primaries = primaries_for(address, front.primaries);
    maps.emplace(front.primaries, rays.bounds(), settings.vpls);
    request = {1, &rays, &*maps, {settings.vpl_seed, false, 0}, front.primaries, {}};
    request.view = {front.scene->cameras.at(0), settings.width, settings.height};
    device = gpu::test::open_device();
    Result<VulkanFront> made = VulkanFront::create(*device, settings);
    EXPECT_TRUE(made.has_value()) << made.error().message;
    passes.emplace(std::move(*made));
    Result<DeviceScene> sent = DeviceScene::create(*device, *front.scene, *build_hierarchy(*front.scene));
    EXPECT_TRUE(sent.has_value()) << sent.error().message;
    scene.emplace(std::move(*sent));
    const Status rendered = passes->render(*device, *scene, request, on_device);
    EXPECT_TRUE(rendered.has_value()) << rendered.error().message;
    const Status read = read_back(*device, on_device, request.view, {geometry, vpls, direct});
    EXPECT_TRUE(read.has_value()) << read.error().message;
  }

  Settings settings;
  Front front;
  RayScene rays;
  std::optional<ReflectiveShadowMaps> maps;
  ViewRequest request;
  std::unique_ptr<gpu::Device> device;
  std::optional<DeviceScene> scene;
  ViewOnDevice on_device;
  std::optional<VulkanFront> passes;
  GeometryBuffer geometry;
  VirtualPointLights vpls;
  Plane3 direct;
};

const char* const kViews[] = {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1", "recipe:gallery?detail=0.05",
                              "recipe:cornell"};

struct LightComparison {
  std::size_t same = 0, apart = 0;  // keys whose lights are one; and that only one has, or that lie elsewhere
};

double scatter(Vec3 a, Vec3 b) { return double(length(a - b)); }

// Both rays err a few units of their own reach, which a grazing angle stretches; the rest follows.
// A spot's ramp is squared, so that at its dark end, a share t^2 of the most, the direction's error counts 1/t times.
bool is_one_light(const VirtualPointLights& a, std::size_t i, const VirtualPointLights& b, std::size_t j, double reach,
                  double most_flux) {
  const Vec3 normal = at(a.geometric_normal, i), incident = at(a.incident, i);
  const double cosine = std::max(double(dot(normal, incident)), 1e-4);
  const double moved = 64 * kU * reach / cosine, relative = 64 * kU * (1 + reach / cosine);
  const double flux = double(length(at(a.flux, i)));
  return scatter(at(a.position, i), at(b.position, j)) <= moved && scatter(incident, at(b.incident, j)) <= 16 * kU &&
         scatter(normal, at(b.geometric_normal, j)) <= 1e-3 &&  // flat, or the next triangle of a curved surface
         scatter(at(a.flux, i), at(b.flux, j)) <= 64 * kU * (flux + std::sqrt(flux * most_flux)) &&
         std::abs(double(a.area[i]) / double(b.area[j]) - 1) <= relative / cosine;
}

LightComparison compare_lights(const VirtualPointLights& cpu, const VirtualPointLights& device, double reach) {
  LightComparison c;
  std::size_t j = 0;
  double most_flux = 0;
  for (std::size_t i = 0; i < cpu.size(); ++i) most_flux = std::max(most_flux, double(length(at(cpu.flux, i))));
  for (std::size_t i = 0; i < cpu.size(); ++i) {
    while (j < device.size() && device.key[j] < cpu.key[i]) ++j, ++c.apart;
    const bool both = j < device.size() && device.key[j] == cpu.key[i];
    const bool same = both && is_one_light(cpu, i, device, j, reach, most_flux);
    c.same += same, c.apart += !same;
    j += both;
  }
  c.apart += device.size() - j;
  return c;
}

double reach_of(const Scene& scene) {
  const Bounds bounds = scene.bounds();
  return double(bounds.diagonal() + length(max(abs(bounds.low), abs(bounds.high))));
}

TEST(LightsOfTheDevice, are_the_cpus) {
  for (const char* address : kViews) {
    Settings settings = small_settings();
    settings.vpls = 2501;
    for (const std::uint64_t seed : {0u, 3u}) {
      settings.vpl_seed = seed;
      const Seen seen(address, settings);
      std::vector<SurfaceTexel> texels;
      seen.maps->render(seen.rays, seen.request.sampling, texels);
      VirtualPointLights cpu;
      place_virtual_point_lights(texels, cpu);
      const LightComparison c = compare_lights(cpu, seen.vpls, reach_of(*seen.front.scene));
      EXPECT_LE(c.apart, 1 + cpu.size() / 100) << address << ", " << c.same << " are the same";
      std::printf("%s, seed %d: %zu of %zu lights are one, %zu apart\n", address, int(seed), c.same, cpu.size(),
                  c.apart);
      // The control: other places in the texels.
      seen.maps->render(seen.rays, {seed + 1, false, 0}, texels);
      place_virtual_point_lights(texels, cpu);
      EXPECT_LT(compare_lights(cpu, seen.vpls, reach_of(*seen.front.scene)).same, 1 + cpu.size() / 100) << address;
    }
  }
}

TEST(LightsOfTheDevice, stand_in_the_order_of_both_engines) {
  for (const std::uint32_t interleave : {1u, 2u, 8u}) {
    const Settings settings = small_settings(interleave);
    const Seen seen("recipe:cornell", settings);
    const SubsetLayout layout = subset_layout(seen.vpls.key, interleave);
    ASSERT_EQ(seen.on_device.entries, layout.light.size());
    EXPECT_EQ(seen.on_device.vpl_count, seen.vpls.size());
    EXPECT_EQ(seen.on_device.longest_subset, *std::max_element(layout.count.begin(), layout.count.end()));
    gpu::CommandList list = gpu::test::make_list(*seen.device);
    const std::size_t lights = layout.light.size(), subsets = layout.begin.size();
    const gpu::Buffer records =
        gpu::test::make_buffer(*seen.device, lights * sizeof(VplRecord), gpu::BufferUse::readback);
    const gpu::Buffer ranges =
        gpu::test::make_buffer(*seen.device, subsets * sizeof(SubsetRange), gpu::BufferUse::readback);
    list.begin_pass("transfer");
    list.copy(seen.on_device.vpls, records, lights * sizeof(VplRecord));
    list.copy(seen.on_device.subsets, ranges, subsets * sizeof(SubsetRange));
    ASSERT_TRUE(list.run().has_value());
    for (std::size_t entry = 0; entry < lights; ++entry) {
      const VplRecord& r = records.as<VplRecord>()[entry];
      ASSERT_EQ(r.is_light != 0, layout.light[entry] != kNoLight) << entry;
      if (r.is_light == 0) continue;
      ASSERT_EQ(r.key, seen.vpls.key[layout.light[entry]]) << entry;
    }
    for (std::size_t s = 0; s < subsets; ++s) {
      EXPECT_EQ(ranges.as<SubsetRange>()[s].begin, layout.begin[s]);
      EXPECT_EQ(ranges.as<SubsetRange>()[s].count, layout.count[s]);
    }
  }
}

// Direct light of one pixel in double precision, shadows by the CPU's rays.
f64::real3 direct_in_double(const Seen& seen, const PrimaryLights& lights, std::size_t i, bool shadows) {
  const GeometryBuffer& g = seen.geometry;
  f64::real3 sum;
  for (std::size_t l = 0; l < lights.size(); ++l) {
    const DirectSource from = direct_sources(lights)[l];
    const f64::PunctualSource source{from.sun != 0,     wide(from.position), wide(from.direction),
                                     wide(from.colour), double(from.scale),  double(from.offset)};
    const f64::SurfaceBrdf brdf{wide(at(g.diffuse_albedo, i)), wide(at(g.f0, i)), double(g.f90[i]),
                                double(g.ggx_alpha[i])};
    const f64::real3 position = wide(at(g.position, i));
    const f64::real3 radiance =
        f64::reflected_from_source(source, brdf, position, wide(at(g.geometric_normal, i)), wide(at(g.normal, i)),
                                   normalize(wide(g.camera.eye) - position));
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
    const Vec3 origin = seen.rays.offset_from_surface(at(g.position, i), at(g.geometric_normal, i));
    if (from.sun != 0) {
      packet.set(0, origin, -lights[l].direction, 0, kNoSurface);
    } else {
      packet.set(0, origin, lights[l].position - origin, 0, 1);
    }
    if (!shadows || seen.rays.occluded(packet, Coherence::incoherent) == 0) sum = sum + radiance;
  }
  return sum;
}

struct DirectErrors {
  double largest = 0;              // relative to the pixel's largest channel, of pixels that are not apart
  std::size_t lit = 0, apart = 0;  // apart: a light more or less
};

DirectErrors errors_of(const Seen& seen, const Plane3& found, bool shadows = true) {
  DirectErrors e;
  const PrimaryLights lights = direct_lights(*seen.front.scene, seen.request.lights);
  for (std::size_t i = 0; i < seen.geometry.pixel_count(); ++i) {
    if (seen.geometry.depth[i] == kNoSurface) continue;
    const f64::real3 right = direct_in_double(seen, lights, i, shadows);
    const double most = std::max({right.x, right.y, right.z, 1e-30});
    const f64::real3 off = abs(wide(at(found, i)) - right);
    const double error = std::max({off.x, off.y, off.z}) / most;
    e.lit += most > 1e-30;
    if (error > 0.01) {
      ++e.apart;
    } else {
      e.largest = std::max(e.largest, error);
    }
  }
  return e;
}

// On the same geometry buffer, that of the device.
TEST(DirectLightOfTheDevice, is_the_cpus) {
  for (const char* address : kViews) {
    const Seen seen(address, small_settings());
    const Plane3 cpu = direct_light(seen.rays, seen.geometry, seen.request.lights, seen.settings.isa);
    const DirectErrors by_cpu = errors_of(seen, cpu), by_device = errors_of(seen, seen.direct);
    EXPECT_LE(by_device.apart, 1 + by_device.lit / 200) << address;
    // SPIR-V allows operations 5 times the error of C++'s.
    EXPECT_LE(by_device.largest, 5 * std::max(by_cpu.largest, kU)) << address;
    EXPECT_GT(by_device.lit, seen.geometry.pixel_count() / 10) << address;
    // The control: without shadows.
    EXPECT_GT(errors_of(seen, seen.direct, false).apart, 10 * (1 + by_device.apart)) << address;
  }
}

}  // namespace
}  // namespace luciole::test
