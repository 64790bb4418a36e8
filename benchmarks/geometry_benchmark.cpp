// SPDX-License-Identifier: Apache-2.0
// The geometry buffer on the Vulkan device, rasterised and by rays, beside the CPU's.
//   geometry_benchmark SHOT ...     prints Markdown
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "benchmarks/stage.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "real_time/geometry_buffer/raster_geometry_pass.h"

namespace luciole {
namespace {

constexpr std::uint32_t kWidth = 1280, kHeight = 720;
constexpr int kRuns = 3;

template <class T>
T taken(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "geometry_benchmark: %s\n", result.error().message.c_str());
  std::exit(1);
}

// Median of the pass's time [ms]; the first run, in which shaders may be compiled, is left out. By the device's clock,
// but software Vulkan stamps beside its rasteriser: there by ours, which adds less than a millisecond.
template <class Pass>
double pass_ms(gpu::Device& device, const Pass& pass, const DeviceScene& scene, const DeviceView& view,
               const GeometryOnDevice& to) {
  std::vector<double> ms;
  for (int run = 0; run <= kRuns; ++run) {
    gpu::CommandList list = taken(gpu::CommandList::create(device));
    pass.record(list, scene, view, to);
    const auto start = std::chrono::steady_clock::now();
    taken(list.run());
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    const bool software = device.description().kind == gpu::DeviceKind::cpu;
    if (run > 0) ms.push_back(software ? wall.count() : list.passes_ms().front().second);
  }
  return median(ms);
}

std::vector<SurfaceRecord> surfaces_of(gpu::Device& device, const GeometryOnDevice& from) {
  const std::size_t pixels = std::size_t(kWidth) * kHeight, bytes = pixels * sizeof(SurfaceRecord);
  const gpu::Buffer received = taken(gpu::Buffer::create(device, bytes, gpu::BufferUse::readback));
  gpu::CommandList list = taken(gpu::CommandList::create(device));
  list.begin_pass("transfer");
  list.copy(from.surfaces, received, bytes);
  taken(list.run());
  return {received.as<SurfaceRecord>(), received.as<SurfaceRecord>() + pixels};
}

void print_row(gpu::Device& device, const std::string& name) {
  const Stage stage = open_stage(name, {});
  const RayScene rays = taken(RayScene::create(stage.scene));
  const DeviceScene scene = taken(DeviceScene::create(device, *stage.scene, taken(build_hierarchy(*stage.scene))));
  const DeviceView view{stage.camera, kWidth, kHeight};
  const GeometryOnDevice to = taken(GeometryOnDevice::create(device, kWidth, kHeight));
  const auto cast = taken(DeviceGeometryPass::create(device));
  const auto drawn = taken(RasterGeometryPass::create(device, kWidth, kHeight, scene.mesh_count()));
  const double cast_ms = pass_ms(device, cast, scene, view, to);
  const std::vector<SurfaceRecord> by_rays = surfaces_of(device, to);
  const double drawn_ms = pass_ms(device, drawn, scene, view, to);
  const std::vector<SurfaceRecord> rasterised = surfaces_of(device, to);
  std::size_t other = 0;
  for (std::size_t i = 0; i < by_rays.size(); ++i) {
    other += by_rays[i].mesh != rasterised[i].mesh || by_rays[i].triangle != rasterised[i].triangle;
  }
  std::vector<double> cpu_ms;
  GeometryBuffer buffer;
  for (int run = 0; run < kRuns; ++run) {
    cpu_ms.push_back(1e3 * seconds_of([&] { render_geometry_buffer({rays, stage.camera, kWidth, kHeight}, buffer); }));
  }
  std::printf("| `%s` | %zu | %zu | %.1f | %.1f | %.1f | %.3f %% |\n", name.c_str(),
              static_cast<std::size_t>(stage.scene->triangle_count()), stage.scene->meshes.size(), drawn_ms, cast_ms,
              median(cpu_ms), 100.0 * static_cast<double>(other) / static_cast<double>(by_rays.size()));
  std::fflush(stdout);
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  print_page_head("The geometry buffer on a device", "benchmarks/run.sh geometry");
  const std::unique_ptr<gpu::Device> device = taken(gpu::Device::create({}));
  std::printf(
      "\n1280x720, medians of three. Vulkan device: %s. Its times are by its own clock, or, of\n"
      "software Vulkan, by this program's. The last column is the\n"
      "share of pixels that show another triangle when they are rasterised than by rays.\n\n"
      "| shot | triangles | meshes | rasterised, ms | by rays, ms | CPU by rays, ms | another triangle |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
      device->description().name.c_str());
  std::fflush(stdout);
  for (int i = 1; i < argc; ++i) print_row(*device, argv[i]);
}
