// SPDX-License-Identifier: Apache-2.0
// What a workshop makes of drawn lines: turned, swept, extruded and moulded solids. All are closed unless said.
#pragma once
#include <functional>
#include <optional>

#include "scene/recipes/mesh_builder.h"
#include "scene/recipes/outline.h"

namespace luciole::workshop {

// Turns a profile of (radius, height) round +Y. Going up, the front is outside; a profile that starts and ends at
// radius 0 is a closed solid. uv in metres round the widest place and along the profile.
Mesh lathe(const std::vector<Vec2>& profile, std::uint32_t columns);

struct Sweep {
  std::vector<Vec3> path;                            // a closed path does not repeat its first point
  bool closed = false;                               // otherwise both ends get flat caps
  std::vector<Vec2> section;                         // counter-clockwise loop, (across, up)
  std::function<float(float along)> size = nullptr;  // factor of the section at along in [0,1]; none: 1
  std::optional<Vec3> up;  // the section's second axis stays near this; none: it twists as little as it can
};
Mesh sweep(const Sweep& shape);

// A round tube of constant radius.
Mesh tube(std::vector<Vec3> path, float radius, std::uint32_t sides, bool closed = false);

// A solid between two copies of the outline (counter-clockwise, in XY) at z = -depth/2 and depth/2, with rounded edges.
// A hole, if any, has as many points as the outline and starts at the same angle.
struct Extrusion {
  std::vector<Vec2> outline;
  std::vector<Vec2> hole;
  float depth = 0.1f;
  float bevel = 0.005f;
};
Mesh extrude(const Extrusion& shape);

// A moulding runs along a closed plan in (x, -z), counter-clockwise seen from above; its profile is (outwards, height).
// Without caps: begin and end the profile inside something, or far inwards.
Mesh moulding(const std::vector<Vec2>& plan, const std::vector<Vec2>& profile);

// Points of a curve, for sweeps. Open curves contain both ends, closed ones do not repeat the first.
std::vector<Vec3> curve(std::uint32_t samples, bool closed, const std::function<Vec3(float along)>& position);
// A smooth curve through the given points.
std::vector<Vec3> smooth_path(const std::vector<Vec3>& through, std::uint32_t samples);

}  // namespace luciole::workshop
