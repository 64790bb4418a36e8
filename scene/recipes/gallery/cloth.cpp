// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "scene/recipes/gallery/objects.h"
#include "scene/recipes/placement.h"

namespace luciole::workshop::gallery {

// Flat on the table, over a soft edge, then falling in folds that deepen downwards. Folds of a hanging round cloth take
// up its spare length: they grow with the distance from the edge, and no two are alike.
Mesh table_cloth(float table_radius, float table_height, Detail detail) {
  const std::uint32_t columns = detail.segments(360, 48), rows = detail.segments(80, 16);
  const float hang = 0.86f * table_height, edge = 0.05f, top = table_radius - edge;
  const float arc = edge * kPi / 2, whole = top + arc + hang;
  return grid_surface({columns, rows, true, false, {3, whole}}, [=](float u, float v) {
    const float angle = kTwoPi * u, s = whole * (1 - v);  // from the hem inwards: the front is outside
    // Ridges are rounder than the valleys between them.
    const float main = std::sin(11 * angle + 1.4f * std::sin(2 * angle) + 0.8f * std::sin(3 * angle));
    const float wave =
        1.3f * (1 - 2 * std::pow(0.5f - 0.5f * main, 1.5f)) + 0.35f * std::sin(19 * angle + 2 * std::sin(3 * angle));
    float r = s, y = table_height + 0.004f;
    if (s > top + arc) {
      const float down = (s - top - arc) / hang;
      const float spread = 0.02f + 0.19f * down;
      r = table_radius + spread * (0.60f + 0.42f * wave * std::min(1.0f, 1.6f * down + 0.1f));
      y = table_height - edge - hang * down + 0.012f * wave * down;
    } else if (s > top) {
      const float turn = (s - top) / edge;
      r = top + edge * std::sin(turn), y = table_height - edge * (1 - std::cos(turn)) + 0.004f;
    }
    return v == 1 ? Vec3{0, y, 0} : Vec3{r * std::cos(angle), y, -r * std::sin(angle)};
  });
}

}  // namespace luciole::workshop::gallery
