// SPDX-License-Identifier: Apache-2.0
// For tests of the Vulkan engine: what the CPU's passes make of bundled scenes, and both engines fed with it.
#pragma once
#include <gtest/gtest.h>

#include "real_time/frame.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "real_time/light_range/light_range.h"
#include "real_time/virtual_point_lights/place_lights.h"
#include "real_time/vulkan_engine.h"
#include "scene/recipes/recipes.h"

namespace luciole::test {

// What the CPU's passes make of a bundled scene.
struct Front {
  explicit Front(const std::string& address, const Settings& settings) {
    scene = std::make_shared<const Scene>(std::move(*make_recipe_from_address(address)));
    if (!scene->lights.empty()) primaries = {scene->lights[0]};
    const Result<RayScene> rays = RayScene::create(scene);
    render_geometry_buffer({*rays, scene->cameras.at(0), settings.width, settings.height}, geometry);
    std::vector<SurfaceTexel> texels;
    ReflectiveShadowMaps(primaries, rays->bounds(), settings.vpls).render(*rays, {}, texels);
    place_virtual_point_lights(texels, vpls);
    many = make_many_lights(*scene, primaries, settings, 0);
  }

  std::shared_ptr<const Scene> scene;
  PrimaryLights primaries;
  GeometryBuffer geometry;
  VirtualPointLights vpls;
  ManyLights many;
};

inline Settings small_settings(std::uint32_t interleave = 8) {
  Settings settings;
  settings.width = 70, settings.height = 45;  // neither divides by a tile
  settings.vpls = 2500;                       // no multiple of 64; without interleaving more than a list holds
  settings.interleave = interleave;
  settings.filter = Filter::none;
  settings.exposure = 2.0f;
  settings.delta = interleave == 1 ? 0.05f : 0.01f;  // few accepted lights: ties are as rare as these
  settings.isa = *choose_isa(Isa::automatic);
  return settings;
}

struct Reached {
  ReachingLights<DiffuseEmitter> diffuse;
  ReachingLights<GlossyEmitter> glossy;
  ReachingLights<ManyEmitter> many;
};

inline Reached reach(const Front& front, const Settings& s, const RangeParameters& range) {
  return {reach_diffuse_lobes(front.vpls, range, s.interleave, s.isa),
          reach_glossy_lobes(front.vpls, range, s.interleave, s.isa),
          reach_many_lights(front.many, range, s.interleave, s.isa)};
}

inline RangeParameters range_of(const Front& front, const Settings& settings) {
  return range_parameters(settings, front.geometry.camera, {settings.seed, 0}, -1.0f);
}

inline std::unique_ptr<VulkanEngine> open_engine(const Settings& settings, std::uint32_t largest_part = 0) {
  gpu::DeviceRequest request;
  request.validation = settings.vulkan_validation;
  Result<std::unique_ptr<VulkanEngine>> engine = VulkanEngine::create(settings, request, largest_part);
  EXPECT_TRUE(engine.has_value()) << engine.error().message;
  return std::move(*engine);
}

inline constexpr std::uint32_t kShift = 0;

inline ShadingOutputs shade_on(VulkanEngine& engine, const Front& front, const Settings& settings) {
  Result<VulkanShaded> shaded =
      engine.shade({1, front.geometry, front.vpls, front.many, range_of(front, settings), kShift, true, true});
  EXPECT_TRUE(shaded.has_value()) << shaded.error().message;
  return std::move(shaded->shaded);
}

inline const char* const kScenes[] = {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1",
                                      "recipe:gallery?detail=0.05", "recipe:lights?count=500"};

}  // namespace luciole::test
