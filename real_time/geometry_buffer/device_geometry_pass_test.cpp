// SPDX-License-Identifier: Apache-2.0
// The geometry buffer of a device is the CPU's: the same triangles but where rounding decides, and there every quantity
// within what rounding can do.
#include "real_time/geometry_buffer/device_geometry_pass.h"

#include <cstdlib>

#include "gpu/test_device.h"
#include "real_time/device_scene/compare_hits.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "real_time/geometry_buffer/pixel_block.h"
#include "scene/load_scene.h"
#include "scene/recipes/recipes.h"

namespace luciole::test {
namespace {

constexpr double kU = 0x1p-24;
const Vec2 kSubPixel{0.3f, 0.6f};

DeviceView view_of(const Scene& scene) { return {scene.cameras.at(0), 70, 45, kSubPixel}; }

// What the device made of a view.
struct DeviceFrame {
  GeometryBuffer buffer;
  std::vector<RayAnswer> hits;  // complete: those that the buffer stands for
  Status status = Done{};
};

DeviceFrame on_device(gpu::Device& device, const Scene& scene, const DeviceView& view) {
  const Result<Hierarchy> hierarchy = build_hierarchy(scene);
  const Result<DeviceScene> placed = DeviceScene::create(device, scene, *hierarchy);
  const Result<DeviceGeometryPass> pass = DeviceGeometryPass::create(device);
  const Result<GeometryOnDevice> target = GeometryOnDevice::create(device, view.width, view.height);
  EXPECT_TRUE(placed.has_value() && pass.has_value() && target.has_value());
  gpu::CommandList list = gpu::test::make_list(device);
  pass->record(list, *placed, view, *target);
  const std::size_t pixels = std::size_t(view.width) * view.height;
  const gpu::Buffer received = gpu::test::make_buffer(device, pixels * sizeof(SurfaceRecord), gpu::BufferUse::readback);
  list.begin_pass("transfer");
  list.copy(target->surfaces, received, pixels * sizeof(SurfaceRecord));
  EXPECT_TRUE(list.run().has_value());
  DeviceFrame frame;
  for (const SurfaceRecord& s : gpu::test::values_in<SurfaceRecord>(received, pixels)) {
    frame.hits.push_back({s.mesh, s.triangle, s.u, s.v, 0, 1, 0});
  }
  frame.status = read_back(device, *target, view, frame.buffer);
  return frame;
}

std::vector<RayQuery> rays_of(const DeviceView& view) {
  const ScreenRays screen(view.camera, view.width, view.height, view.sub_pixel);
  std::vector<RayQuery> rays;
  for (std::uint32_t y = 0; y < view.height; ++y) {
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const Vec3 d = screen.direction(x, y);
      rays.push_back({{screen.eye.x, screen.eye.y, screen.eye.z}, {d.x, d.y, d.z}, 0, kNoSurface});
    }
  }
  return rays;
}

// How far rounding may move each quantity of a pixel, to first order, from one engine to the other.
struct Tolerances {
  double position, geometric_normal, normal, reflection, emission;
};

// Of a look-up: coordinates of size s in t texels err a few s 2^-24 t, and what the weights err; neighbouring texels
// may be black and white, and so may levels.
double of_look_up(const Scene& scene, const Mesh& mesh, const TextureSlot& slot, std::uint32_t triangle, double weights,
                  double level) {
  if (slot.texture < 0 || mesh.uv[slot.uv_set].empty()) return 0;
  const MipImage::Level& finest = scene.textures[static_cast<std::size_t>(slot.texture)].image->levels[0];
  double size = 1;
  for (int corner = 0; corner < 3; ++corner) {
    const Vec2 uv = slot.transform(mesh.uv[slot.uv_set][mesh.indices[3 * std::size_t(triangle) + std::size_t(corner)]]);
    size = std::max({size, std::abs(double(uv.x)), std::abs(double(uv.y))});
  }
  return (8 * kU + 4 * weights) * size * std::max(finest.width, finest.height) + level;
}

Tolerances tolerances_of(const Scene& scene, const RayQuery& ray, const RayAnswer& hit) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Material& material = scene.materials[mesh.material];
  const std::uint32_t* index = &mesh.indices[3 * std::size_t(hit.triangle)];
  const Double3 a(mesh.positions[index[0]]), b(mesh.positions[index[1]]), c(mesh.positions[index[2]]);
  const Double3 normal = (b - a).cross(c - a), d(ray.direction);
  const double edge = std::max({(b - a).length(), (c - b).length(), (a - c).length()}), area = normal.length();
  const double cosine = std::abs(normal.dot(d)) / area / d.length();
  const ExactHit exact = exact_hit(scene, ray, hit.mesh, hit.triangle);
  const double weights = 2 * exact.weight_tolerance;  // of both engines
  const double reach = std::max({a.length(), b.length(), c.length(), Double3(ray.origin).length()});
  Tolerances t{};
  t.geometric_normal = kU * (16 + 8 * edge * edge / area);
  t.position = 2 * weights * edge + 16 * kU * reach;
  const double level =
      2 * (2 * exact.distance_tolerance / exact.distance + t.geometric_normal / std::max(cosine, 1.0 / 32)) + 64 * kU;
  const auto look_up = [&](const TextureSlot& slot) {
    return of_look_up(scene, mesh, slot, hit.triangle, weights, level);
  };
  // Interpolated, bent, kept visible and brought to length 1 again and again: each at most doubles what came in.
  t.normal =
      8 * (t.geometric_normal + 4 * weights + look_up(material.normal_texture) * (1 + double(material.normal_scale)));
  t.reflection = 2 * (look_up(material.base_colour_texture) + look_up(material.metallic_roughness_texture)) +
                 4 * weights + 16 * kU;
  const double most = std::max({material.emission.x, material.emission.y, material.emission.z});
  t.emission = most * (look_up(material.emissive_texture) + 16 * kU);
  return t;
}

struct BufferComparison {
  HitComparison hits;
  std::size_t compared = 0;  // pixels that show the same triangle, or the sky
  std::size_t outside = 0;   // of these, some quantity is not within its tolerance
};

double apart(const Plane3& a, const Plane3& b, std::size_t i) {
  double most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double by = std::abs(double(a[axis][i]) - double(b[axis][i]));
    most = by <= most ? most : std::isnan(by) ? 9e9 : by;
  }
  return most;
}

bool is_within(const GeometryBuffer& a, const GeometryBuffer& b, std::size_t i, const Tolerances& t) {
  const auto apart1 = [&](const Plane& x, const Plane& y) { return std::abs(double(x[i]) - double(y[i])); };
  return apart(a.position, b.position, i) <= t.position && apart1(a.depth, b.depth) <= 4 * t.position &&
         apart(a.geometric_normal, b.geometric_normal, i) <= t.geometric_normal &&
         apart(a.normal, b.normal, i) <= t.normal && apart(a.diffuse_albedo, b.diffuse_albedo, i) <= t.reflection &&
         apart(a.f0, b.f0, i) <= t.reflection && apart1(a.f90, b.f90) <= t.reflection &&
         apart1(a.ggx_alpha, b.ggx_alpha) <= t.reflection && apart(a.emission, b.emission, i) <= t.emission &&
         a.material[i] == b.material[i];
}

//   sky  of the emission where there is no surface
BufferComparison compare_buffers(const std::shared_ptr<const Scene>& scene, const DeviceView& view,
                                 const DeviceFrame& device, double sky) {
  const Result<RayScene> rays_scene = RayScene::create(scene);
  GeometryBuffer cpu;
  render_geometry_buffer({*rays_scene, view.camera, view.width, view.height, view.sub_pixel}, cpu);
  const std::vector<RayQuery> rays = rays_of(view);
  const std::vector<RayAnswer> embree = in_embree(*rays_scene, rays);
  BufferComparison c;
  // Distances are those of the trace's test; here they are not kept.
  c.hits = compare_hits(*scene, rays, device.hits, embree);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayAnswer& hit = device.hits[i];
    if (hit.mesh != embree[i].mesh || (is_hit(hit) && hit.triangle != embree[i].triangle)) continue;
    ++c.compared;
    if (is_hit(hit)) {
      c.outside += !is_within(device.buffer, cpu, i, tolerances_of(*scene, rays[i], hit));
    } else {
      c.outside += device.buffer.depth[i] != kNoSurface || device.buffer.material[i] != cpu.material[i] ||
                   device.buffer.ggx_alpha[i] != cpu.ggx_alpha[i] ||
                   apart(device.buffer.emission, cpu.emission, i) > sky;
    }
  }
  return c;
}

void expect_same_buffer(gpu::Device& device, const std::shared_ptr<const Scene>& scene, const std::string& name,
                        double sky = 0) {
  const DeviceView view = view_of(*scene);
  const DeviceFrame frame = on_device(device, *scene, view);
  ASSERT_TRUE(frame.status.has_value()) << frame.status.error().message;
  const BufferComparison c = compare_buffers(scene, view, frame, sky);
  const std::size_t pixels = frame.buffer.pixel_count();
  EXPECT_EQ(c.hits.wrong, 0u) << name;
  EXPECT_LE(c.hits.set_apart, pixels / 1000) << name;
  EXPECT_EQ(c.outside, 0u) << name << ", of " << c.compared;
  // The control: a hundredth of a pixel to the side is noticed.
  DeviceView moved = view;
  moved.sub_pixel.x += 0.01f;
  EXPECT_GT(compare_buffers(scene, view, on_device(device, *scene, moved), sky).outside, c.hits.met / 4) << name;
  std::printf("%-28s %zu of %zu pixels show the same, %zu set apart, %zu coincident\n", name.c_str(), c.compared,
              pixels, c.hits.set_apart, c.hits.coincident);
}

std::shared_ptr<const Scene> bundled(const std::string& address) {
  Result<Scene> scene = make_recipe_from_address(address);
  EXPECT_TRUE(scene.has_value()) << address;
  return std::make_shared<const Scene>(std::move(*scene));
}

TEST(DeviceGeometryBuffer, is_the_cpus) {
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  for (const char* address : {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1", "recipe:gallery?detail=0.05"}) {
    expect_same_buffer(*device, bundled(address), address);
  }
}

TEST(DeviceGeometryBuffer, is_the_cpus_in_sponza) {
  const char* folder = std::getenv("LUCIOLE_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "LUCIOLE_SCENES is not set";
  Result<Scene> sponza = load_scene(std::string(folder) + "/sponza/sponza.gltf");
  ASSERT_TRUE(sponza.has_value()) << sponza.error().message;
  sponza->cameras = {look_at(Vec3(-8, 2, 0.5f), Vec3(0, 3, 0), 1.0f)};
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  expect_same_buffer(*device, std::make_shared<const Scene>(std::move(*sponza)), "Sponza");
}

// Vulkan lets arcus tangent err 4,096 units in the last place: of a turn, and so of the image's width.
TEST(DeviceGeometryBuffer, has_the_sky_where_there_is_nothing) {
  Scene scene;
  scene.materials.resize(1);
  scene.cameras = {look_at(Vec3(0, 0, 0), Vec3(0.3f, 0.4f, -1), 1.2f)};
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{-1, -1, -3}, {1, -1, -3}, {0, 1, -3}};
  scene.meshes[0].indices = {0, 1, 2};
  Environment& sky = scene.environment;
  sky.radiance = Vec3(1, 2, 3);
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  expect_same_buffer(*device, std::make_shared<const Scene>(scene), "a constant sky");
  sky.width = 16, sky.height = 8;
  for (std::uint32_t i = 0; i < sky.width * sky.height; ++i) {
    sky.pixels.push_back(Vec3(float(i * 7 % 11), float(i * 5 % 13), 1));
  }
  constexpr double kMost = 2 * 12;  // between neighbours
  expect_same_buffer(*device, std::make_shared<const Scene>(scene), "a sky image", kMost * 16 * 4096 * 2 * kU);
}

// 70,000 triangles in whose boxes most rays run all the way.
TEST(DeviceGeometryBuffer, that_is_unfinished_is_refused) {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes.resize(1);
  for (std::uint32_t i = 0; i < 70000; ++i) {
    const float depth = -1.0f - 1e-5f * float(i);
    for (const Vec3 corner : {Vec3(-1, -1, depth), Vec3(0.5f, -1, depth), Vec3(-1, 0.5f, depth)}) {
      scene.meshes[0].indices.push_back(static_cast<std::uint32_t>(scene.meshes[0].positions.size()));
      scene.meshes[0].positions.push_back(corner);
    }
  }
  scene.cameras = {look_at(Vec3(0, 0, 0), Vec3(0, 0, -1), 0.2f)};
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  const DeviceFrame frame = on_device(*device, scene, {scene.cameras[0], 4, 4});
  ASSERT_FALSE(frame.status.has_value());
  EXPECT_NE(frame.status.error().message.find("16 rays met more"), std::string::npos) << frame.status.error().message;
}

}  // namespace
}  // namespace luciole::test
