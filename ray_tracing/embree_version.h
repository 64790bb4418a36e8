// SPDX-License-Identifier: Apache-2.0
// What differs between Embree 3.13 and 4, in one place. Only ray_scene.cpp, alpha_filter.cpp and hierarchy.cpp
// include this.
#pragma once
#include <cstdint>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace luciole::embree {

#if RTC_VERSION_MAJOR >= 4

class Query {
 public:
  explicit Query(bool coherent) {
    const RTCRayQueryFlags flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = occluded_.flags = flags;
  }
  void intersect(const std::int32_t* active, RTCScene scene, RTCRayHit16& rays) {
    rtcIntersect16(active, scene, &rays, &intersect_);
  }
  void occluded(const std::int32_t* active, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(active, scene, &rays, &occluded_);
  }

 private:
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
};

#else

class Query {
 public:
  explicit Query(bool coherent) {
    rtcInitIntersectContext(&context_);
    context_.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  void intersect(const std::int32_t* active, RTCScene scene, RTCRayHit16& rays) {
    rtcIntersect16(active, scene, &context_, &rays);
  }
  void occluded(const std::int32_t* active, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(active, scene, &context_, &rays);
  }

 private:
  RTCIntersectContext context_;
};

#endif

}  // namespace luciole::embree
