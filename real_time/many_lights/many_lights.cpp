// SPDX-License-Identifier: Apache-2.0
#include "real_time/many_lights/many_lights.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/fold_seed.h"
#include "equations/cpp/float.h"
#include "real_time/in_order.h"
#include "scene/surface.h"

namespace luciole {
namespace {

constexpr std::uint32_t kDimensionPoint = 4;  // apart from ranges (0-3) and texels (5)

struct ManyLight {
  Vec3 position, axis, intensity;
  float scale, offset, two_sided, squared, area;
};

bool has_light(Vec3 intensity) { return intensity.x > 0 || intensity.y > 0 || intensity.z > 0; }

ManyLight punctual(const PunctualLight& light) {
  if (light.kind == PunctualLight::Kind::point) return {light.position, Vec3(0, 1, 0), light.intensity, 0, 1, 0, 0, 0};
  const float scale = 1 / ramp_width(light);
  return {light.position, light.direction, light.intensity, scale, -light.cos_outer * scale, 0, 1, 0};
}

// The triangles of all meshes with an emissive material, numbered through.
class EmissiveTriangles {
 public:
  explicit EmissiveTriangles(const Scene& scene) : scene_(scene) {
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
      const Mesh& mesh = scene.meshes[i];
      const Material& material = scene.materials[mesh.material];
      if (material.unlit || !has_light(material.emission)) continue;
      meshes_.push_back(i);
      first_.push_back(first_.back() + mesh.indices.size() / 3);
    }
  }
  std::size_t size() const { return first_.back(); }

  // The triangle as a light at one of its points; no intensity where it does not shine.
  //   point  two uniform random numbers
  ManyLight light(std::size_t number, Vec2 point) const {
    const auto next = std::upper_bound(first_.begin(), first_.end(), number);
    const auto slot = static_cast<std::size_t>(next - first_.begin()) - 1;
    const Mesh& mesh = scene_.meshes[meshes_[slot]];
    const Material& material = scene_.materials[mesh.material];
    // Uniform over the triangle: the distance from the first corner grows as a square root.
    const float root = std::sqrt(point.x);
    const SurfaceHit hit{meshes_[slot], static_cast<std::uint32_t>(number - first_[slot]), root * (1 - point.y),
                         root * point.y};
    const std::uint32_t* corner = &mesh.indices[std::size_t(hit.triangle) * 3];
    const Vec3 a = mesh.positions[corner[0]];
    const Vec3 e1 = mesh.positions[corner[1]] - a, e2 = mesh.positions[corner[2]] - a;
    const Vec3 area_vector = cross(e1, e2) * 0.5f;
    const float area = length(area_vector);
    ManyLight made{a + e1 * hit.u + e2 * hit.v, Vec3(0, 1, 0), Vec3(0, 0, 0), 1, 0, 0, 0, area};
    if (!(area > 0)) return made;
    made.axis = area_vector / area;
    made.two_sided = material.double_sided ? 1.0f : 0.0f;
    made.intensity = emission(material, hit, made.axis) * area;
    return made;
  }

 private:
  Vec3 emission(const Material& material, const SurfaceHit& hit, Vec3 front_normal) const {
    if (!alpha_passes(scene_, hit)) return {0, 0, 0};
    if (material.emissive_texture.texture < 0) return material.emission;
    return evaluate_surface(scene_, hit, -front_normal, 0).emission;
  }

  const Scene& scene_;
  std::vector<std::uint32_t> meshes_;
  std::vector<std::size_t> first_{0};  // one more than meshes: the last is the number of triangles
};

void set(Plane3& planes, std::size_t at, Vec3 value) {
  planes[0][at] = value.x, planes[1][at] = value.y, planes[2][at] = value.z;
}

void write(const ManyLight& light, std::uint32_t key, std::size_t at, ManyLights& out) {
  set(out.position, at, light.position);
  set(out.axis, at, light.axis);
  set(out.intensity, at, light.intensity);
  out.scale[at] = light.scale;
  out.offset[at] = light.offset;
  out.two_sided[at] = light.two_sided;
  out.squared[at] = light.squared;
  out.area[at] = light.area;
  out.key[at] = key;
}

std::vector<ManyLight> punctual_lights(const Scene& scene, const PrimaryLights& primaries) {
  std::vector<ManyLight> lights;
  for (const std::uint32_t index : other_lights(scene, primaries)) {
    const PunctualLight& light = scene.lights[index];
    if (light.kind != PunctualLight::Kind::directional) lights.push_back(punctual(light));
  }
  return lights;
}

}  // namespace

void ManyLights::resize(std::size_t count) {
  for (Plane3* planes : {&position, &axis, &intensity}) {
    for (Plane& plane : *planes) plane.resize(count);
  }
  for (Plane* plane : {&scale, &offset, &two_sided, &squared, &area}) plane->resize(count);
  key.resize(count);
}

ManyLights make_many_lights(const Scene& scene, const PrimaryLights& primaries, const Settings& settings,
                            std::uint64_t frame_index) {
  const std::vector<ManyLight> punctuals = punctual_lights(scene, primaries);
  const EmissiveTriangles triangles(scene);
  // All lights first, then those that shine: drawing twice would cost more than the memory.
  std::vector<ManyLight> all(punctuals.size() + triangles.size());
  std::copy(punctuals.begin(), punctuals.end(), all.begin());
  const std::uint32_t seed = folded(settings.seed), frame = folded(frame_index);
  parallel_for(triangles.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto key = static_cast<std::uint32_t>(punctuals.size() + i);
      const f32::RandomWords words = f32::random_words(seed, frame, key, kDimensionPoint);
      all[key] = triangles.light(i, {f32::unit_real(words.first), f32::unit_real(words.second)});
    }
  });
  const auto keep = [&](std::size_t i) { return has_light(all[i].intensity); };
  const KeptItems kept(all.size(), keep);
  ManyLights lights;
  lights.resize(kept.count());
  kept.write(keep, [&](std::size_t i, std::size_t at) { write(all[i], static_cast<std::uint32_t>(i), at, lights); });
  return lights;
}

}  // namespace luciole
