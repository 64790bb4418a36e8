// SPDX-License-Identifier: Apache-2.0
// For tests: a scene on a device, asked for hits and surfaces.
#pragma once
#include <string>

#include "gpu/test_device.h"
#include "ray_tracing/hierarchy.h"
#include "real_time/device_scene/device_scene.h"
#include "real_time/device_scene/probe_records.h"
#include "scene/recipes/recipes.h"

namespace luciole {
extern const gpu::ShaderCode trace_probe;
extern const gpu::ShaderCode surface_probe;
}  // namespace luciole

namespace luciole::test {

inline std::shared_ptr<const Scene> bundled(const std::string& address) {
  Result<Scene> scene = make_recipe_from_address(address);
  EXPECT_TRUE(scene.has_value()) << address;
  return std::make_shared<const Scene>(std::move(*scene));
}

inline Hierarchy hierarchy_of(const Scene& scene) {
  Result<Hierarchy> made = build_hierarchy(scene);
  EXPECT_TRUE(made.has_value()) << made.error().message;
  return std::move(*made);
}

// A device with the kernels that ask.
class Probe {
 public:
  explicit Probe(const gpu::DeviceRequest& request = {}) : device_(gpu::test::open_device(request)) {
    trace_ = gpu::test::make_kernel(*device_, trace_probe, sizeof(ProbePush));
    surface_ = gpu::test::make_kernel(*device_, surface_probe, sizeof(ProbePush));
  }

  gpu::Device& device() { return *device_; }
  DeviceScene place(const Scene& scene, const Hierarchy& hierarchy) {
    Result<DeviceScene> placed = DeviceScene::create(*device_, scene, hierarchy);
    EXPECT_TRUE(placed.has_value()) << placed.error().message;
    return std::move(*placed);
  }

  std::vector<RayAnswer> trace(const DeviceScene& scene, const std::vector<RayQuery>& rays, bool any = false) {
    return ask<RayAnswer>(trace_, scene, rays, any);
  }
  std::vector<SurfaceAnswer> evaluate(const DeviceScene& scene, const std::vector<SurfaceQuery>& points) {
    return ask<SurfaceAnswer>(surface_, scene, points, false);
  }
  double last_ms() const { return last_ms_; }

 private:
  template <class Answer, class Query>
  std::vector<Answer> ask(const gpu::Kernel& kernel, const DeviceScene& scene, const std::vector<Query>& queries,
                          bool any) {
    namespace t = gpu::test;
    const gpu::Buffer in = t::upload_of(*device_, queries);
    const gpu::Buffer out = t::make_buffer(*device_, queries.size() * sizeof(Answer), gpu::BufferUse::readback);
    gpu::CommandList list = t::make_list(*device_);
    list.begin_pass("probe");
    const auto count = static_cast<std::uint32_t>(queries.size());
    list.dispatch(kernel, ProbePush{scene.address(), in.address(), out.address(), count, any}, (count + 63) / 64);
    const Status done = list.run();
    EXPECT_TRUE(done.has_value()) << done.error().message;
    last_ms_ = list.passes_ms().at(0).second;
    return t::values_in<Answer>(out, queries.size());
  }

  std::unique_ptr<gpu::Device> device_;
  gpu::Kernel trace_, surface_;
  double last_ms_ = 0;
};

}  // namespace luciole::test
