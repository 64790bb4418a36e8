// SPDX-License-Identifier: Apache-2.0
// Lathe work: rings, bowls, vessels, bells.
#include <cmath>

#include "scene/recipes/gallery/objects.h"
#include "scene/recipes/placement.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {

Mesh finger_ring(Detail detail) {
  // Flat inside, gently domed outside: a closed profile, so the section is swept round a circle.
  const std::vector<Vec2> section = closed_line({{-0.022f, -0.11f, 0.012f},
                                                 {0.020f, -0.105f, 0.02f},
                                                 {0.036f, 0},
                                                 {0.020f, 0.105f, 0.02f},
                                                 {-0.022f, 0.11f, 0.012f}},
                                                detail.segments(72, 12));
  const auto path = curve(detail.segments(320, 24), true, [](float along) {
    return Vec3{0.55f * std::cos(kTwoPi * along), 0.111f,
                0.55f * std::sin(kTwoPi * along)};  // clockwise: x is outwards
  });
  return sweep({path, true, section, nullptr, Vec3{0, 1, 0}});
}

Mesh bowl(Detail detail) {
  Mesh mesh = lathe(open_line({{0, 0.012f, kCrisp},
                               {0.13f, 0.012f, kCrisp},
                               {0.135f, 0, kCrisp},
                               {0.15f, 0, kCrisp},
                               {0.14f, 0.035f, 0.01f},
                               {0.30f, 0.11f},
                               {0.415f, 0.27f, 0.004f},
                               {0.43f, 0.285f},
                               {0.415f, 0.297f},
                               {0.395f, 0.27f, 0.004f},
                               {0.29f, 0.125f},
                               {0.12f, 0.055f},
                               {0, 0.045f, kCrisp}},
                              detail.segments(140, 24)),
                    detail.segments(224, 20));
  return mesh;
}

Mesh amphora(Detail detail) {
  // Thirty-two flutes fade in and out between shoulder and foot.
  const std::vector<Vec2> profile = open_line({{0, 0, kCrisp},
                                               {0.17f, 0, 0.008f},
                                               {0.175f, 0.05f, 0.01f},
                                               {0.10f, 0.10f},
                                               {0.13f, 0.17f},
                                               {0.30f, 0.55f},
                                               {0.33f, 0.78f},
                                               {0.22f, 1.00f},
                                               {0.105f, 1.14f},
                                               {0.11f, 1.26f},
                                               {0.19f, 1.36f, 0.004f},
                                               {0.185f, 1.375f, 0.004f},
                                               {0.095f, 1.27f},
                                               {0.085f, 1.12f},
                                               {0, 1.02f, kCrisp}},
                                              detail.segments(150, 30));
  const std::uint32_t columns = detail.segments(224, 24);
  Mesh mesh = lathe(profile, columns);
  std::vector<Vec3> points = mesh.positions;
  for (Vec3& p : points) {
    const float zone = std::max(0.0f, 1 - std::abs(p.y - 0.58f) / 0.36f);
    const float flute = 1 - 0.035f * zone * std::abs(std::sin(16 * std::atan2(p.z, p.x)));
    p.x *= flute, p.z *= flute;
  }
  const GridShape shape{columns, static_cast<std::uint32_t>(profile.size() - 1), true, false, {2, 2}};
  mesh = grid_from_points(shape, std::move(points));
  for (const float side : {-1.0f, 1.0f}) {  // handles, ear-shaped
    const auto ear = smooth_path({{side * 0.09f, 1.22f, 0},
                                  {side * 0.22f, 1.27f, 0},
                                  {side * 0.30f, 1.15f, 0},
                                  {side * 0.29f, 0.97f, 0},
                                  {side * 0.25f, 0.88f, 0}},
                                 detail.segments(64, 10));
    append(mesh, sweep({ear, false, rounded_rectangle({0.05f, 0.022f}, 0.009f), nullptr, Vec3{0, 0, 1}}));
  }
  return mesh;
}

Mesh goblet(Detail detail) {
  return lathe(open_line({{0, 0.012f, kCrisp},
                          {0.12f, 0, 0.004f},
                          {0.165f, 0.006f},
                          {0.10f, 0.035f},
                          {0.03f, 0.07f, 0.004f},
                          {0.045f, 0.10f},
                          {0.028f, 0.13f, 0.004f},
                          {0.026f, 0.17f, 0.004f},
                          {0.062f, 0.205f},
                          {0.026f, 0.24f, 0.004f},
                          {0.05f, 0.275f, 0.01f},
                          {0.145f, 0.36f},
                          {0.15f, 0.47f},
                          {0.163f, 0.54f, 0.002f},
                          {0.157f, 0.54f, 0.002f},
                          {0.142f, 0.47f},
                          {0.13f, 0.36f},
                          {0, 0.295f, kCrisp}},
                         detail.segments(150, 30)),
               detail.segments(128, 16));
}

Mesh bell(Detail detail) {
  Mesh mesh = lathe(open_line({{0, 0.70f, kCrisp},
                               {0.13f, 0.68f},
                               {0.20f, 0.56f},
                               {0.25f, 0.28f},
                               {0.36f, 0.05f, 0.004f},
                               {0.37f, 0.0f, 0.008f},
                               {0.405f, 0.0f, 0.008f},
                               {0.41f, 0.05f, 0.004f},
                               {0.315f, 0.25f, 0.004f},
                               {0.318f, 0.275f, 0.004f},
                               {0.30f, 0.28f, 0.004f},
                               {0.24f, 0.60f, 0.004f},
                               {0.245f, 0.615f, 0.004f},
                               {0.225f, 0.63f, 0.004f},
                               {0.15f, 0.735f},
                               {0, 0.75f, kCrisp}},
                              detail.segments(120, 30)),
                    detail.segments(160, 16));
  const auto loop = curve(detail.segments(48, 10), true, [](float along) {
    return Vec3{0.075f * std::cos(kTwoPi * along), 0.81f + 0.075f * std::sin(kTwoPi * along), 0};
  });
  append(mesh, tube(loop, 0.024f, detail.segments(20), true));
  append(mesh, lathe(open_line({{0, -0.06f, kCrisp},
                                {0.055f, -0.03f},
                                {0.05f, 0.03f},
                                {0.015f, 0.09f, kCrisp},
                                {0.012f, 0.69f, kCrisp},
                                {0, 0.69f, kCrisp}},
                               detail.segments(30)),
                     detail.segments(40)));
  return mesh;
}

Mesh mirror_dish(Detail detail) {
  // A spherical cap: 0.62 m wide at the rim and 0.06 m deep has a radius of 3.2 m.
  return lathe(open_line({{0, 0, kCrisp},
                          {0.62f, 0.012f, 0.01f},
                          {0.70f, 0.06f},
                          {0.69f, 0.115f},
                          {0.64f, 0.105f, 0.006f},
                          {0.62f, 0.090f, 0.003f},
                          {0.50f, 0.069f},
                          {0.35f, 0.0491f},
                          {0.20f, 0.0362f},
                          {0.10f, 0.0316f},
                          {0, 0.03f, kCrisp}},
                         detail.segments(120, 24)),
               detail.segments(200, 20));
}

Mesh candlestick(Detail detail) {
  return lathe(
      open_line({{0, 0.01f, kCrisp},      {0.15f, 0, 0.006f},       {0.155f, 0.03f, 0.006f},  {0.09f, 0.06f},
                 {0.035f, 0.11f, 0.004f}, {0.055f, 0.14f},          {0.03f, 0.17f, 0.004f},   {0.025f, 0.25f},
                 {0.045f, 0.36f},         {0.022f, 0.47f, 0.003f},  {0.05f, 0.50f},           {0.022f, 0.53f, 0.003f},
                 {0.028f, 0.60f, 0.003f}, {0.095f, 0.625f, 0.004f}, {0.095f, 0.635f, 0.004f}, {0.03f, 0.63f, 0.003f},
                 {0.036f, 0.70f, 0.003f}, {0.028f, 0.70f, 0.003f},  {0.026f, 0.645f, kCrisp}, {0, 0.645f, kCrisp}},
                detail.segments(150, 30)),
      detail.segments(96, 14));
}

Mesh kettle(Detail detail) {
  Mesh mesh = lathe(open_line({{0, 0.004f, kCrisp},
                               {0.19f, 0, 0.015f},
                               {0.265f, 0.11f},
                               {0.22f, 0.25f},
                               {0.125f, 0.315f, 0.004f},
                               {0.13f, 0.33f, 0.004f},
                               {0.115f, 0.345f, 0.004f},
                               {0.06f, 0.375f},
                               {0.022f, 0.385f, 0.004f},
                               {0.02f, 0.405f, 0.004f},
                               {0.042f, 0.43f},
                               {0, 0.455f, kCrisp}},
                              detail.segments(130, 24)),
                    detail.segments(192, 18));
  const auto spout =
      smooth_path({{0.20f, 0.11f, 0}, {0.29f, 0.13f, 0}, {0.335f, 0.20f, 0}, {0.36f, 0.28f, 0}, {0.42f, 0.325f, 0}},
                  detail.segments(72, 10));
  append(mesh, sweep({spout, false, circle(0.052f, detail.segments(48)), [](float along) { return 1 - 0.62f * along; },
                      Vec3{0, 0, 1}}));
  const auto handle = curve(detail.segments(96, 12), false, [](float along) {
    const float angle = radians(18) + radians(144) * along;
    return Vec3{0.225f * std::cos(angle), 0.19f + 0.36f * std::sin(angle), 0};
  });
  append(mesh, sweep({handle, false, rounded_rectangle({0.030f, 0.020f}, 0.008f),
                      [](float along) { return 0.8f + 0.9f * std::sin(kPi * along); }, Vec3{0, 0, 1}}));
  return mesh;
}

}  // namespace luciole::workshop::gallery
