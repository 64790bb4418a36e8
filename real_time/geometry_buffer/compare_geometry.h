// SPDX-License-Identifier: Apache-2.0
// For tests: the geometry buffer that a device made against the CPU's, and scenes to do it with.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "gpu/test_device.h"
#include "real_time/device_scene/compare_hits.h"
#include "real_time/geometry_buffer/device_geometry_pass.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "real_time/geometry_buffer/pixel_block.h"
#include "scene/load_scene.h"
#include "scene/recipes/recipes.h"

namespace luciole::test {

inline constexpr double kU = 0x1p-24;
inline const Vec2 kSubPixel{0.3f, 0.6f};

inline DeviceView view_of(const Scene& scene) { return {scene.cameras.at(0), 70, 45, kSubPixel}; }

// What the device made of a view.
struct DeviceFrame {
  GeometryBuffer buffer;
  std::vector<RayAnswer> hits;  // complete: those that the buffer stands for
  Status status = Done{};
};

//   record(list, scene, view, target)  the pass
template <class Record>
DeviceFrame on_device(gpu::Device& device, const Scene& scene, const DeviceView& view, const Record& record) {
  const Result<Hierarchy> hierarchy = build_hierarchy(scene);
  const Result<DeviceScene> placed = DeviceScene::create(device, scene, *hierarchy);
  const Result<GeometryOnDevice> target = GeometryOnDevice::create(device, view.width, view.height);
  EXPECT_TRUE(placed.has_value() && target.has_value());
  gpu::CommandList list = gpu::test::make_list(device);
  record(list, *placed, view, *target);
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

inline std::vector<RayQuery> rays_of(const DeviceView& view) {
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
inline double of_look_up(const Scene& scene, const Mesh& mesh, const TextureSlot& slot, std::uint32_t triangle,
                         double weights, double level) {
  if (slot.texture < 0 || mesh.uv[slot.uv_set].empty()) return 0;
  const MipImage::Level& finest = scene.textures[static_cast<std::size_t>(slot.texture)].image->levels[0];
  double size = 1;
  for (int corner = 0; corner < 3; ++corner) {
    const Vec2 uv = slot.transform(mesh.uv[slot.uv_set][mesh.indices[3 * std::size_t(triangle) + std::size_t(corner)]]);
    size = std::max({size, std::abs(double(uv.x)), std::abs(double(uv.y))});
  }
  return (8 * kU + 4 * weights) * size * std::max(finest.width, finest.height) + level;
}

inline Tolerances tolerances_of(const Scene& scene, const RayQuery& ray, const RayAnswer& hit) {
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

inline double apart(const Plane3& a, const Plane3& b, std::size_t i) {
  double most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double by = std::abs(double(a[axis][i]) - double(b[axis][i]));
    most = by <= most ? most : std::isnan(by) ? 9e9 : by;
  }
  return most;
}

inline bool is_within(const GeometryBuffer& a, const GeometryBuffer& b, std::size_t i, const Tolerances& t) {
  const auto apart1 = [&](const Plane& x, const Plane& y) { return std::abs(double(x[i]) - double(y[i])); };
  return apart(a.position, b.position, i) <= t.position && apart1(a.depth, b.depth) <= 4 * t.position &&
         apart(a.geometric_normal, b.geometric_normal, i) <= t.geometric_normal &&
         apart(a.normal, b.normal, i) <= t.normal && apart(a.diffuse_albedo, b.diffuse_albedo, i) <= t.reflection &&
         apart(a.f0, b.f0, i) <= t.reflection && apart1(a.f90, b.f90) <= t.reflection &&
         apart1(a.ggx_alpha, b.ggx_alpha) <= t.reflection && apart(a.emission, b.emission, i) <= t.emission &&
         a.material[i] == b.material[i];
}

//   sky                 tolerance of the emission where there is no surface
//   exact_of(ray, hit)  as in compare_hits
template <class Exact>
BufferComparison compare_buffers(const std::shared_ptr<const Scene>& scene, const DeviceView& view,
                                 const DeviceFrame& device, double sky, const Exact& exact_of) {
  const Result<RayScene> rays_scene = RayScene::create(scene);
  GeometryBuffer cpu;
  render_geometry_buffer({*rays_scene, view.camera, view.width, view.height, view.sub_pixel}, cpu);
  const std::vector<RayQuery> rays = rays_of(view);
  const std::vector<RayAnswer> embree = in_embree(*rays_scene, rays);
  BufferComparison c;
  // Distances are those of the trace's test; here they are not kept.
  c.hits = compare_hits(*scene, rays, device.hits, embree, exact_of);
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

inline std::shared_ptr<const Scene> bundled(const std::string& address) {
  Result<Scene> scene = make_recipe_from_address(address);
  EXPECT_TRUE(scene.has_value()) << address;
  return std::make_shared<const Scene>(std::move(*scene));
}

// None if there are no scenes beside the project.
inline std::shared_ptr<const Scene> sponza_if_there() {
  const char* folder = std::getenv("LUCIOLE_SCENES");
  if (folder == nullptr) return nullptr;
  Result<Scene> sponza = load_scene(std::string(folder) + "/sponza/sponza.gltf");
  EXPECT_TRUE(sponza.has_value()) << sponza.error().message;
  sponza->cameras = {look_at(Vec3(-8, 2, 0.5f), Vec3(0, 3, 0), 1.0f)};
  return std::make_shared<const Scene>(std::move(*sponza));
}

// A triangle before a sky.
inline Scene scene_with_sky() {
  Scene scene;
  scene.materials.resize(1);
  scene.cameras = {look_at(Vec3(0, 0, 0), Vec3(0.3f, 0.4f, -1), 1.2f)};
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{-1, -1, -3}, {1, -1, -3}, {0, 1, -3}};
  scene.meshes[0].indices = {0, 1, 2};
  scene.environment.radiance = Vec3(1, 2, 3);
  return scene;
}

inline void set_sky_image(Environment& sky) {
  sky.width = 16, sky.height = 8;
  for (std::uint32_t i = 0; i < sky.width * sky.height; ++i) {
    sky.pixels.push_back(Vec3(float(i * 7 % 11), float(i * 5 % 13), 1));
  }
}
// Vulkan lets arcus tangent err 4,096 units in the last place: of a turn, and so of the image's width. Neighbours
// differ by 12 at most.
inline constexpr double kSkyTolerance = 2 * 12 * 16 * 4096 * 2 * kU;

}  // namespace luciole::test
