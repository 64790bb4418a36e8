// SPDX-License-Identifier: Apache-2.0
// What temporal accumulation remembers of the view of a frame, and how the pixels of the next one find theirs in it.
#pragma once
#include <cmath>
#include <cstdint>

#include "base/vector.h"
#include "scene/scene.h"

#define LUCIOLE_FN inline
namespace luciole::f32 {
#include "real_time/filtering/reprojection.h"
}
#undef LUCIOLE_FN

namespace luciole {

struct FrameView {
  Camera camera;
  float sub_pixel_x = 0.5f, sub_pixel_y = 0.5f;  // where in the pixels the rays went
  std::uint32_t width = 0, height = 0;           // 0: there was no frame
  std::uint64_t number = 0;                      // of its geometry: frames of the same one see the same
  bool has_many = false;                         // light of many lights
};

inline bool is_same_camera(const Camera& a, const Camera& b) {
  const auto same = [](Vec3 u, Vec3 v) { return u.x == v.x && u.y == v.y && u.z == v.z; };
  return same(a.eye, b.eye) && same(a.right, b.right) && same(a.up, b.up) && same(a.forward, b.forward) &&
         a.vertical_fov == b.vertical_fov;
}

enum class WayBack : std::uint8_t {
  none,          // another size or other lights: everything starts anew
  same_pixel,    // nothing moved
  same_surface,  // the camera stands still: the pixel itself, if it saw the surface. Only the place in the pixel moves,
                 // and whoever takes the nearest pixel does not blur the light frame after frame
  four_pixels    // those round the place where the surface was
};

inline WayBack way_back(const FrameView& past, const FrameView& now) {
  if (past.width != now.width || past.height != now.height || past.has_many != now.has_many) return WayBack::none;
  if (past.number == now.number) return WayBack::same_pixel;
  return is_same_camera(past.camera, now.camera) ? WayBack::same_surface : WayBack::four_pixels;
}

inline f32::PastView past_view(const FrameView& past) {
  f32::PastView view;
  const float height = static_cast<float>(past.height);
  view.eye = past.camera.eye, view.right = past.camera.right, view.up = past.camera.up;
  view.forward = past.camera.forward;
  view.pixel_size = 2 * std::tan(0.5f * past.camera.vertical_fov) / (past.height > 0 ? height : 1.0f);
  view.width = static_cast<float>(past.width), view.height = height;
  view.sub_pixel_x = past.sub_pixel_x, view.sub_pixel_y = past.sub_pixel_y;
  return view;
}

}  // namespace luciole
