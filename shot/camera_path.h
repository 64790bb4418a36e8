// SPDX-License-Identifier: Apache-2.0
// Door: where a camera is at each frame. Keys in a shot, a smooth curve through them.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace luciole {

struct CameraKey {
  double at = 0;                        // [s], or a frame's number; see CameraPath::in_frames
  Vec3 eye{0, 0, 0}, target{0, 0, -1};  // [m]
  float vertical_fov = 0.9f;            // [rad]
};

struct CameraPath {
  bool in_frames = false;       // keys are at frames; else at seconds
  std::vector<CameraKey> keys;  // at least two, `at` strictly ascending
};

// The camera of a frame. Eye and target follow Catmull-Rom curves through the keys, in the form for keys that are not
// evenly spaced: cubics, whose velocity at a key is that between its two neighbours, and at an end that towards its
// only one. The field of view does the same but stays between those of the two keys. Before the first key and after the
// last one the camera rests. A function of the frame alone, so that a frame does not depend on which were rendered
// before.
//   frame              its number; 0 is at time 0
//   frames_per_second  > 0
Camera camera_at(const CameraPath& path, double frame, double frames_per_second);

}  // namespace luciole
