// SPDX-License-Identifier: Apache-2.0
// The ray of a pixel: ScreenRays of pixel_block.h. Included behind scene.glsl.

// Not unit: its part along the view is 1, so that distances along it are depths.
Ray camera_ray(float eye[3], float top_left[3], float across[3], float down[3], uvec2 at) {
  precise vec3 direction = vector(top_left) + vector(across) * float(at.x) + vector(down) * float(at.y);
  Ray ray;
  ray.origin = vector(eye);
  ray.direction = direction;
  ray.nearest = 0.0;
  ray.farthest = uintBitsToFloat(0x7f800000u);
  return ray;
}
