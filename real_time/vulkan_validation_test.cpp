// SPDX-License-Identifier: Apache-2.0
// A frame, and what the ray caster makes, under the validation layers: core, synchronisation and GPU-assisted checks.
// By itself, as software Vulkan takes half a minute to compile kernels in which each access is checked.
#include "gpu/test_device.h"
#include "real_time/geometry_buffer/device_geometry_pass.h"
#include "real_time/shading/list_test_stage.h"
#include "real_time/vulkan_test_front.h"
#include "scene/random_surfaces.h"

namespace luciole::test {
namespace {

// All kernels run: the scene has virtual point lights of both lobes and other lights. gpu/gpu_test.cpp shows that the
// layers find what they are there for.
TEST(Validation, has_nothing_to_say_of_a_frame) {
  Settings settings = small_settings();
  settings.engine = Engine::vulkan, settings.vulkan_validation = true, settings.filter = Filter::bilateral;
  const Front front("recipe:lights?count=500", settings);
  ASSERT_GT(front.vpls.size(), 0u);
  ASSERT_GT(front.many.size(), 0u);
  Result<Renderer> renderer = Renderer::create(front.scene, front.scene->cameras.at(0), front.primaries, settings);
  ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
  const Result<Frame> frame = renderer->render(0);
  EXPECT_TRUE(frame.has_value()) << frame.error().message;
}

// Without the checks inside the kernel, with which software Vulkan compiles it for minutes.
//
// Random materials with textures, masks and normal maps, on triangles that have what they need and that have not.
TEST(Validation, has_nothing_to_say_of_the_geometry_buffer) {
  Dice dice(9);
  Scene scene = random_scene(dice, false);
  for (Material& material : scene.materials) material.alpha_mode = static_cast<AlphaMode>(dice.below(3));
  gpu::DeviceRequest request;
  request.validation = true, request.in_kernels = false;
  const auto device = gpu::test::open_device(request);
  ASSERT_TRUE(device);
  const Result<Hierarchy> hierarchy = build_hierarchy(scene);
  ASSERT_TRUE(hierarchy.has_value());
  const DeviceView view{look_at(Vec3(0, 0, 4), Vec3(0, 0, 0), 1.2f), 70, 45};
  const Result<DeviceScene> placed = DeviceScene::create(*device, scene, *hierarchy);
  const Result<DeviceGeometryPass> pass = DeviceGeometryPass::create(*device);
  const Result<GeometryOnDevice> target = GeometryOnDevice::create(*device, view.width, view.height);
  ASSERT_TRUE(placed.has_value() && pass.has_value() && target.has_value());
  gpu::CommandList list = gpu::test::make_list(*device);
  pass->record(list, *placed, view, *target);
  ASSERT_TRUE(list.run().has_value());
  GeometryBuffer seen;
  ASSERT_TRUE(read_back(*device, *target, view, seen).has_value());
  EXPECT_GT(std::count_if(seen.depth.begin(), seen.depth.end(), [](float depth) { return depth != kNoSurface; }), 500);
  const Status validated = device->validated();
  EXPECT_TRUE(validated.has_value()) << validated.error().message;
}

// Without the checks inside the kernels, for the same reason.
TEST(Validation, has_nothing_to_say_of_the_rivals_of_tiled_culling) {
  for (const Culling culling : {Culling::clustered, Culling::splatting}) {
    Settings settings = small_settings();
    settings.culling = culling;
    gpu::DeviceRequest request;
    request.validation = true, request.in_kernels = false;
    const ListStage stage("recipe:lights?count=500", settings, request);
    for (const LightKind kind : {kDiffuseLights, kGlossyLights, kManyLights}) {
      ASSERT_GT(stage.longest(kind), 0u);
      EXPECT_EQ(stage.shade_lists(stage.make_pass(stage.longest(kind)), kind).parts.size(), stage.tiles());
    }
    const Status validated = stage.device->validated();
    EXPECT_TRUE(validated.has_value()) << validated.error().message;
  }
}

}  // namespace
}  // namespace luciole::test
