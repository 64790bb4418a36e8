// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/shading_variants/measure.h"

#include <algorithm>

#include "benchmarks/shading_variants/errors.h"

namespace luciole {
namespace {

constexpr std::uint32_t kWarmUps = 2;         // rounds that do not count
constexpr std::size_t kMostPairs = 1u << 24;  // of lights and pixels that double precision is asked: seconds
constexpr std::size_t kAll = kLightKinds;     // the place behind those of the kinds

using Times = std::array<double, kLightKinds + 1>;
using Sums = std::vector<std::vector<PixelSums>>;  // by kind

// One frame of one variant.  [ms]
Result<Times> run(gpu::Device& device, const DeviceStage& stage, const Variant& variant) {
  Result<gpu::CommandList> list = gpu::CommandList::create(device);
  if (!list) return list.error();
  for (const LightKind kind : stage.kinds()) {
    list->begin_pass(variant.name);
    variant.record(*list, kind);
    if (variant.kinds_together) break;
  }
  if (Status done = list->run(); !done) return done.error();
  Times times{};
  for (std::size_t i = 0; i < list->passes_ms().size(); ++i) {
    const double ms = list->passes_ms()[i].second;
    if (!variant.kinds_together) times[stage.kinds()[i]] = ms;
    times[kAll] += ms;
  }
  return times;
}

Result<Sums> sums_of(gpu::Device& device, DeviceStage& stage, const Variant& variant) {
  if (Status s = stage.forget_sums(); !s) return s.error();
  if (Result<Times> times = run(device, stage, variant); !times) return times.error();
  Sums sums;
  for (const LightKind kind : stage.kinds()) {
    Result<std::vector<PixelSums>> read = stage.read_sums(kind);
    if (!read) return read.error();
    sums.push_back(std::move(*read));
  }
  return sums;
}

// Fills in names, comparisons and errors.
Status check(gpu::Device& device, DeviceStage& stage, const VirtualPointLights& vpls,
             const std::vector<Variant>& variants, SceneTimes& scene) {
  const std::uint32_t longest = std::max<std::uint32_t>(1, stage.longest_subset(kDiffuseLights));
  const DoubleReference reference(stage, vpls, kMostPairs / (2 * longest));
  Sums of_first;
  for (const Variant& variant : variants) {
    Result<Sums> sums = sums_of(device, stage, variant);
    if (!sums) return sums.error();
    if (of_first.empty()) {
      of_first = *sums;
      scene.error_of_float = reference.median_error(of_first);
    }
    if (variant.agreement == Agreement::half_precision) scene.error_of_half = reference.median_error(*sums);
    VariantTimes result{variant.name, variant.what, {}, {}, {}};
    for (std::size_t k = 0; k < of_first.size(); ++k) {
      result.light.push_back(compare(stage.geometry(), of_first[k], (*sums)[k]));
      const std::string wrong = complaint(result.light.back());
      if (wrong.empty()) continue;
      return Error{ErrorKind::failed, "'" + variant.name + "' gives other light in '" + scene.scene + "': " + wrong};
    }
    scene.variants.push_back(std::move(result));
  }
  return Done{};
}

}  // namespace

Result<SceneTimes> measure(gpu::Device& device, const PreparedStage& prepared, std::uint32_t frames) {
  const ManyLights many = make_many_lights(*prepared.scene, prepared.primaries, prepared.settings, 0);
  Result<std::unique_ptr<DeviceStage>> stage =
      DeviceStage::create(device, {prepared.settings, prepared.geometry, prepared.lights, many});
  if (!stage) return stage.error();
  Result<Variants> variants = make_variants(device, **stage);
  if (!variants) return variants.error();
  SceneTimes scene;
  scene.scene = prepared.name, scene.settings = prepared.settings, scene.kinds = (*stage)->kinds(),
  scene.left_out = variants->left_out;
  if (Status s = check(device, **stage, prepared.lights, variants->tried, scene); !s) return s.error();

  const std::size_t count = variants->tried.size();
  std::vector<std::array<std::vector<double>, kLightKinds + 1>> ms(count), to_first(count);
  for (std::uint32_t round = 0; round < kWarmUps + frames; ++round) {
    Times first{};
    for (std::size_t v = 0; v < count; ++v) {
      const Result<Times> times = run(device, **stage, variants->tried[v]);
      if (!times) return times.error();
      if (v == 0) first = *times;
      for (std::size_t k = 0; k <= kAll && round >= kWarmUps; ++k) {
        if ((*times)[k] == 0 || first[k] == 0) continue;
        ms[v][k].push_back((*times)[k]), to_first[v][k].push_back((*times)[k] / first[k]);
      }
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    for (std::size_t k = 0; k <= kAll; ++k) {
      scene.variants[v].ms[k] = median(ms[v][k]), scene.variants[v].to_first[k] = median(to_first[v][k]);
    }
  }
  return scene;
}

}  // namespace luciole
