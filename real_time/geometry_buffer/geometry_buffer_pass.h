// SPDX-License-Identifier: Apache-2.0
// Camera -> geometry buffer, by one primary ray per pixel.
#pragma once
#include <cstdint>

#include "base/isa.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/geometry_buffer/geometry_buffer.h"

namespace luciole {

struct GeometryBufferInputs {
  const RayScene& scene;
  Camera camera;
  std::uint32_t width = 0, height = 0;  // [pixels]
  Vec2 sub_pixel{0.5f, 0.5f};           // where in the pixel the rays go, [0,1)^2
  Isa isa = Isa::automatic;             // of the surface kernel
};

// Writes every value of `buffer`, resized to the inputs. Same bits for any number of threads.
void render_geometry_buffer(const GeometryBufferInputs& inputs, GeometryBuffer& buffer);

// Where in the pixel the rays of a frame go under --jitter: a sequence that fills the pixel evenly, whatever the number
// of frames, from a random start. The whole frame moves together, so that a frame stays a picture from one camera.
Vec2 jittered_sub_pixel(std::uint64_t seed, std::uint64_t frame);

}  // namespace luciole
