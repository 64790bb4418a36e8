// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/shading_variants/variants.h"

#include <algorithm>

#include "benchmarks/shading_variants/variant_records.h"
#include "real_time/setting_names.h"

namespace luciole {

extern const gpu::ShaderCode staged_lights, subgroup_lists, subgroup_lists_by_subgroup, split_culling, split_shading,
    depth_masks, depth_masks_and_halves, appended_by_atomics, small_tiles, batches_of_256, batches_of_512,
    small_tiles_by_subgroup, half_precision, persistent_groups, all_kinds;

namespace {

// Software Vulkan has 65,535 turns of loops for an invocation. At subgroups of four a tile takes some 640 of them and a
// light up to 1.3, which makes 48,000 for the eight tiles of a persistent workgroup.
constexpr std::uint32_t kLongestOnSoftware = 4096, kTilesEach = 8;

constexpr const char* kNoShuffles = "the device cannot shuffle within subgroups";

using Kernels = std::array<gpu::Kernel, kLightKinds>;
using SharedKernels = std::shared_ptr<Kernels>;

Result<SharedKernels> make_kernels(gpu::Device& device, const DeviceStage& stage, const gpu::ShaderCode& code) {
  auto kernels = std::make_shared<Kernels>();
  for (const LightKind kind : stage.kinds()) {
    const std::vector<std::uint32_t> constants = shading_constants(stage.settings(), kind);
    Result<gpu::Kernel> kernel = gpu::Kernel::create(device, code, sizeof(VariantPush), constants);
    if (!kernel) return kernel.error();
    (*kernels)[kind] = std::move(*kernel);
  }
  return kernels;
}

struct Grid {
  std::uint32_t x, y, z;
  std::uint32_t count() const { return x * y * z; }
};

Grid grid_of(const DeviceStage& stage, std::uint32_t tile_side) {
  const std::uint32_t n = stage.settings().interleave, side = tile_side * n;
  return {(stage.geometry().width + side - 1) / side, (stage.geometry().height + side - 1) / side, n * n};
}

class Maker {
 public:
  Maker(gpu::Device& device, DeviceStage& stage) : device_(device), stage_(stage) {}

  // The engine's own kernels.
  Status add_engine(LightReads reads);
  // One dispatch of one kernel per kind of light.
  Status add_kernel(const gpu::ShaderCode& code, const Variant& variant, std::uint32_t tile_side = 16);
  Status add_split();
  Status add_bounds(BoundingVolume bounds, TileTest test);
  Status add_persistent();
  Status add_all_kinds();
  void leave_out(const std::string& name, const std::string& why) { made_.left_out.emplace_back(name, why); }
  const gpu::DeviceDescription& description() const { return device_.description(); }
  Variants made() { return std::move(made_); }

 private:
  void add(Variant variant, std::function<void(gpu::CommandList&, LightKind)> record) {
    variant.record = std::move(record);
    made_.tried.push_back(std::move(variant));
  }
  Status add_pass(const Variant& variant, const Settings& settings, LightReads reads,
                  std::shared_ptr<const DeviceLights> lights);

  gpu::Device& device_;
  DeviceStage& stage_;
  Variants made_;
};

// The engine's own pass, which may read other lights than the stage's.
Status Maker::add_pass(const Variant& variant, const Settings& settings, LightReads reads,
                       std::shared_ptr<const DeviceLights> lights) {
  Result<TileShadingPass> made = TileShadingPass::create(device_, settings, reads);
  if (!made) return made.error();
  auto pass = std::make_shared<const TileShadingPass>(std::move(*made));
  add(variant, [pass, lights, &stage = stage_](gpu::CommandList& list, LightKind kind) {
    const ShadingBuffers buffers = stage.buffers(kind, lights ? *lights : stage.lights());
    const ShadingPush push = stage.push(kind);
    pass->record(list, kind, buffers, stage.geometry(), push.shift, {push.first_light, push.light_count});
  });
  return Done{};
}

Status Maker::add_engine(LightReads reads) {
  const bool by_pixel = reads == LightReads::by_pixel;
  std::string what = by_pixel ? "each pixel reads each light of its list"
                              : "each invocation reads another light of the list and hands it to its subgroup";
  if (reads == faster_light_reads(description())) what += "; so does the engine on this device";
  return add_pass({by_pixel ? "lights by pixel" : "lights by subgroup", what, Agreement::bits, false, nullptr},
                  stage_.settings(), reads, nullptr);
}

Status Maker::add_bounds(BoundingVolume bounds, TileTest test) {
  Settings settings = stage_.settings();
  settings.bounds = bounds, settings.tile_test = test;
  Result<DeviceLights> lights = stage_.make_lights(settings);
  if (!lights) return lights.error();
  const std::string name = name_of(bounds) + " bounds, " + name_of(test) + " test";
  return add_pass({name, "lights by pixel with these settings", Agreement::bits, false, nullptr}, settings,
                  LightReads::by_pixel, std::make_shared<const DeviceLights>(std::move(*lights)));
}

Status Maker::add_kernel(const gpu::ShaderCode& code, const Variant& variant, std::uint32_t tile_side) {
  Result<SharedKernels> kernels = make_kernels(device_, stage_, code);
  if (!kernels) return kernels.error();
  const Grid grid = grid_of(stage_, tile_side);
  add(variant, [kernels = *kernels, grid, &stage = stage_](gpu::CommandList& list, LightKind kind) {
    list.dispatch((*kernels)[kind], VariantPush{stage.push(kind), 0, 0, 0}, grid.x, grid.y, grid.z);
  });
  return Done{};
}

Status Maker::add_split() {
  const std::string name = "split kernels";
  std::uint64_t longest = 0;
  for (const LightKind kind : stage_.kinds()) longest = std::max<std::uint64_t>(longest, stage_.longest_subset(kind));
  const Grid grid = grid_of(stage_, 16);
  const std::uint64_t bytes = grid.count() * (sizeof(ListHeader) + 2 * sizeof(word_) * longest);
  Result<gpu::Buffer> memory = gpu::Buffer::create(device_, bytes, gpu::BufferUse::device);
  if (!memory) {
    leave_out(name, memory.error().message);
    return Done{};
  }
  Result<SharedKernels> culling = make_kernels(device_, stage_, split_culling);
  if (!culling) return culling.error();
  Result<SharedKernels> shading = make_kernels(device_, stage_, split_shading);
  if (!shading) return shading.error();
  auto lists = std::make_shared<gpu::Buffer>(std::move(*memory));
  add({name, "one kernel writes the lists to memory, another shades from them", Agreement::bits, false, nullptr},
      [culling = *culling, shading = *shading, lists, grid, &stage = stage_](gpu::CommandList& list, LightKind kind) {
        const VariantPush push{stage.push(kind), lists->address(), 0, 0};
        list.dispatch((*culling)[kind], push, grid.x, grid.y, grid.z);
        list.barrier();
        list.dispatch((*shading)[kind], push, grid.x, grid.y, grid.z);
      });
  return Done{};
}

Status Maker::add_persistent() {
  Result<SharedKernels> kernels = make_kernels(device_, stage_, persistent_groups);
  if (!kernels) return kernels.error();
  Result<gpu::Buffer> memory = gpu::Buffer::create(device_, sizeof(word_), gpu::BufferUse::device);
  if (!memory) return memory.error();
  auto counter = std::make_shared<gpu::Buffer>(std::move(*memory));
  const std::uint32_t groups = (grid_of(stage_, 16).count() + kTilesEach - 1) / kTilesEach;
  // Software runs a workgroup to its end before the next, which without a limit would take all tiles.
  const std::uint32_t most = description().kind == gpu::DeviceKind::cpu ? kTilesEach : ~0u;
  add({"persistent workgroups", "one workgroup per eight tiles; each takes the next tile from a counter",
       Agreement::bits, false, nullptr},
      [kernels = *kernels, counter, groups, most, &stage = stage_](gpu::CommandList& list, LightKind kind) {
        list.fill(*counter, 0);
        list.barrier();
        list.dispatch((*kernels)[kind], VariantPush{stage.push(kind), counter->address(), most, 0}, groups);
      });
  return Done{};
}

Status Maker::add_all_kinds() {
  const std::vector<LightKind> kinds = stage_.kinds();
  Result<gpu::Buffer> sent = stage_.send(kLightKinds * sizeof(ShadingPush), [&](void* memory) {
    auto* pushes = static_cast<ShadingPush*>(memory);
    std::fill(pushes, pushes + kLightKinds, ShadingPush{});
    for (const LightKind kind : kinds) pushes[kind] = stage_.push(kind);
  });
  if (!sent) return sent.error();
  auto pushes = std::make_shared<gpu::Buffer>(std::move(*sent));
  const std::vector<std::uint32_t> constants = shading_constants(stage_.settings(), kinds.front());
  Result<gpu::Kernel> made = gpu::Kernel::create(device_, all_kinds, sizeof(VariantPush), constants);
  if (!made) return made.error();
  auto kernel = std::make_shared<gpu::Kernel>(std::move(*made));
  const Grid grid = grid_of(stage_, 16);
  add({"all kinds at once", "one dispatch for all kinds of light: a tile is read and measured once", Agreement::bits,
       true, nullptr},
      [kernel, pushes, grid, first = kinds.front(), &stage = stage_](gpu::CommandList& list, LightKind) {
        list.dispatch(*kernel, VariantPush{stage.push(first), pushes->address(), 0, 0}, grid.x, grid.y, grid.z);
      });
  return Done{};
}

struct KernelVariant {
  const gpu::ShaderCode* code;
  const char *name, *what;
  Agreement agreement = Agreement::bits;
  std::uint32_t tile_side = 16;
  bool shuffles = false, half_floats = false;
};

const KernelVariant kKernelVariants[] = {
    {&staged_lights, "lights staged", "all invocations copy the next 64 lights of both lists to shared memory"},
    {&subgroup_lists, "subgroup lists", "each subgroup takes of the tile's list what reaches the box of its pixels"},
    {&subgroup_lists_by_subgroup, "subgroup lists, lights by subgroup", "both", Agreement::bits, 16, true},
    {&depth_masks, "depth mask", "32 depth slices with a surface or not, one list per tile, instead of two halves"},
    {&depth_masks_and_halves, "depth masks and halves", "a mask of slices for each half beside the halves"},
    {&appended_by_atomics, "atomics", "lists are appended by counters in shared memory, in any order",
     Agreement::rounding},
    {&batches_of_256, "batches of 256", "lists of a fourth of the memory"},
    {&batches_of_512, "batches of 512", "lists of half the memory"},
    {&small_tiles, "tiles of 8x8", "workgroups of 64", Agreement::bits, 8},
    {&small_tiles_by_subgroup, "tiles of 8x8, lights by subgroup", "both", Agreement::bits, 8, true},
    {&half_precision, "half precision", "the pixel's Fresnel reflectance in half precision", Agreement::half_precision,
     16, false, true},
};

Status add_kernels(Maker& maker) {
  for (const KernelVariant& k : kKernelVariants) {
    if (k.shuffles && !maker.description().shuffles) {
      maker.leave_out(k.name, kNoShuffles);
    } else if (k.half_floats && !maker.description().half_floats) {
      maker.leave_out(k.name, "the device has no arithmetic in half precision");
    } else if (Status s = maker.add_kernel(*k.code, {k.name, k.what, k.agreement, false, nullptr}, k.tile_side); !s) {
      return s;
    }
  }
  return Done{};
}

Status check(const gpu::Device& device, const DeviceStage& stage) {
  const Settings& settings = stage.settings();
  if (settings.culling != Culling::tiled || settings.tile_test != TileTest::tight) {
    return Error{ErrorKind::usage, "variants of shading need --culling tiled and --tile-test tight"};
  }
  if (stage.kinds().empty()) return Error{ErrorKind::usage, "there are no lights to shade with"};
  for (const LightKind kind : stage.kinds()) {
    if (device.description().kind != gpu::DeviceKind::cpu || stage.longest_subset(kind) <= kLongestOnSoftware) continue;
    return Error{ErrorKind::usage, "on software Vulkan variants of shading take at most " +
                                       std::to_string(kLongestOnSoftware) + " lights per subset"};
  }
  return Done{};
}

}  // namespace

Result<Variants> make_variants(gpu::Device& device, DeviceStage& stage) {
  if (Status able = check(device, stage); !able) return able.error();
  Maker maker(device, stage);
  Status done = maker.add_engine(LightReads::by_pixel);
  if (device.description().shuffles) {
    if (done) done = maker.add_engine(LightReads::by_subgroup);
  } else {
    maker.leave_out("lights by subgroup", kNoShuffles);
  }
  if (done) done = add_kernels(maker);
  if (done) done = maker.add_split();
  if (done) done = maker.add_persistent();
  if (done) done = maker.add_all_kinds();
  for (const BoundingVolume bounds :
       {BoundingVolume::sphere_at_light, BoundingVolume::sphere, BoundingVolume::spheroid}) {
    if (done) done = maker.add_bounds(bounds, TileTest::tight);
  }
  if (done) done = maker.add_bounds(BoundingVolume::spheroid, TileTest::paper);
  for (const TileTest test : {TileTest::paper, TileTest::exact}) {
    if (done) done = maker.add_bounds(BoundingVolume::tight, test);
  }
  if (!done) return done.error();
  return maker.made();
}

}  // namespace luciole
