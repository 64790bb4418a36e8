// SPDX-License-Identifier: Apache-2.0
// Plate work: gears, a crown, letters.
#include <algorithm>
#include <cmath>

#include "scene/recipes/gallery/objects.h"
#include "scene/recipes/placement.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {
namespace {

Vec2 polar(float radius, float angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

// Smooth knots along an ellipse's arc, both ends included, one every 15 degrees or so.
void add_arc(std::vector<Knot>& knots, Vec2 centre, Vec2 half_axes, float from_degrees, float to_degrees) {
  const auto steps = static_cast<int>(std::ceil(std::abs(to_degrees - from_degrees) / 15));
  for (int i = 0; i <= steps; ++i) {
    const float angle = radians(std::lerp(from_degrees, to_degrees, static_cast<float>(i) / static_cast<float>(steps)));
    knots.push_back({centre.x + half_axes.x * std::cos(angle), centre.y + half_axes.y * std::sin(angle)});
  }
}

std::vector<Vec2> ellipse(Vec2 half_axes, std::uint32_t samples) {
  std::vector<Vec2> line = circle(1, samples);
  for (Vec2& p : line) p = Vec2{0.5f, 0.5f} + p * half_axes;
  return line;
}

// Corners are rounder than the bevel is wide, so that the bevelled outline does not cross itself.
constexpr float kStem = 0.19f, kRound = 0.035f, kBevel = 0.022f;

std::vector<Vec2> polygon(const std::vector<Vec2>& corners) {
  std::vector<Knot> knots;
  for (const Vec2 p : corners) knots.push_back({p.x, p.y, kRound});
  return closed_line(knots, 8);
}

std::vector<Vec2> letter_u(std::uint32_t samples) {
  std::vector<Knot> knots = {{kStem, 1, kRound}, {0, 1, kRound}, {0, 0.45f}};
  add_arc(knots, {0.36f, 0.36f}, {0.36f, 0.375f}, 180, 360);
  const std::vector<Knot> right = {{0.72f, 0.45f}, {0.72f, 1, kRound}, {0.53f, 1, kRound}, {0.53f, 0.45f}};
  knots.insert(knots.end(), right.begin(), right.end());
  add_arc(knots, {0.36f, 0.36f}, {0.17f, 0.185f}, 360, 180);
  knots.push_back({kStem, 0.45f});
  return closed_line(knots, 4 * samples);
}

std::vector<Vec2> letter_c(std::uint32_t samples) {
  std::vector<Knot> knots;
  for (const bool outer : {true, false}) {
    const std::size_t first = knots.size();
    const Vec2 half_axes = outer ? Vec2{0.47f, 0.515f} : Vec2{0.28f, 0.325f};
    add_arc(knots, {0.47f, 0.5f}, half_axes, outer ? 48 : 312, outer ? 312 : 48);
    knots[first].rounding = knots.back().rounding = kRound;
  }
  return closed_line(knots, 4 * samples);
}

struct Letter {
  std::vector<Vec2> outline, hole;
  float advance;  // width with its space
};

// Capitals of unit height in a plain bold hand.
Letter letter(char name, std::uint32_t samples) {
  switch (name) {
    case 'L':
      return {polygon({{0, 0}, {0.58f, 0}, {0.58f, kStem}, {kStem, kStem}, {kStem, 1}, {0, 1}}), {}, 0.68f};
    case 'E':
      return {polygon({{0, 0},
                       {0.60f, 0},
                       {0.60f, 0.18f},
                       {kStem, 0.18f},
                       {kStem, 0.41f},
                       {0.52f, 0.41f},
                       {0.52f, 0.59f},
                       {kStem, 0.59f},
                       {kStem, 0.82f},
                       {0.60f, 0.82f},
                       {0.60f, 1},
                       {0, 1}}),
              {},
              0.72f};
    case 'U':
      return {letter_u(samples), {}, 0.85f};
    case 'C':
      return {letter_c(samples), {}, 0.92f};
    case 'O':
      return {ellipse({0.5f, 0.515f}, 2 * samples), ellipse({0.31f, 0.325f}, 2 * samples), 1.12f};
    default:
      return {polygon({{0, 0}, {kStem, 0}, {kStem, 1}, {0, 1}}), {}, 0.32f};
  }
}

}  // namespace

Mesh gear(std::uint32_t teeth, float radius, float thickness, Detail detail) {
  std::vector<Vec2> rim, bore;
  const float pitch = kTwoPi / static_cast<float>(teeth), deep = 0.75f * pitch * radius;
  const std::uint32_t flank = detail.segments(3, 1);
  for (std::uint32_t tooth = 0; tooth < teeth; ++tooth) {
    const float start = pitch * static_cast<float>(tooth);
    for (std::uint32_t i = 0; i < flank; ++i) {  // root, rising flank, tip, falling flank
      const float t = static_cast<float>(i) / static_cast<float>(flank);
      rim.push_back(polar(radius - deep, start + pitch * 0.24f * t));
    }
    for (std::uint32_t i = 0; i < flank; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(flank);
      rim.push_back(polar(radius - deep * (1 - t), start + pitch * (0.24f + 0.15f * std::sqrt(t))));
    }
    for (std::uint32_t i = 0; i < flank; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(flank);
      rim.push_back(polar(radius, start + pitch * (0.39f + 0.22f * t)));
    }
    for (std::uint32_t i = 0; i < flank; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(flank);
      rim.push_back(polar(radius - deep * t, start + pitch * (0.61f + 0.15f * (1 - std::sqrt(1 - t)))));
    }
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    bore.push_back(polar(0.66f * radius, kTwoPi * static_cast<float>(i) / static_cast<float>(rim.size())));
  }
  Mesh mesh = extrude({rim, bore, thickness, 0.04f * thickness});
  const auto ring = circle(0.26f * radius, detail.segments(64));
  append(mesh, extrude({ring, circle(0.12f * radius, detail.segments(64)), 1.35f * thickness, 0.08f * thickness}));
  for (int spoke = 0; spoke < 6; ++spoke) {
    append(mesh, rounded_box({0.46f * radius, 0.13f * radius, 0.6f * thickness}, 0.1f * thickness),
           rotate_z(kTwoPi * static_cast<float>(spoke) / 6) * translate({0.46f * radius, 0, 0}));
  }
  return placed(mesh, translate({0, radius, 0}));
}

Mesh crown(Detail detail) {
  constexpr int kPoints = 8;
  const std::uint32_t columns = detail.segments(320, 48), rows = detail.segments(28, 6);
  // A band that flares upwards, its upper edge cut into points; there and back again, so that it is closed.
  const auto edge = [](float u) {
    const float wave = std::abs(2 * (u * kPoints - std::floor(u * kPoints)) - 1);
    return 0.10f + 0.13f * std::pow(wave, 1.4f);
  };
  Mesh mesh = grid_surface({columns, 2 * rows, true, true, {1, 1}}, [&](float u, float v) {
    const bool outside = v < 0.5f;
    const float t = outside ? 2 * v : 2 - 2 * v, y = t * edge(u), lip = 0.008f * std::sin(kPi * t);
    const float r = 0.17f + 0.28f * y * y / 0.25f + (outside ? 0.004f + lip : -0.004f);
    return Vec3{r * std::cos(kTwoPi * u), y, -r * std::sin(kTwoPi * u)};
  });
  for (const float height : {0.012f, 0.075f}) {  // two beaded hoops
    const float r = 0.177f + 1.12f * height * height;
    append(mesh, tube(curve(columns / 2, true,
                            [=](float along) {
                              return Vec3{r * std::cos(kTwoPi * along), height, -r * std::sin(kTwoPi * along)};
                            }),
                      0.011f, detail.segments(16), true));
  }
  const Mesh bead =
      lathe(open_line({{0, -0.022f, kCrisp}, {0.0156f, -0.0156f}, {0.022f, 0}, {0.0156f, 0.0156f}, {0, 0.022f, kCrisp}},
                      detail.segments(20)),
            detail.segments(24));
  for (int point = 0; point < kPoints; ++point) {
    const float angle = kTwoPi * static_cast<float>(point) / kPoints, r = 0.17f + 1.12f * 0.23f * 0.23f;
    append(mesh, bead, translate({r * std::cos(angle), 0.245f, -r * std::sin(angle)}));
    append(mesh, bead, translate({0.192f * std::cos(angle + 0.39f), 0.044f, -0.192f * std::sin(angle + 0.39f)}));
  }
  return mesh;
}

Mesh letters(const std::string& word, float height, Detail detail) {
  const std::uint32_t samples = detail.segments(56, 8);
  float total = 0;
  for (const char name : word) total += letter(name, samples).advance;
  Mesh mesh;
  float at = -total / 2;
  for (const char name : word) {
    const Letter shape = letter(name, samples);
    append(mesh, extrude({shape.outline, shape.hole, 0.26f, kBevel}),
           scale({height, height, height}) * translate({at, 0, 0}));
    at += shape.advance;
  }
  return mesh;
}

}  // namespace luciole::workshop::gallery
