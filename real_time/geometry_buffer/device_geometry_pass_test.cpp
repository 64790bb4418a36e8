// SPDX-License-Identifier: Apache-2.0
// The geometry buffer of a device is the CPU's: the same triangles but where rounding decides, and there every quantity
// within what rounding can do.
#include "real_time/geometry_buffer/device_geometry_pass.h"

#include "real_time/geometry_buffer/compare_geometry.h"

namespace luciole::test {
namespace {

DeviceFrame cast_on_device(gpu::Device& device, const Scene& scene, const DeviceView& view) {
  const Result<DeviceGeometryPass> pass = DeviceGeometryPass::create(device);
  EXPECT_TRUE(pass.has_value());
  return on_device(device, scene, view, [&](auto&... told) { pass->record(told...); });
}

BufferComparison compared(const std::shared_ptr<const Scene>& scene, const DeviceView& view, const DeviceFrame& frame,
                          double sky) {
  return compare_buffers(scene, view, frame, sky, [&](const RayQuery& ray, const RayAnswer& hit) {
    return exact_hit(*scene, ray, hit.mesh, hit.triangle);
  });
}

void expect_same_buffer(gpu::Device& device, const std::shared_ptr<const Scene>& scene, const std::string& name,
                        double sky = 0) {
  const DeviceView view = view_of(*scene);
  const DeviceFrame frame = cast_on_device(device, *scene, view);
  ASSERT_TRUE(frame.status.has_value()) << frame.status.error().message;
  const BufferComparison c = compared(scene, view, frame, sky);
  const std::size_t pixels = frame.buffer.pixel_count();
  EXPECT_EQ(c.hits.wrong, 0u) << name;
  EXPECT_LE(c.hits.set_apart, pixels / 1000) << name;
  EXPECT_EQ(c.outside, 0u) << name << ", of " << c.compared;
  // The control: a hundredth of a pixel to the side is noticed.
  DeviceView moved = view;
  moved.sub_pixel.x += 0.01f;
  EXPECT_GT(compared(scene, view, cast_on_device(device, *scene, moved), sky).outside, c.hits.met / 4) << name;
  std::printf("%-28s %zu of %zu pixels show the same, %zu set apart, %zu coincident\n", name.c_str(), c.compared,
              pixels, c.hits.set_apart, c.hits.coincident);
}

TEST(DeviceGeometryBuffer, is_the_cpus) {
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  for (const char* address : {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1", "recipe:gallery?detail=0.05"}) {
    expect_same_buffer(*device, bundled(address), address);
  }
}

TEST(DeviceGeometryBuffer, is_the_cpus_in_sponza) {
  const std::shared_ptr<const Scene> sponza = sponza_if_there();
  if (!sponza) GTEST_SKIP() << "LUCIOLE_SCENES is not set";
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  expect_same_buffer(*device, sponza, "Sponza");
}

TEST(DeviceGeometryBuffer, has_the_sky_where_there_is_nothing) {
  Scene scene = scene_with_sky();
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  expect_same_buffer(*device, std::make_shared<const Scene>(scene), "a constant sky");
  set_sky_image(scene.environment);
  expect_same_buffer(*device, std::make_shared<const Scene>(scene), "a sky image", kSkyTolerance);
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
  const DeviceFrame frame = cast_on_device(*device, scene, {scene.cameras[0], 4, 4});
  ASSERT_FALSE(frame.status.has_value());
  EXPECT_NE(frame.status.error().message.find("16 rays met more"), std::string::npos) << frame.status.error().message;
}

}  // namespace
}  // namespace luciole::test
