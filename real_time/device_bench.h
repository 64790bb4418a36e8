// SPDX-License-Identifier: Apache-2.0
// For tests of single passes: a device, values that go there and come back, and records of geometry and light.
#pragma once
#include <random>
#include <vector>

#include "gpu/test_device.h"
#include "real_time/geometry_buffer/geometry_records.h"
#include "real_time/vulkan_test_front.h"
#include "real_time/vulkan_transfer.h"

namespace luciole::test {

class DeviceBench {
 public:
  explicit DeviceBench(bool validated = false)
      : device_(validated ? gpu::test::open_validated_device() : gpu::test::open_device()) {}

  gpu::Device& device() { return *device_; }
  gpu::CommandList list() { return gpu::test::make_list(*device_); }
  gpu::Buffer make(std::uint64_t bytes) { return gpu::test::make_buffer(*device_, bytes, gpu::BufferUse::device); }

  void run(gpu::CommandList& list) {
    const Status done = list.run();
    EXPECT_TRUE(done.has_value()) << done.error().message;
  }

  template <class T>
  gpu::Buffer send(const std::vector<T>& values) {
    const gpu::Buffer from = gpu::test::upload_of(*device_, values);
    gpu::Buffer to = make(values.size() * sizeof(T));
    copy(from, to, values.size() * sizeof(T));
    return to;
  }

  template <class T>
  std::vector<T> receive(const gpu::Buffer& from, std::size_t count) {
    const gpu::Buffer to = gpu::test::make_buffer(*device_, count * sizeof(T), gpu::BufferUse::readback);
    copy(from, to, count * sizeof(T));
    return gpu::test::values_in<T>(to, count);
  }

 private:
  void copy(const gpu::Buffer& from, const gpu::Buffer& to, std::uint64_t bytes) {
    gpu::CommandList copies = list();
    copies.begin_pass("transfer");
    copies.copy(from, to, bytes);
    run(copies);
  }

  std::unique_ptr<gpu::Device> device_;
};

inline std::vector<PixelRecord> pixel_records(const GeometryBuffer& g) {
  std::vector<PixelRecord> records(g.pixel_count());
  pack(g, records.data());
  return records;
}

inline std::vector<SurfaceRecord> surface_records(const GeometryBuffer& g) {
  std::vector<SurfaceRecord> records(g.pixel_count());
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      records[i].diffuse_albedo[c] = g.diffuse_albedo[c][i], records[i].emission[c] = g.emission[c][i];
    }
    records[i].material = g.material[i];
  }
  return records;
}

// Numbers between 1e-3 and 10, each decade alike.
class MadeUpLight {
 public:
  explicit MadeUpLight(std::uint32_t seed) : random_(seed) {}
  float value() { return std::pow(10.0f, -3.0f + 4.0f * float(random_() >> 8) * 0x1p-24f); }

  // Nobody writes the sums of the sky: there they are no numbers.
  std::vector<PixelSums> sums(const GeometryBuffer& g, float scale) {
    std::vector<PixelSums> made(g.pixel_count());
    for (std::size_t i = 0; i < made.size(); ++i) {
      const bool sky = g.depth[i] == kNoSurface;
      for (float* v : {made[i].diffuse, made[i].specular}) {
        for (int c = 0; c < 3; ++c) v[c] = sky ? std::numeric_limits<float>::quiet_NaN() : value() * scale;
      }
    }
    return made;
  }
  Plane3 plane3(std::size_t pixels) {
    Plane3 planes;
    for (Plane& plane : planes) {
      plane.resize(pixels);
      for (float& v : plane) v = value();
    }
    return planes;
  }

 private:
  std::mt19937 random_;
};

inline Vec3 at(const Plane3& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }

inline void clear(Radiance& light, std::size_t pixels) {
  for (Plane3* planes : {&light.diffuse, &light.specular})
    for (Plane& plane : *planes) plane.assign(pixels, 0.0f);
}

// What the engine makes of sums on the CPU.
struct Unpacked {
  ShadingOutputs out;
  Unpacked(const GeometryBuffer& g, const std::vector<PixelSums>& diffuse, const std::vector<PixelSums>& glossy,
           const std::vector<PixelSums>& many, float weight) {
    clear(out.radiance.indirect, g.pixel_count()), clear(out.radiance.from_many, g.pixel_count());
    unpack(g, kDiffuseLights, diffuse.data(), weight, out);
    unpack(g, kGlossyLights, glossy.data(), weight, out);
    unpack(g, kManyLights, many.data(), weight, out);
  }
};

// A view of a bundled scene.
inline GeometryBuffer geometry_of(const RayScene& rays, const Camera& camera, std::uint32_t width, std::uint32_t height,
                                  Vec2 sub_pixel = {0.5f, 0.5f}) {
  GeometryBuffer geometry;
  render_geometry_buffer({rays, camera, width, height, sub_pixel}, geometry);
  return geometry;
}

struct BenchScene {
  explicit BenchScene(const std::string& address)
      : scene(std::make_shared<const Scene>(std::move(*make_recipe_from_address(address)))),
        rays(std::move(*RayScene::create(scene))) {}
  std::shared_ptr<const Scene> scene;
  RayScene rays;
};

inline const char* const kBenchScenes[] = {"recipe:cornell?glossy=0.1", "recipe:gallery?detail=0.05",
                                           "recipe:lights?count=500"};

// A walk through a scene: the eye moves to the right and forward, and samples move in their pixels.
class Walk {
 public:
  explicit Walk(const std::string& address) : scene_(address) {}

  GeometryBuffer geometry(std::uint32_t frame, float step = 0.03f) const {
    const float t = static_cast<float>(frame) * step;
    Camera camera = scene_.scene->cameras.at(0);
    camera.eye = camera.eye + camera.right * t + camera.forward * (0.5f * t);
    return geometry_of(scene_.rays, camera, 70, 45, {0.25f + 0.1f * float(frame % 5), 0.5f});
  }

 private:
  BenchScene scene_;
};

}  // namespace luciole::test
