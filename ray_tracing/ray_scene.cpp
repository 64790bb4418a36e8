// SPDX-License-Identifier: Apache-2.0
#include "ray_tracing/ray_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>
#include <vector>

#include "base/thread_sanitizer.h"
#include "ray_tracing/alpha_filter.h"
#include "ray_tracing/check_indices.h"
#include "ray_tracing/embree_version.h"
#include "scene/surface.h"

namespace luciole {

struct RayScene::Embree {
  // What the callbacks write to, on any thread.
  std::mutex guard;
  RTCError code = RTC_ERROR_NONE;  // the first one
  std::string message;
  std::atomic<std::int64_t> held_bytes{0};
  std::int64_t limit_bytes = 0;

  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<AlphaFilter> filters;  // one per mesh, so that its address is what the geometry refers to

  Embree() = default;
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Status open(const RayTracingOptions& options);
  Status add_mesh(const Scene& from, std::uint32_t mesh_index);
  Status first_error();

  static void on_error(void* self, RTCError code, const char* text) {
    Embree& embree = *static_cast<Embree*>(self);
    const std::lock_guard lock(embree.guard);
    if (embree.code != RTC_ERROR_NONE) return;
    embree.code = code;
    embree.message = text == nullptr ? "" : text;
  }
  // Embree asks before it takes memory and tells what it gave back (negative). Refused bytes are not held.
  static bool on_memory(void* self, ssize_t bytes, bool /*after*/) {
    Embree& embree = *static_cast<Embree*>(self);
    const std::int64_t held = embree.held_bytes += bytes;
    if (bytes <= 0 || embree.limit_bytes == 0 || held <= embree.limit_bytes) return true;
    embree.held_bytes -= bytes;
    return false;
  }
};

void RayScene::DeleteEmbree::operator()(Embree* embree) const { delete embree; }

namespace {

std::string device_settings(const std::string& isa) {
  // No "threads=": in Embree that is a limit for all of TBB as long as the device lives. The build runs in the arena
  // that calls it, so with_threads holds for it too.
#if defined(LUCIOLE_THREAD_SANITIZER)
  const std::string threads = "threads=1";
#else
  const std::string threads;
#endif
  if (isa.empty()) return threads;
  return "isa=" + (isa == "baseline" ? std::string("sse2") : isa) + (threads.empty() ? "" : "," + threads);
}

Error embree_error(RTCError code, const std::string& text) {
  if (code == RTC_ERROR_OUT_OF_MEMORY) {
    return {ErrorKind::out_of_memory, "the scene's ray tracing hierarchy does not fit into memory"};
  }
  return {ErrorKind::failed, "Embree cannot trace this scene: " + (text.empty() ? std::string("unknown error") : text)};
}

float largest_coordinate(const Bounds& box) {
  const Vec3 largest = max(abs(box.low), abs(box.high));
  return std::max({largest.x, largest.y, largest.z});
}

void copy_rays(const RayPacket& from, RTCRay16& to) {
  constexpr std::size_t kBytes = sizeof(to.org_x);
  std::memcpy(to.org_x, from.origin_x, kBytes);
  std::memcpy(to.org_y, from.origin_y, kBytes);
  std::memcpy(to.org_z, from.origin_z, kBytes);
  std::memcpy(to.dir_x, from.direction_x, kBytes);
  std::memcpy(to.dir_y, from.direction_y, kBytes);
  std::memcpy(to.dir_z, from.direction_z, kBytes);
  std::memcpy(to.tnear, from.nearest, kBytes);
  std::memcpy(to.tfar, from.farthest, kBytes);
  std::fill_n(to.time, kPacketRays, 0.0f);
  std::fill_n(to.mask, kPacketRays, 1u);
  std::memcpy(to.id, from.random, sizeof(to.id));
  std::fill_n(to.flags, kPacketRays, 0u);
}

}  // namespace

Status RayScene::Embree::open(const RayTracingOptions& options) {
  limit_bytes = static_cast<std::int64_t>(options.memory_limit_bytes);
  device = rtcNewDevice(device_settings(options.isa).c_str());
  if (device == nullptr) return embree_error(rtcGetDeviceError(nullptr), "no device for '" + options.isa + "'");
  rtcSetDeviceErrorFunction(device, on_error, this);
  rtcSetDeviceMemoryMonitorFunction(device, on_memory, this);
  scene = rtcNewScene(device);
  if (scene == nullptr) return first_error();
  rtcSetSceneFlags(scene, options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  return first_error();
}

// Embree gets its own copy of the vertices: it reads 16 bytes at the last one, and pads its own buffers.
Status RayScene::Embree::add_mesh(const Scene& from, std::uint32_t mesh_index) {
  const Mesh& mesh = from.meshes[mesh_index];
  if (Status valid = check_indices(mesh); !valid) return valid;
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (geometry == nullptr) return first_error();
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                            mesh.positions.size());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
  if (positions != nullptr && indices != nullptr) {
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
    std::memcpy(indices, mesh.indices.data(), mesh.indices.size() / 3 * 3 * sizeof(std::uint32_t));
    rtcSetGeometryMask(geometry, 1);
    // Only where there can be a hole: a filter costs a call per candidate hit.
    if (can_have_holes(from, mesh, filters[mesh_index].blend_at_random)) filters[mesh_index].attach(geometry);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, mesh_index);
  }
  rtcReleaseGeometry(geometry);
  return first_error();
}

Status RayScene::Embree::first_error() {
  const std::lock_guard lock(guard);
  if (code == RTC_ERROR_NONE) return Done{};
  return embree_error(code, message);
}

Result<RayScene> RayScene::create(std::shared_ptr<const Scene> scene, const RayTracingOptions& options) {
  RayScene made;
  made.scene_ = std::move(scene);
  made.embree_.reset(new Embree);
  Embree& embree = *made.embree_;
  if (Status opened = embree.open(options); !opened) return opened.error();
  const auto meshes = static_cast<std::uint32_t>(made.scene_->meshes.size());
  for (std::uint32_t i = 0; i < meshes; ++i) embree.filters.push_back({made.scene_.get(), i, options.blend_at_random});
  for (std::uint32_t i = 0; i < meshes; ++i) {
    if (made.scene_->meshes[i].indices.size() < 3) continue;
    if (Status added = embree.add_mesh(*made.scene_, i); !added) return added.error();
  }
  rtcCommitScene(embree.scene);
  if (Status built = embree.first_error(); !built) return built.error();
  made.bounds_ = made.scene_->bounds();
  made.surface_offset_ = made.scene_->triangle_count() == 0 ? 0.0f : largest_coordinate(made.bounds_) * 0x1p-19f;
  return made;
}

HitPacket RayScene::intersect(const RayPacket& rays, Coherence coherence) const {
  RTCRayHit16 query;
  copy_rays(rays, query.ray);
  std::fill_n(query.hit.geomID, kPacketRays, RTC_INVALID_GEOMETRY_ID);
  embree::Query(coherence == Coherence::coherent).intersect(rays.active, embree_->scene, query);
  HitPacket hits;
  for (int lane = 0; lane < kPacketRays; ++lane) {
    hits.mesh[lane] = rays.active[lane] != 0 ? query.hit.geomID[lane] : kNoHit;
    hits.triangle[lane] = query.hit.primID[lane];
    hits.u[lane] = query.hit.u[lane];
    hits.v[lane] = query.hit.v[lane];
    hits.distance[lane] = query.ray.tfar[lane];
  }
  return hits;
}

std::uint32_t RayScene::occluded(const RayPacket& rays, Coherence coherence) const {
  RTCRay16 query;
  copy_rays(rays, query);
  embree::Query(coherence == Coherence::coherent).occluded(rays.active, embree_->scene, query);
  std::uint32_t bits = 0;
  // Embree marks an occluded ray by tfar = -infinity.
  for (int lane = 0; lane < kPacketRays; ++lane) {
    bits |= static_cast<std::uint32_t>(rays.active[lane] != 0 && query.tfar[lane] < 0) << lane;
  }
  return bits;
}

std::uint64_t RayScene::memory_bytes() const {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(embree_->held_bytes.load(), 0));
}

}  // namespace luciole
