// SPDX-License-Identifier: Apache-2.0
#include "offline/light_set/light_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "equations/cpp/float.h"
#include "scene/emissive_triangles.h"
#include "scene/punctual_light.h"

namespace luciole {
namespace {

void set_axis(LightRecord& record, Vec3 axis) {
  record.axis_x = axis.x, record.axis_y = axis.y, record.axis_z = axis.z;
}
void set_centre(LightRecord& record, Vec3 centre) { record.x = centre.x, record.y = centre.y, record.z = centre.z; }

LightRecord triangle_record(const Scene& scene, const EmissiveTriangle& triangle) {
  const Mesh& mesh = scene.meshes[triangle.mesh];
  const std::uint32_t* corner = &mesh.indices[std::size_t(triangle.triangle) * 3];
  const Vec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
  LightRecord record{};
  const Vec3 centre = (a + b + c) / 3.0f;
  set_centre(record, centre);
  record.radius = std::max({length(a - centre), length(b - centre), length(c - centre)}) * 1.00001f;
  set_axis(record, normalize(cross(b - a, c - a)));
  record.intensity = channel_mean(triangle.radiance) * triangle.area;
  record.scale = 1, record.two_sided = triangle.both_sides ? 1.0f : 0.0f;
  // Reach of a cosine lobe: the smallest sphere round it, or round two of them back to back.   [TH17] sect. 6
  const f32::BoundingSphere lobe = f32::diffuse_bounding_sphere({0, 0, 0}, {0, 0, 1}, 1);
  record.reach_offset = triangle.both_sides ? 0.0f : lobe.centre.z;
  record.reach_radius = triangle.both_sides ? 1.0f : lobe.radius;
  record.mesh = triangle.mesh, record.triangle = triangle.triangle;
  return record;
}

LightRecord lamp_record(const PunctualLight& light, std::uint32_t index) {
  LightRecord record{};
  set_centre(record, light.position);
  record.intensity = channel_mean(light.intensity);
  record.lamp = 1, record.mesh = index;
  record.reach_radius = 1;
  if (light.kind == PunctualLight::Kind::point) {
    set_axis(record, {0, 0, 1});
    record.offset = 1;
    return record;
  }
  set_axis(record, light.direction);
  record.scale = 1 / ramp_width(light);
  record.offset = -light.cos_outer * record.scale;
  // The smallest sphere round a sector of a ball: through its tip and rim, or, if wider than a right angle, round its
  // rim.
  const float cosine = light.cos_outer;
  if (cosine > std::numbers::sqrt2_v<float> / 2) {
    record.reach_offset = record.reach_radius = 0.5f / cosine;
  } else if (cosine > 0) {
    record.reach_offset = cosine, record.reach_radius = std::sqrt(1 - cosine * cosine);
  }
  return record;
}

std::uint32_t curve_place(const Bounds& box, Vec3 p) {
  const auto cell = [](float x, float low, float high) {
    const float share = high > low ? (x - low) / (high - low) : 0.0f;
    return static_cast<std::uint32_t>(std::clamp(share * 1024, 0.0f, 1023.0f));
  };
  return f32::morton_code(cell(p.x, box.low.x, box.high.x), cell(p.y, box.low.y, box.high.y),
                          cell(p.z, box.low.z, box.high.z));
}

}  // namespace

float directional_factor(const LightRecord& light, float cos_axis) {
  const float t = std::clamp(std::max(cos_axis, -cos_axis * light.two_sided) * light.scale + light.offset, 0.0f, 1.0f);
  return light.lamp > 0 ? t * t : t;
}

LightSet::LightSet(const Scene& scene) : light_of_triangle_(scene.meshes.size()) {
  struct Unsorted {
    LightRecord record;
    Vec3 colour;
  };
  std::vector<Unsorted> unsorted;
  const auto keep = [&](const LightRecord& record, Vec3 colour) {
    if (record.intensity > 0 && std::isfinite(record.intensity)) unsorted.push_back({record, colour});
  };
  for (const EmissiveTriangle& triangle : emissive_triangles(scene)) {
    keep(triangle_record(scene, triangle), triangle.radiance);
  }
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].kind == PunctualLight::Kind::directional) continue;
    keep(lamp_record(scene.lights[i], i), scene.lights[i].intensity);
  }
  Bounds box;
  for (const Unsorted& light : unsorted) box.grow(light.record.centre());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;  // (place on the curve, index)
  order.reserve(unsorted.size());
  for (std::uint32_t i = 0; i < unsorted.size(); ++i) {
    order.emplace_back(curve_place(box, unsorted[i].record.centre()), i);
  }
  std::sort(order.begin(), order.end());
  records_.resize(unsorted.size()), tints_.resize(unsorted.size());
  for (std::uint32_t place = 0; place < order.size(); ++place) {
    const auto& [record, colour] = unsorted[order[place].second];
    records_[place] = record, tints_[place] = colour / channel_mean(colour);
    if (record.lamp > 0) continue;
    std::vector<std::uint32_t>& lights = light_of_triangle_[record.mesh];
    if (lights.empty()) lights.assign(scene.meshes[record.mesh].indices.size() / 3, kNoLight);
    lights[record.triangle] = place;
  }
}

std::uint64_t LightSet::memory_bytes() const {
  std::uint64_t bytes = records_.size() * (sizeof(LightRecord) + sizeof(Vec3));
  for (const std::vector<std::uint32_t>& lights : light_of_triangle_) bytes += lights.size() * sizeof(std::uint32_t);
  return bytes;
}

}  // namespace luciole
