// SPDX-License-Identifier: Apache-2.0
// A frame, and its front half by rays and by rasterisation, under the validation layers: core, synchronisation and
// GPU-assisted checks. By itself, as software Vulkan takes half a minute to compile kernels in which each access is
// checked.
#include "gpu/test_device.h"
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

// Without the checks inside the kernels, with which software Vulkan compiles them for minutes.
//
// Random materials with textures, masks and normal maps, on triangles that have what they need and that have not, under
// lights of all kinds.
TEST(Validation, has_nothing_to_say_of_the_front) {
  Dice dice(9);
  Scene scene = random_scene(dice, false);
  for (Material& material : scene.materials) material.alpha_mode = static_cast<AlphaMode>(dice.below(3));
  gpu::DeviceRequest request;
  request.validation = true, request.in_kernels = false;
  const auto device = gpu::test::open_device(request);
  ASSERT_TRUE(device);
  const Result<RayScene> rays = RayScene::create(std::make_shared<const Scene>(scene));
  ASSERT_TRUE(rays.has_value());
  PunctualLight point, spot, sun;
  point.position = spot.position = Vec3(1, 2, 4);
  spot.kind = PunctualLight::Kind::spot, sun.kind = PunctualLight::Kind::directional;
  Settings settings = small_settings();
  ViewRequest wanted;
  wanted.lights = {point, spot, sun};
  const ReflectiveShadowMaps maps(wanted.lights, rays->bounds(), settings.vpls);
  wanted.rays = &*rays, wanted.maps = &maps;
  wanted.view = {look_at(Vec3(0, 0, 4), Vec3(0, 0, 0), 1.2f), settings.width, settings.height};
  const Result<Hierarchy> hierarchy = build_hierarchy(scene);
  ASSERT_TRUE(hierarchy.has_value());
  const Result<DeviceScene> placed = DeviceScene::create(*device, scene, *hierarchy);
  ASSERT_TRUE(placed.has_value()) << placed.error().message;
  for (const luciole::Front by : {luciole::Front::rays, luciole::Front::raster}) {
    settings.front = by;
    Result<VulkanFront> front = VulkanFront::create(*device, settings);
    ASSERT_TRUE(front.has_value()) << front.error().message;
    ViewOnDevice made;
    for (int time = 0; time < 2; ++time) {  // and once again into the same buffers and images
      const Status rendered = front->render(*device, *placed, wanted, made);
      ASSERT_TRUE(rendered.has_value()) << rendered.error().message;
    }
    GeometryBuffer geometry;
    VirtualPointLights vpls;
    Plane3 direct;
    ASSERT_TRUE(read_back(*device, made, wanted.view, {geometry, vpls, direct}).has_value());
    const auto is_surface = [](float depth) { return depth != kNoSurface; };
    EXPECT_GT(std::count_if(geometry.depth.begin(), geometry.depth.end(), is_surface), 500);
    EXPECT_GT(vpls.size(), 100u);
    EXPECT_GT(*std::max_element(direct[1].begin(), direct[1].end()), 0.0f);
  }
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
