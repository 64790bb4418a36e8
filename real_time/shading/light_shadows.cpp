// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/light_shadows.h"

namespace luciole {

std::uint16_t unoccluded_lanes(const RayScene& scene, const PixelGroup& group, Vec3 light, std::uint16_t lanes) {
  RayPacket rays;
  for (int lane = 0; lane < kGroupPixels; ++lane) {
    const Vec3 position(group.position[0][lane], group.position[1][lane], group.position[2][lane]);
    const Vec3 normal(group.geometric_normal[0][lane], group.geometric_normal[1][lane],
                      group.geometric_normal[2][lane]);
    const Vec3 origin = scene.offset_from_surface(position, normal);
    const Vec3 to_light = light - origin;
    if ((lanes >> lane & 1) == 0 || dot(to_light, to_light) == 0.0f) {
      rays.skip(lane);
    } else {
      // The emitter's own surface, at the end of the ray, does not count.
      const float shortened = 1.0f - 2.0f * scene.surface_offset() / length(to_light);
      rays.set(lane, origin, to_light, 0.0f, shortened);
    }
  }
  return static_cast<std::uint16_t>(lanes & ~scene.occluded(rays, Coherence::incoherent));
}

}  // namespace luciole
