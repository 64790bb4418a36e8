// SPDX-License-Identifier: Apache-2.0
#include "real_time/virtual_point_lights/virtual_point_lights.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "real_time/virtual_point_lights/place_lights.h"

namespace luciole {
namespace {

constexpr std::size_t kChunk = 4096;  // texels per unit of work

// Reflects something: met a surface, carries flux, and came from above both normals.
bool is_light(const SurfaceTexel& texel) {
  const bool has_flux = texel.flux.x > 0 || texel.flux.y > 0 || texel.flux.z > 0;
  return has_flux && dot(texel.incident, texel.normal) > 0 && dot(texel.incident, texel.geometric_normal) > 0;
}

void set(Plane3& planes, std::size_t at, Vec3 value) {
  planes[0][at] = value.x, planes[1][at] = value.y, planes[2][at] = value.z;
}

void write(const SurfaceTexel& texel, std::uint32_t key, std::size_t at, VirtualPointLights& out) {
  set(out.position, at, texel.position);
  set(out.normal, at, texel.normal);
  set(out.geometric_normal, at, texel.geometric_normal);
  set(out.incident, at, texel.incident);
  set(out.flux, at, texel.flux);
  set(out.diffuse_albedo, at, texel.diffuse_albedo);
  set(out.f0, at, texel.f0);
  out.f90[at] = texel.f90;
  out.ggx_alpha[at] = texel.ggx_alpha;
  out.area[at] = texel.area;
  out.key[at] = key;
}

// Calls body(chunk, first, last) for every chunk of texels, in parallel.
template <class Body>
void for_each_chunk(std::size_t texels, const Body& body) {
  parallel_for((texels + kChunk - 1) / kChunk, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      body(chunk, chunk * kChunk, std::min(texels, (chunk + 1) * kChunk));
    }
  });
}

}  // namespace

void VirtualPointLights::resize(std::size_t count) {
  for (Plane3* planes : {&position, &normal, &geometric_normal, &incident, &flux, &diffuse_albedo, &f0}) {
    for (Plane& plane : *planes) plane.resize(count);
  }
  for (Plane* plane : {&f90, &ggx_alpha, &area}) plane->resize(count);
  key.resize(count);
}

void place_virtual_point_lights(const std::vector<SurfaceTexel>& texels, VirtualPointLights& lights) {
  // first[c]: where the lights of chunk c go, found by counting first, so that the order is that of the texels.
  std::vector<std::size_t> first((texels.size() + kChunk - 1) / kChunk + 1, 0);
  for_each_chunk(texels.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) first[chunk + 1] += is_light(texels[i]);
  });
  for (std::size_t chunk = 1; chunk < first.size(); ++chunk) first[chunk] += first[chunk - 1];
  lights.resize(first.back());
  for_each_chunk(texels.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    std::size_t at = first[chunk];
    for (std::size_t i = begin; i < end; ++i) {
      if (is_light(texels[i])) write(texels[i], static_cast<std::uint32_t>(i), at++, lights);
    }
  });
}

VirtualPointLights make_virtual_point_lights(const RayScene& scene, const PrimaryLights& primaries,
                                             const Settings& settings, std::uint64_t frame_index) {
  const ReflectiveShadowMaps maps(primaries, scene.bounds(), settings.vpls);
  std::vector<SurfaceTexel> texels;
  maps.render(scene, {settings.vpl_seed, settings.jitter, frame_index}, texels);
  VirtualPointLights lights;
  place_virtual_point_lights(texels, lights);
  return lights;
}

}  // namespace luciole
