// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "scene/recipes/gallery/objects.h"
#include "scene/recipes/placement.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {
namespace {

constexpr float kInner = 0.09f, kOuter = 0.98f, kTurn = 1.35f;  // radii [m], whole turns

// A wedge-shaped tread, its upper side at y = 0, spanning `angle` round the y axis.
Mesh tread(float angle) {
  std::vector<Vec2> outline;
  for (const float t : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    outline.push_back({kOuter * std::cos(angle * t), kOuter * std::sin(angle * t)});
  }
  for (const float t : {1.0f, 0.0f}) outline.push_back({kInner * std::cos(angle * t), kInner * std::sin(angle * t)});
  return placed(extrude({outline, {}, 0.04f, 0.006f}), translate({0, -0.02f, 0}) * rotate_x(-kPi / 2));
}

Mesh baluster(float height, Detail detail) {
  return lathe(open_line({{0, 0, kCrisp},
                          {0.022f, 0, 0.003f},
                          {0.022f, 0.03f, 0.003f},
                          {0.010f, 0.06f},
                          {0.012f, 0.25f * height},
                          {0.024f, 0.42f * height},
                          {0.010f, 0.55f * height, 0.003f},
                          {0.018f, 0.58f * height},
                          {0.010f, 0.61f * height, 0.003f},
                          {0.009f, height - 0.02f},
                          {0.014f, height, kCrisp}},
                         detail.segments(30, 12)),
               detail.segments(14, 7));
}

// Where the steps end: a platform and its railing, along +x, on the side of -z.
Mesh landing(float rail, Detail detail) {
  constexpr float kLength = 1.5f;
  Mesh mesh = placed(rounded_box({kLength, 0.05f, kOuter}, 0.008f), translate({kLength / 2, -0.025f, -kOuter / 2}));
  const Mesh one_baluster = baluster(rail, detail);
  for (int k = 0; k < 10; ++k) {
    append(mesh, one_baluster, translate({0.05f + 0.15f * static_cast<float>(k), 0, 0.04f - kOuter}));
  }
  append(mesh, tube({{0, rail, 0.04f - kOuter}, {kLength, rail, 0.04f - kOuter}}, 0.026f, detail.segments(24)));
  return mesh;
}

}  // namespace

Mesh spiral_staircase(float height, Detail detail) {
  constexpr int kSteps = 19;
  constexpr float kRail = 0.92f;
  const float step_turn = kTwoPi * kTurn / kSteps, rise = height / kSteps;
  Mesh mesh = lathe(open_line({{0, 0, kCrisp},
                               {0.2f, 0, 0.01f},
                               {0.2f, 0.04f, 0.01f},
                               {kInner, 0.10f, 0.01f},
                               {kInner, height + kRail, 0.005f},
                               {0.13f, height + kRail + 0.03f, 0.005f},
                               {0.10f, height + kRail + 0.15f},
                               {0, height + kRail + 0.21f, kCrisp}},
                              detail.segments(40, 16)),
                    detail.segments(48, 10));
  const Mesh one_tread = tread(1.06f * step_turn), one_baluster = baluster(kRail, detail);
  for (int step = 0; step < kSteps; ++step) {
    const Affine place =
        translate({0, rise * static_cast<float>(step + 1), 0}) * rotate_y(step_turn * static_cast<float>(step));
    append(mesh, one_tread, place);
    for (const float t : {0.17f, 0.67f}) {
      const float angle = t * step_turn;
      append(mesh, one_baluster,
             place * translate({0.94f * std::cos(angle), rise * (t - 0.5f) * 0.5f, -0.94f * std::sin(angle)}));
    }
  }
  const auto helix = [&](float radius, float lift) {
    return curve(detail.segments(240, 40), false, [=](float along) {
      const float angle = step_turn * kSteps * along;
      return Vec3{radius * std::cos(angle), rise * (0.6f + kSteps * along) + lift, -radius * std::sin(angle)};
    });
  };
  append(mesh, tube(helix(0.94f, kRail), 0.026f, detail.segments(24)));
  append(mesh, sweep({helix(0.99f, -0.10f), false, rounded_rectangle({0.02f, 0.22f}, 0.006f), nullptr, Vec3{0, 1, 0}}));
  append(mesh, landing(kRail, detail), translate({0, height, 0}) * rotate_y(step_turn * kSteps));
  return mesh;
}

}  // namespace luciole::workshop::gallery
