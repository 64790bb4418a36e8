// SPDX-License-Identifier: Apache-2.0
// Garden chess: pieces of the common tournament shape, about a metre high.
#include <cmath>

#include "scene/recipes/gallery/objects.h"
#include "scene/recipes/placement.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {
namespace {

// Foot and stem that all pieces share, up to the collar at height `collar` with radius `neck`.
std::vector<Knot> foot(float base, float neck, float collar) {
  return {{0, 0, kCrisp},
          {base, 0, 0.008f},
          {base * 1.02f, 0.05f},
          {base * 0.98f, 0.085f, 0.006f},
          {base * 0.90f, 0.09f, 0.004f},
          {base * 0.86f, 0.125f},
          {base * 0.72f, 0.15f, 0.006f},
          {base * 0.66f, 0.155f, 0.004f},
          {base * 0.48f, 0.24f},
          {neck, collar - 0.05f, 0.006f},
          {neck * 1.75f, collar - 0.03f},
          {neck * 1.6f, collar - 0.005f, 0.004f},
          {neck * 1.15f, collar + 0.005f, 0.004f},
          {neck * 1.4f, collar + 0.025f},
          {neck * 1.1f, collar + 0.045f, 0.004f}};
}

Mesh turned(std::vector<Knot> knots, const std::vector<Knot>& head, Detail detail) {
  knots.insert(knots.end(), head.begin(), head.end());
  return lathe(open_line(knots, detail.segments(150, 40)), detail.segments(112, 16));
}

}  // namespace

Mesh chess_king(Detail detail) {
  Mesh mesh = turned(foot(0.20f, 0.062f, 0.68f),
                     {{0.085f, 0.78f},
                      {0.125f, 0.92f, 0.006f},
                      {0.12f, 0.94f, 0.006f},
                      {0.07f, 0.965f},
                      {0.02f, 0.985f},
                      {0, 0.99f, kCrisp}},
                     detail);
  constexpr float kRound = 0.007f;
  const std::vector<Vec2> cross = closed_line({{-0.018f, 0, kRound},
                                               {0.018f, 0, kRound},
                                               {0.014f, 0.045f, kRound},
                                               {0.055f, 0.040f, kRound},
                                               {0.055f, 0.080f, kRound},
                                               {0.014f, 0.075f, kRound},
                                               {0.022f, 0.125f, kRound},
                                               {-0.022f, 0.125f, kRound},
                                               {-0.014f, 0.075f, kRound},
                                               {-0.055f, 0.080f, kRound},
                                               {-0.055f, 0.040f, kRound},
                                               {-0.014f, 0.045f, kRound}},
                                              24);
  append(mesh, extrude({cross, {}, 0.034f, 0.004f}), translate({0, 0.975f, 0}));
  return mesh;
}

Mesh chess_queen(Detail detail) {
  const std::vector<Vec2> profile = open_line(
      [] {
        std::vector<Knot> knots = foot(0.19f, 0.058f, 0.62f);
        const std::vector<Knot> head = {{0.075f, 0.72f},          {0.125f, 0.85f, 0.004f}, {0.115f, 0.855f, 0.004f},
                                        {0.085f, 0.815f, 0.004f}, {0.05f, 0.84f},          {0.026f, 0.855f, 0.004f},
                                        {0.035f, 0.885f},         {0, 0.92f, kCrisp}};
        knots.insert(knots.end(), head.begin(), head.end());
        return knots;
      }(),
      detail.segments(150, 40));
  const std::uint32_t columns = detail.segments(144, 24);
  std::vector<Vec3> points = lathe(profile, columns).positions;
  for (Vec3& p : points) {  // ten points round the coronet
    const float rim = std::max(0.0f, 1 - std::abs(p.y - 0.853f) / 0.05f) * (p.x * p.x + p.z * p.z > 0.0064f ? 1 : 0);
    p.y += 0.028f * rim * std::cos(10 * std::atan2(p.z, p.x));
  }
  return grid_from_points({columns, static_cast<std::uint32_t>(profile.size() - 1), true, false, {1, 1}},
                          std::move(points));
}

Mesh chess_bishop(Detail detail) {
  return turned(foot(0.175f, 0.05f, 0.52f),
                {{0.062f, 0.58f},
                 {0.088f, 0.66f},
                 {0.06f, 0.75f},
                 {0.02f, 0.795f, 0.004f},
                 {0.032f, 0.825f},
                 {0, 0.852f, kCrisp}},
                detail);
}

Mesh chess_rook(Detail detail) {
  Mesh mesh = turned(foot(0.185f, 0.085f, 0.44f),
                     {{0.10f, 0.52f, 0.006f},
                      {0.135f, 0.54f, 0.006f},
                      {0.135f, 0.60f, kCrisp},
                      {0.09f, 0.60f, kCrisp},
                      {0.09f, 0.56f, kCrisp},
                      {0, 0.56f, kCrisp}},
                     detail);
  for (int merlon = 0; merlon < 6; ++merlon) {  // battlements: sixths of a ring, less the gaps
    const auto arc = curve(detail.segments(12, 4) + 1, false, [&](float along) {
      const float angle = radians(60) * static_cast<float>(merlon) + radians(40) * along;
      return Vec3{0.1125f * std::cos(angle), 0.625f, -0.1125f * std::sin(angle)};
    });
    append(mesh, sweep({arc, false, rounded_rectangle({0.045f, 0.055f}, 0.005f), nullptr, Vec3{0, 1, 0}}));
  }
  return mesh;
}

Mesh chess_pawn(Detail detail) {
  return turned(foot(0.155f, 0.05f, 0.36f),
                {{0.05f, 0.415f, 0.01f}, {0.085f, 0.455f}, {0.09f, 0.50f}, {0.055f, 0.565f}, {0, 0.585f, kCrisp}},
                detail);
}

}  // namespace luciole::workshop::gallery
