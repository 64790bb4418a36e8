// SPDX-License-Identifier: Apache-2.0
// Tubes and bands along curves: knot, spring, trumpet, armillary sphere, chain, and the bottle with one side.
#include <cmath>

#include "scene/recipes/gallery/objects.h"
#include "scene/recipes/placement.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {

Mesh torus_knot(Detail detail) {
  // Winds 2 times round the axis and 3 times round the ring: a trefoil, standing upright.
  const auto path = curve(detail.segments(400, 48), true, [](float along) {
    const float angle = kTwoPi * along, r = 0.30f + 0.125f * std::cos(3 * angle);
    return Vec3{r * std::cos(2 * angle), 0.50f + r * std::sin(2 * angle), 0.16f * std::sin(3 * angle)};
  });
  return tube(path, 0.072f, detail.segments(56, 8), true);
}

Mesh coil_spring(Detail detail) {
  constexpr float kTurns = 9, kHeight = 0.95f, kWire = 0.028f;
  const auto path = curve(detail.segments(640, 90), false, [](float along) {
    const float angle = kTwoPi * kTurns * along;
    const float rise = along < 0.1f ? 0 : (along > 0.9f ? 1 : (along - 0.1f) / 0.8f);  // closed ends
    const float wound = 2.1f * kWire * (along < 0.1f ? along * 10 - 1 : (along > 0.9f ? along * 10 - 9 : 0));
    return Vec3{0.2f * std::cos(angle), kWire + 2.1f * kWire + (kHeight - 6 * kWire) * rise + wound,
                0.2f * std::sin(angle)};
  });
  return tube(path, kWire, detail.segments(32, 8));
}

Mesh trumpet(Detail detail) {
  // One long tube: mouthpiece, once round the oval, and out to the bell.
  const float r = 0.085f;
  std::vector<Vec3> through = {{-0.62f, 0, 0}, {-0.4f, 0, 0}, {-0.1f, 0, 0}, {0.2f, 0, 0}, {0.36f, -0.01f, 0}};
  for (const float degrees : {45.0f, 90.0f, 135.0f}) {  // the front bow, downwards
    through.push_back({0.40f + r * std::sin(radians(degrees)), -r + r * std::cos(radians(degrees)), 0.02f});
  }
  for (const float x : {0.3f, 0.1f, -0.1f, -0.22f}) through.push_back({x, -2 * r, 0.045f});
  for (const float degrees : {45.0f, 90.0f, 135.0f}) {  // the back bow, upwards
    through.push_back({-0.28f - r * std::sin(radians(degrees)), -r - r * std::cos(radians(degrees)), 0.06f});
  }
  for (const float x : {-0.2f, 0.0f, 0.25f, 0.5f, 0.62f, 0.72f}) through.push_back({x, 0, 0.065f});
  const auto width = [](float along) {
    const float flare = std::max(0.0f, (along - 0.72f) / 0.28f);
    return 1 + 0.5f * along + 7.5f * std::pow(flare, 3.2f) + (along < 0.012f ? 0.9f : 0);
  };
  Mesh mesh = sweep({smooth_path(through, detail.segments(420, 60)), false, circle(0.014f, detail.segments(48, 8)),
                     width, Vec3{0, 0, 1}});
  for (const float x : {-0.04f, 0.025f, 0.09f}) {  // valves
    append(mesh,
           lathe(open_line({{0, -0.24f, kCrisp},
                            {0.024f, -0.24f, 0.004f},
                            {0.024f, 0.02f, 0.004f},
                            {0.027f, 0.025f, 0.003f},
                            {0.027f, 0.045f, 0.003f},
                            {0.006f, 0.05f, kCrisp},
                            {0.006f, 0.085f, kCrisp},
                            {0.016f, 0.09f, 0.002f},
                            {0.016f, 0.097f, 0.002f},
                            {0, 0.098f, kCrisp}},
                           detail.segments(40)),
                 detail.segments(32)),
           translate({x, 0, 0.032f}));
  }
  return mesh;
}

Mesh armillary_sphere(Detail detail) {
  const std::uint32_t around = detail.segments(128, 20);
  const auto band = [&](float radius, float width) {
    const auto path = curve(around, true, [=](float along) {
      return Vec3{radius * std::cos(kTwoPi * along), 0, -radius * std::sin(kTwoPi * along)};
    });
    return sweep({path, true, rounded_rectangle({0.012f, width}, 0.004f), nullptr, Vec3{0, 1, 0}});
  };
  Mesh rings;
  append(rings, band(0.46f, 0.055f), rotate_x(kPi / 2));                                 // meridian
  append(rings, band(0.47f, 0.07f));                                                     // horizon
  append(rings, band(0.43f, 0.03f), rotate_z(radians(38)));                              // equator
  append(rings, band(0.415f, 0.06f), rotate_z(radians(38)) * rotate_x(radians(23.5f)));  // ecliptic
  append(rings, band(0.43f, 0.03f), rotate_z(radians(38)) * rotate_x(kPi / 2));          // colures
  append(rings, band(0.43f, 0.03f), rotate_z(radians(38)) * rotate_y(kPi / 2) * rotate_x(kPi / 2));
  for (const float side : {-1.0f, 1.0f}) {  // tropics
    append(rings, band(0.395f, 0.022f), rotate_z(radians(38)) * translate({0, side * 0.17f, 0}));
  }
  const Vec3 pole{-std::sin(radians(38)) * 0.52f, std::cos(radians(38)) * 0.52f, 0};
  append(rings, tube({-pole, pole}, 0.008f, detail.segments(16)));
  append(rings,
         lathe(open_line({{0, -0.09f, kCrisp}, {0.064f, -0.064f}, {0.09f, 0}, {0.064f, 0.064f}, {0, 0.09f, kCrisp}},
                         detail.segments(48)),
               detail.segments(80)));
  Mesh mesh = lathe(open_line({{0, 0, kCrisp},
                               {0.24f, 0, 0.006f},
                               {0.245f, 0.03f, 0.006f},
                               {0.15f, 0.06f},
                               {0.05f, 0.11f, 0.004f},
                               {0.075f, 0.15f},
                               {0.035f, 0.20f, 0.004f},
                               {0.03f, 0.30f},
                               {0.06f, 0.345f, 0.004f},
                               {0.03f, 0.38f, 0.004f},
                               {0, 0.385f, kCrisp}},
                              detail.segments(72)),
                    detail.segments(96));
  for (int arm = 0; arm < 4; ++arm) {  // the cradle
    append(mesh,
           tube(curve(detail.segments(40), false,
                      [](float along) {
                        const float angle = radians(-86) + radians(86) * along;
                        return Vec3{0.49f * std::cos(angle), 0.86f + 0.49f * std::sin(angle), 0};
                      }),
                0.011f, detail.segments(16)),
           rotate_y(radians(45 + 90 * static_cast<float>(arm))));
  }
  append(mesh, rings, translate({0, 0.86f, 0}));
  return mesh;
}

Mesh klein_bottle(Detail detail) {
  // The neck bends over, passes through the side and meets the foot from inside: one surface without an inside.
  const std::vector<Vec3> axis = {{0, 0.0f, 0},      {0, 0.16f, 0},     {0, 0.34f, 0},     {0.01f, 0.52f, 0},
                                  {0.05f, 0.70f, 0}, {0.15f, 0.82f, 0}, {0.27f, 0.80f, 0}, {0.315f, 0.68f, 0},
                                  {0.28f, 0.54f, 0}, {0.19f, 0.42f, 0}, {0.09f, 0.31f, 0}, {0.02f, 0.18f, 0},
                                  {0, 0.06f, 0},     {0, 0.0f, 0}};
  const std::vector<Vec3> radius = {{0.155f, 0, 0}, {0.25f, 0, 0},  {0.275f, 0, 0}, {0.21f, 0, 0}, {0.12f, 0, 0},
                                    {0.078f, 0, 0}, {0.07f, 0, 0},  {0.066f, 0, 0}, {0.06f, 0, 0}, {0.056f, 0, 0},
                                    {0.055f, 0, 0}, {0.065f, 0, 0}, {0.105f, 0, 0}, {0.155f, 0, 0}};
  const std::uint32_t rows = detail.segments(300, 40), sides = detail.segments(96, 12);
  const auto path = smooth_path(axis, rows + 1), width = smooth_path(radius, rows + 1);
  std::vector<Vec3> points;
  for (std::size_t j = 0; j <= rows; ++j) {
    const Vec3 ahead = path[std::min<std::size_t>(j + 1, rows)] - path[j > 0 ? j - 1 : 0];
    const Vec3 along = normalize(ahead), across{0, 0, 1}, up = cross(along, across);
    for (std::uint32_t i = 0; i <= sides; ++i) {
      const float angle = kTwoPi * static_cast<float>(i % sides) / static_cast<float>(sides);
      points.push_back(path[j] + (across * std::cos(angle) + up * std::sin(angle)) * width[j].x);
    }
  }
  return grid_from_points({sides, rows, true, false, {1, 1}}, std::move(points));
}

Mesh chain(Vec3 a, Vec3 b, float sag, Detail detail) {
  constexpr float kWire = 0.0085f, kLong = 0.046f, kWide = 0.017f;  // a link's wire, and its half axes [m]
  const auto hang = [&](float t) { return a + (b - a) * t - Vec3{0, 4 * sag * t * (1 - t), 0}; };
  const auto line = curve(257, false, hang);
  float total = 0;
  for (std::size_t i = 1; i < line.size(); ++i) total += length(line[i] - line[i - 1]);
  const auto links = static_cast<std::uint32_t>(total / (2 * (kLong - kWire)));
  const auto oval = curve(detail.segments(28, 8), true, [](float along) {
    const float c = std::cos(kTwoPi * along), s = std::sin(kTwoPi * along);
    return Vec3{(kLong - kWide) * (c > 0 ? 1.0f : -1.0f) * std::min(1.0f, 3 * std::abs(c)) + kWide * c, kWide * s, 0};
  });
  const Mesh link = tube(oval, kWire, detail.segments(12), true);
  Mesh mesh;
  for (std::uint32_t k = 0; k < links; ++k) {
    const float t = (static_cast<float>(k) + 0.5f) / static_cast<float>(links);
    const Vec3 x = normalize(hang(t + 0.01f) - hang(t - 0.01f)), side = normalize(cross(x, Vec3{0, 1, 0}));
    const Vec3 y = k % 2 == 0 ? cross(side, x) : side;
    append(mesh, link, {x, y, cross(x, y), hang(t)});
  }
  return mesh;
}

}  // namespace luciole::workshop::gallery
