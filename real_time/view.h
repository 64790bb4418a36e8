// SPDX-License-Identifier: Apache-2.0
// What frames of an unmoved camera and unmoved lights have in common: the front half of the frame.
#pragma once
#include <optional>

#include "ray_tracing/ray_scene.h"
#include "real_time/pass_timer.h"
#include "real_time/vulkan_front.h"

namespace luciole {

struct View {
  std::uint64_t number = 0;            // another one for each view, from 1
  std::optional<ViewRequest> request;  // what a device makes it of; none: the CPU made it
  bool on_host = false;                // what follows has its values, else only its size and camera
  GeometryBuffer geometry;
  VirtualPointLights vpls;
  Plane3 direct;
  PassTimes passes_ms;  // of the CPU's passes
};

// Makes views of one scene.
class ViewMaker {
 public:
  ViewMaker(RayScene rays, const Camera& camera, PrimaryLights primaries, const Settings& settings)
      : rays_(std::move(rays)), camera_(camera), primaries_(std::move(primaries)), settings_(settings) {}

  const RayScene& rays() const { return rays_; }
  const Camera& camera() const { return camera_; }
  const PrimaryLights& primaries() const { return primaries_; }
  SceneToTrace scene_to_trace() const { return {scene_number_, &rays_}; }

  bool set_camera(const Camera& camera);  // whether it is another one
  void set_scene(RayScene rays, PrimaryLights primaries);

  // By the CPU. False where it was asked to stop: no pass takes a second, all of them may.
  bool make(std::uint64_t frame_index, View& made);
  // What a device needs to make it. Good until the next call of any of these.
  void request(std::uint64_t frame_index, View& wanted);

 private:
  PrimaryLights lights_with_sky(std::uint64_t frame_index) const;
  void make_maps(const PrimaryLights& lights);
  Vec2 sub_pixel(std::uint64_t frame_index) const;
  TexelSampling sampling(std::uint64_t frame_index) const {
    return {settings_.vpl_seed, settings_.jitter, frame_index};
  }

  RayScene rays_;
  Camera camera_;
  PrimaryLights primaries_;
  Settings settings_;
  std::optional<ReflectiveShadowMaps> maps_;  // kept, as the order of their texels takes a while to find
  std::uint64_t views_ = 0, scene_number_ = 1, maps_number_ = 0;
};

}  // namespace luciole
