// SPDX-License-Identifier: Apache-2.0
#include "real_time/view.h"

#include "base/parallel.h"
#include "real_time/direct_light/direct_light.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "real_time/sky_light/sky_light.h"
#include "real_time/virtual_point_lights/place_lights.h"

namespace luciole {
namespace {

bool is_same_view(const Camera& a, const Camera& b) {
  const auto same = [](Vec3 u, Vec3 v) { return u.x == v.x && u.y == v.y && u.z == v.z; };
  return same(a.eye, b.eye) && same(a.right, b.right) && same(a.up, b.up) && same(a.forward, b.forward) &&
         a.vertical_fov == b.vertical_fov;
}

}  // namespace

bool ViewMaker::set_camera(const Camera& camera) {
  if (is_same_view(camera_, camera)) return false;
  camera_ = camera;
  return true;
}

void ViewMaker::set_scene(RayScene rays, PrimaryLights primaries) {
  rays_ = std::move(rays), primaries_ = std::move(primaries);
  maps_.reset();
  ++scene_number_;
}

Vec2 ViewMaker::sub_pixel(std::uint64_t frame_index) const {
  return settings_.jitter ? jittered_sub_pixel(settings_.vpl_seed, frame_index) : Vec2(0.5f, 0.5f);
}

PrimaryLights ViewMaker::lights_with_sky(std::uint64_t frame_index) const {
  PrimaryLights lights = primaries_;
  const PrimaryLights sky = sample_sky(rays_.scene().environment,
                                       {.seed = settings_.vpl_seed, .frame = frame_index, .jitter = settings_.jitter});
  lights.insert(lights.end(), sky.begin(), sky.end());
  return lights;
}

void ViewMaker::make_maps(const PrimaryLights& lights) {
  const bool lights_move = settings_.jitter && lights.size() > primaries_.size();
  if (maps_ && !lights_move) return;
  maps_.emplace(lights, rays_.bounds(), settings_.vpls);
  ++maps_number_;
}

bool ViewMaker::make(std::uint64_t frame_index, View& made) {
  made = View();
  PassTimer timer(made.passes_ms);
  render_geometry_buffer({rays_, camera_, settings_.width, settings_.height, sub_pixel(frame_index), settings_.isa},
                         made.geometry);
  timer.end("geometry_buffer");
  if (stop_requested()) return false;
  const PrimaryLights lights = lights_with_sky(frame_index);
  timer.end("sky_light");
  make_maps(lights);
  std::vector<SurfaceTexel> texels;
  maps_->render(rays_, sampling(frame_index), texels);
  timer.end("reflective_shadow_map");
  if (stop_requested()) return false;
  place_virtual_point_lights(texels, made.vpls);
  timer.end("virtual_point_lights");
  made.direct = direct_light(rays_, made.geometry, lights, settings_.isa);
  timer.end("direct_light");
  made.number = ++views_;
  made.on_host = true;
  return !stop_requested();
}

void ViewMaker::request(std::uint64_t frame_index, View& wanted) {
  wanted = View();
  PassTimer timer(wanted.passes_ms);
  PrimaryLights lights = lights_with_sky(frame_index);
  timer.end("sky_light");
  make_maps(lights);
  wanted.number = ++views_;
  wanted.geometry.width = settings_.width, wanted.geometry.height = settings_.height;
  wanted.geometry.camera = camera_;
  wanted.geometry.sub_pixel_x = sub_pixel(frame_index).x, wanted.geometry.sub_pixel_y = sub_pixel(frame_index).y;
  wanted.request.emplace();
  wanted.request->maps_number = maps_number_;
  wanted.request->rays = &rays_, wanted.request->maps = &*maps_;
  wanted.request->sampling = sampling(frame_index);
  wanted.request->lights = std::move(lights);
  wanted.request->view = {camera_, settings_.width, settings_.height, sub_pixel(frame_index)};
}

}  // namespace luciole
