// SPDX-License-Identifier: Apache-2.0
// Drawn lines in a plane: profiles for the lathe, outlines for the extruder, plans for mouldings.
#pragma once
#include <vector>

#include "base/vector.h"

namespace luciole::workshop {

// A point that the line goes through: smoothly, or with a corner that is rounded off by `rounding` [m].
struct Knot {
  float x = 0, y = 0;
  float rounding = -1;  // negative: smooth
};
// Corner, to be read in lists of knots: {0.2f, 0.1f, kCrisp}.
inline constexpr float kCrisp = 0.003f;

// The open line as a polyline of about `samples` segments; the ends are corners. Straight stretches get one segment.
std::vector<Vec2> open_line(const std::vector<Knot>& knots, std::uint32_t samples);

// The closed line; the first point is not repeated at the end.
std::vector<Vec2> closed_line(std::vector<Knot> knots, std::uint32_t samples);

std::vector<Vec2> circle(float radius, std::uint32_t samples);
std::vector<Vec2> rounded_rectangle(Vec2 size, float rounding);  // round the origin, counter-clockwise

// Every point moved by `distance` to the right of the line's direction: outwards for counter-clockwise loops.
std::vector<Vec2> moved_outwards(const std::vector<Vec2>& loop, float distance);

}  // namespace luciole::workshop
