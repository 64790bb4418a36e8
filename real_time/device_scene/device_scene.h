// SPDX-License-Identifier: Apache-2.0
// A scene in a device's memory: triangles in a hierarchy, what surfaces are made of, the sky. scene.glsl reads it.
#pragma once
#include "gpu/buffer.h"
#include "ray_tracing/hierarchy.h"
#include "real_time/device_scene/scene_records.h"
#include "scene/scene.h"

namespace luciole {

class DeviceScene {
 public:
  // Copies what it needs: neither scene nor hierarchy must outlive it.
  //   hierarchy  of that scene
  static Result<DeviceScene> create(gpu::Device& device, const Scene& scene, const Hierarchy& hierarchy);

  std::uint64_t address() const { return record_.address(); }  // of the SceneRecord
  std::uint64_t bytes() const;                                 // of all buffers

  // For those who draw meshes one by one.
  std::uint64_t mesh_bounds() const { return mesh_bounds_.address(); }  // of a MeshBounds per mesh
  std::uint32_t mesh_count() const { return mesh_count_; }
  const Bounds& bounds() const { return bounds_; }  // of all vertices

 private:
  gpu::Buffer record_, nodes_, triangles_, vertices_, tables_, texels_, meshes_, materials_, textures_, environment_,
      mesh_bounds_;
  std::uint32_t mesh_count_ = 0;
  Bounds bounds_;
};

}  // namespace luciole
