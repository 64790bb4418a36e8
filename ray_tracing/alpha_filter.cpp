// SPDX-License-Identifier: Apache-2.0
#include "ray_tracing/alpha_filter.h"

#include "equations/cpp/float.h"
#include "scene/surface.h"

namespace luciole {
namespace {

// A number in (0,1) of a ray and a triangle.
float unit_of(std::uint32_t ray, std::uint32_t mesh, std::uint32_t triangle) {
  return f32::unit_real(f32::random_words(ray, 0, triangle, mesh).first);
}

void reject_holes(const RTCFilterFunctionNArguments* candidates) {
  const auto& filter = *static_cast<const AlphaFilter*>(candidates->geometryUserPtr);
  for (unsigned int lane = 0; lane < candidates->N; ++lane) {
    if (candidates->valid[lane] == 0) continue;
    const SurfaceHit hit{filter.mesh, RTCHitN_primID(candidates->hit, candidates->N, lane),
                         RTCHitN_u(candidates->hit, candidates->N, lane),
                         RTCHitN_v(candidates->hit, candidates->N, lane)};
    const Scene& scene = *filter.scene;
    const bool stops = filter.blend_at_random && is_blended(scene, hit.mesh)
                           ? unit_of(RTCRayN_id(candidates->ray, candidates->N, lane), hit.mesh, hit.triangle) <
                                 surface_alpha(scene, hit)
                           : alpha_passes(scene, hit);
    if (!stops) candidates->valid[lane] = 0;
  }
}

}  // namespace

void AlphaFilter::attach(RTCGeometry geometry) {
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryIntersectFilterFunction(geometry, reject_holes);
  rtcSetGeometryOccludedFilterFunction(geometry, reject_holes);
}

}  // namespace luciole
