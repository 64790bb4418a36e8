// SPDX-License-Identifier: Apache-2.0
// What a few hundred rays meet, without a hierarchy: for questions that are asked once about a scene that was just
// read.
#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "scene/scene.h"

namespace luciole {

struct SightLine {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};
  float nearest = 0;  // what is no further than this is not met, in lengths of `direction`
};

// The nearest triangle on a line, both sides counted; masked holes are taken for solid.
struct Sight {
  float distance = std::numeric_limits<float>::infinity();  // in lengths of `direction`; infinite: nothing is met
  bool front = false;                                       // its counter-clockwise side is seen
  bool met() const { return distance < std::numeric_limits<float>::infinity(); }
};

// One per line. Passes over all triangles: 0.4 s for 320 lines and 260,000 triangles on two cores.
std::vector<Sight> look_along(const Scene& scene, const std::vector<SightLine>& lines);

// `count` directions, spread evenly over the sphere. Unit.
std::vector<Vec3> even_directions(std::size_t count);

}  // namespace luciole
