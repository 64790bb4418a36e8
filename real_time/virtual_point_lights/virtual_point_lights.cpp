// SPDX-License-Identifier: Apache-2.0
#include "real_time/virtual_point_lights/virtual_point_lights.h"

#include <vector>

#include "real_time/in_order.h"
#include "real_time/virtual_point_lights/place_lights.h"

namespace luciole {
namespace {

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

}  // namespace

void VirtualPointLights::resize(std::size_t count) {
  for (Plane3* planes : {&position, &normal, &geometric_normal, &incident, &flux, &diffuse_albedo, &f0}) {
    for (Plane& plane : *planes) plane.resize(count);
  }
  for (Plane* plane : {&f90, &ggx_alpha, &area}) plane->resize(count);
  key.resize(count);
}

void place_virtual_point_lights(const std::vector<SurfaceTexel>& texels, VirtualPointLights& lights) {
  const auto keep = [&](std::size_t i) { return is_light(texels[i]); };
  const KeptItems kept(texels.size(), keep);
  lights.resize(kept.count());
  kept.write(keep, [&](std::size_t i, std::size_t at) { write(texels[i], static_cast<std::uint32_t>(i), at, lights); });
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
