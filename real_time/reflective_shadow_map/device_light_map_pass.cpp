// SPDX-License-Identifier: Apache-2.0
#include "real_time/reflective_shadow_map/device_light_map_pass.h"

#include "base/fold_seed.h"
#include "real_time/device_scene/upload.h"

namespace luciole {

extern const gpu::ShaderCode trace_light_maps;

namespace {

constexpr std::uint32_t kGroup = 64;  // invocations of a workgroup of trace_light_maps.comp

}  // namespace

Result<LightMapsOnDevice> LightMapsOnDevice::create(gpu::Device& device, const ReflectiveShadowMaps& maps) {
  Result<Upload> upload = Upload::begin(device);
  if (!upload) return upload.error();
  std::vector<LightMapRecord> records;
  std::vector<CellRecord> cells;
  cells.reserve(maps.texel_count());
  for (std::size_t i = 0; i < maps.maps().size(); ++i) {
    const LightMap& map = maps.maps()[i];
    records.push_back(map.record(maps.first_texel(i)));
    for (std::uint32_t texel = 0; texel < map.size(); ++texel) {
      const CellPartition::Cell cell = map.cells().cell(texel);
      cells.push_back({cell.row, cell.column});
    }
  }
  LightMapsOnDevice made;
  made.map_count_ = static_cast<std::uint32_t>(records.size()), made.texel_count_ = maps.texel_count();
  Status sent = upload->add(records, made.maps_);
  if (sent) sent = upload->add(cells, made.cells_);
  if (sent) sent = upload->finish();
  if (!sent) return sent.error();
  return made;
}

Result<DeviceLightMapPass> DeviceLightMapPass::create(gpu::Device& device, std::uint32_t interleave) {
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, trace_light_maps, sizeof(LightMapPush));
  if (!kernel) return kernel.error();
  DeviceLightMapPass pass;
  pass.kernel_ = std::move(*kernel);
  pass.subsets_ = interleave * interleave;
  return pass;
}

void DeviceLightMapPass::record(gpu::CommandList& list, const DeviceScene& scene, const LightMapsOnDevice& maps,
                                const TexelSampling& sampling, const TexelsOnDevice& to,
                                const gpu::Buffer& unfinished) const {
  LightMapPush push{};
  push.scene = scene.address(), push.maps = maps.maps().address(), push.cells = maps.cells().address();
  push.lights = to.lights.address(), push.counts = to.counts.address(), push.unfinished = unfinished.address();
  push.map_count = maps.map_count(), push.texel_count = maps.texel_count();
  push.subsets = subsets_;
  push.is_random = sampling.is_random() ? 1 : 0;
  push.seed = folded(sampling.vpl_seed), push.frame = sampling.frame_word();
  list.begin_pass("reflective_shadow_map");
  list.fill(to.counts, 0);
  list.barrier();
  if (push.texel_count > 0) list.dispatch(kernel_, push, (push.texel_count - 1) / kGroup + 1);
}

}  // namespace luciole
