// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/motion.h"

#include <algorithm>
#include <chrono>

#include "apps/command_line/stage.h"
#include "scene/animation.h"

namespace luciole {

Motion::Motion(OpenedShot opened, std::optional<CameraPath> camera_path, double frames_per_second)
    : scene_(std::make_shared<const Scene>(std::move(opened.scene))),
      camera_(opened.camera),
      scene_camera_(opened.scene_camera),
      listed_(std::move(opened.primary)),
      path_(std::move(camera_path)),
      frames_per_second_(frames_per_second) {}

Result<Renderer> Motion::create_renderer(const Settings& settings) const {
  return Renderer::create(scene_, camera_, listed_.empty() ? strongest_as_primary(*scene_) : listed_, settings);
}

Result<double> Motion::move_to(std::uint64_t frame, Renderer& renderer) {
  const auto start = std::chrono::steady_clock::now();
  bool moved = false;
  if (scene_->animation) {
    // After its last key everything rests.
    const double time =
        std::min(static_cast<double>(frame) / frames_per_second_, double(scene_->animation->duration()));
    moved = time != time_;
    time_ = time;
  }
  if (moved) {
    auto posed = std::make_shared<Scene>(*scene_);
    if (Status status = pose_scene(*posed, time_); !status) return status.error();
    scene_ = std::move(posed);
    PrimaryLights primaries = listed_.empty() ? strongest_as_primary(*scene_) : listed_;
    if (Status status = renderer.set_scene(scene_, std::move(primaries)); !status) return status.error();
  }
  if (path_) {
    renderer.set_camera(camera_at(*path_, static_cast<double>(frame), frames_per_second_));
  } else if (scene_camera_) {
    renderer.set_camera(scene_->cameras[*scene_camera_]);
  }
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  return moved ? wall.count() : 0.0;
}

}  // namespace luciole
