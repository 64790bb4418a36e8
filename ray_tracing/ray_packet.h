// SPDX-License-Identifier: Apache-2.0
// Door: rays in packets of 16 and what they met, one value per lane in arrays.
//
// One width is enough: where the processor has no 16 lanes, Embree cuts the packet by itself as fast as we could
// (primary rays on one core, million per second: AVX-512 18.6, AVX2 13.9 against 13.6 in packets of 8, SSE 6.1 against
// 6.2 in packets of 4; single rays 5.9).
#pragma once
#include <cstdint>

#include "base/vector.h"

namespace luciole {

inline constexpr int kPacketRays = 16;
inline constexpr std::uint32_t kNoHit = 0xffffffffu;

struct alignas(64) RayPacket {
  float origin_x[kPacketRays], origin_y[kPacketRays], origin_z[kPacketRays];           // [m]
  float direction_x[kPacketRays], direction_y[kPacketRays], direction_z[kPacketRays];  // any length but 0
  float nearest[kPacketRays], farthest[kPacketRays];  // hits count between these, in units of the direction's length
  std::int32_t active[kPacketRays];                   // -1: trace this lane, 0: leave it
  std::uint32_t random[kPacketRays];                  // 32 bits that decide what blended surfaces let through

  void set(int lane, Vec3 origin, Vec3 direction, float nearest_distance, float farthest_distance,
           std::uint32_t random_bits = 0) {
    origin_x[lane] = origin.x, origin_y[lane] = origin.y, origin_z[lane] = origin.z;
    direction_x[lane] = direction.x, direction_y[lane] = direction.y, direction_z[lane] = direction.z;
    nearest[lane] = nearest_distance, farthest[lane] = farthest_distance;
    active[lane] = -1, random[lane] = random_bits;
  }
  // A lane that is not traced, with values that do no harm.
  void skip(int lane) {
    set(lane, Vec3(0, 0, 0), Vec3(0, 0, 1), 0, 0);
    active[lane] = 0;
  }
};

struct alignas(64) HitPacket {
  std::uint32_t mesh[kPacketRays];       // index in Scene::meshes; kNoHit: nothing met, or lane not active
  std::uint32_t triangle[kPacketRays];   // index of the triangle in its mesh
  float u[kPacketRays], v[kPacketRays];  // barycentric: point = (1-u-v) p0 + u p1 + v p2
  float distance[kPacketRays];           // in units of the direction's length
};

// Whether the rays of a packet go almost the same way: a promise for speed only, never for the result.
enum class Coherence : std::uint8_t { coherent, incoherent };

}  // namespace luciole
