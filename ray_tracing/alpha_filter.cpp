// SPDX-License-Identifier: Apache-2.0
#include "ray_tracing/alpha_filter.h"

#include "scene/surface.h"

namespace luciole {
namespace {

void reject_holes(const RTCFilterFunctionNArguments* candidates) {
  const auto& filter = *static_cast<const AlphaFilter*>(candidates->geometryUserPtr);
  for (unsigned int lane = 0; lane < candidates->N; ++lane) {
    if (candidates->valid[lane] == 0) continue;
    const SurfaceHit hit{filter.mesh, RTCHitN_primID(candidates->hit, candidates->N, lane),
                         RTCHitN_u(candidates->hit, candidates->N, lane),
                         RTCHitN_v(candidates->hit, candidates->N, lane)};
    if (!alpha_passes(*filter.scene, hit)) candidates->valid[lane] = 0;
  }
}

}  // namespace

void AlphaFilter::attach(RTCGeometry geometry) {
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryIntersectFilterFunction(geometry, reject_holes);
  rtcSetGeometryOccludedFilterFunction(geometry, reject_holes);
}

}  // namespace luciole
