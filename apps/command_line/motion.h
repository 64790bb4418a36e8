// SPDX-License-Identifier: Apache-2.0
// What differs from frame to frame besides random numbers: the camera on the shot's path, and what the scene's
// animation moves. Frame k is at the time k / frames_per_second.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "real_time/frame.h"
#include "shot/open_shot.h"

namespace luciole {

class Motion {
 public:
  //   opened       at frame 0; its primary lights, or the scene's strongest
  //   camera_path  none: the camera of `opened`, which moves if it is one of the scene's
  Motion(OpenedShot opened, std::optional<CameraPath> camera_path, double frames_per_second);

  Result<Renderer> create_renderer(const Settings& settings) const;

  // Puts scene and camera of a frame into the renderer, if they are not there already. A function of the frame alone.
  // Returns how long the scene took [ms]; 0: it did not move.
  Result<double> move_to(std::uint64_t frame, Renderer& renderer);

 private:
  std::shared_ptr<const Scene> scene_;  // as it is in the renderer
  Camera camera_;
  std::optional<std::size_t> scene_camera_;
  PrimaryLights listed_;  // by the shot; empty: the scene's strongest
  std::optional<CameraPath> path_;
  double frames_per_second_, time_ = 0;  // of the scene in the renderer [s]
};

}  // namespace luciole
