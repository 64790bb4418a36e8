// SPDX-License-Identifier: Apache-2.0
// Engaged columns under every springing point of the vault.
#include "scene/recipes/gallery/hall.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {
namespace {

Mesh column(Detail detail) {
  const float top = kSpringing;
  Mesh whole = lathe(open_line({{0.42f, 0.30f, kCrisp},
                                {0.45f, 0.36f},  // torus
                                {0.41f, 0.42f, kCrisp},
                                {0.36f, 0.44f, kCrisp},  // scotia
                                {0.335f, 0.49f},
                                {0.36f, 0.53f, kCrisp},
                                {0.385f, 0.555f},
                                {0.36f, 0.585f, kCrisp},
                                {0.315f, 0.60f, kCrisp},
                                {0.30f, 0.68f},
                                {0.30f, 1.9f},  // entasis
                                {0.26f, top - 0.62f},
                                {0.27f, top - 0.56f, kCrisp},
                                {0.295f, top - 0.54f},
                                {0.27f, top - 0.515f, kCrisp},
                                {0.265f, top - 0.45f, kCrisp},
                                {0.29f, top - 0.36f},
                                {0.39f, top - 0.22f, kCrisp},
                                {0.42f, top - 0.19f},
                                {0.40f, top - 0.16f, kCrisp}},
                               detail.segments(64, 24)),
                     detail.segments(72, 16));
  append(whole, rounded_box({0.96f, 0.30f, 0.96f}, 0.012f), translate({0, 0.15f, 0}));
  append(whole, rounded_box({0.90f, 0.13f, 0.90f}, 0.012f), translate({0, top - 0.10f, 0}));
  append(whole, rounded_box({0.98f, 0.06f, 0.98f}, 0.012f), translate({0, top - 0.01f, 0}));
  return whole;
}

}  // namespace

void add_columns(Scene& scene, const HallMaterials& materials, Detail detail) {
  Mesh columns;
  const Mesh one = column(detail);
  for (int border = 0; border <= kBays; ++border) {
    const float z = static_cast<float>(border) * kBayLength - kHalfLength;
    for (const float side : {-1.0f, 1.0f}) append(columns, one, translate({side * (kHalfWidth - 0.05f), 0, z}));
  }
  scale_uv(columns, kStoneTile);
  add_tangents(columns);
  add_mesh(scene, "columns", materials.limestone, std::move(columns));
}

}  // namespace luciole::workshop::gallery
