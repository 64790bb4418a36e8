// SPDX-License-Identifier: Apache-2.0
// The choice of lights alone, without shadows: how much it scatters and what it takes.
//   light_choice_benchmark [SCENE ...]     prints Markdown
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "benchmarks/stage.h"
#include "equations/cpp/float.h"
#include "offline/light_sample/make_light_sampler.h"
#include "offline/path/path_batch.h"
#include "offline/path/probe_paths.h"

namespace luciole {
namespace {

constexpr std::uint32_t kPasses = 400;  // new ranges in each
constexpr std::size_t kReceivers = 96;

// What an unoccluded light sends to the eye by way of the receiver, from its centre; relative to its neighbours only.
double reflected(const LightRecord& light, const Receiver& at) {
  const auto vector = [](const float v[3]) { return Vec3(v[0], v[1], v[2]); };
  const Vec3 apart = light.centre() - vector(at.position);
  const float distance_sq = dot(apart, apart);
  const Vec3 direction = apart * (1 / std::sqrt(distance_sq));
  if (dot(direction, vector(at.geometric_normal)) <= 0) return 0;
  const float s = directional_factor(light, -dot(light.axis(), direction));
  const f32::SurfaceBrdf brdf{{at.diffuse, at.diffuse, at.diffuse}, {at.f0, at.f0, at.f0}, at.f90, at.ggx_alpha};
  const f32::Reflection r =
      f32::reflection(f32::fix_direction(brdf, vector(at.shading_normal), vector(at.to_eye)), direction);
  return double(light.intensity) * s / distance_sq * (at.diffuse * r.diffuse + r.specular.x);
}

struct Measured {
  double variance = 0;      // relative, of one choice, mean over receivers
  double microseconds = 0;  // per choice, the pass's ranges apart
  double pass_ms = 0;
  double weighed = 0;
};

Measured measure(const LightSet& lights, LightSampler& sampler, const std::vector<Receiver>& receivers,
                 std::uint32_t passes) {
  std::vector<double> sum(receivers.size(), 0.0), squares(receivers.size(), 0.0);
  Measured measured;
  Candidates candidates;
  ChoiceMemory memory;
  double seconds = 0, pass_seconds = 0;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    pass_seconds += seconds_of([&] { sampler.begin_pass(pass); });
    std::vector<ChosenLight> chosen(receivers.size());
    seconds += seconds_of([&] {
      for (std::size_t r = 0; r < receivers.size(); ++r) {
        const std::uint32_t bits = f32::random_words(pass, 1, static_cast<std::uint32_t>(r), 99).first;
        sampler.share_candidates(&receivers[r], 1, candidates);
        chosen[r] = sampler.choose(receivers[r], candidates, bits * 0x1p-32, memory);
      }
    });
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      measured.weighed += chosen[r].weighed;
      if (chosen[r].light == kNoLight) continue;
      const LightRecord& light = lights.records()[chosen[r].light];
      const float* p = receivers[r].position;
      const Vec3 apart = light.centre() - Vec3(p[0], p[1], p[2]);
      const float distance_sq = dot(apart, apart);
      const LightPlace place{distance_sq,
                             directional_factor(light, -dot(light.axis(), apart) / std::sqrt(distance_sq))};
      const double acceptance = sampler.acceptance(chosen[r].light, place);
      const double value = acceptance > 0 ? reflected(light, receivers[r]) / (double(chosen[r].pmf) * acceptance) : 0.0;
      sum[r] += value, squares[r] += value * value;
    }
  }
  double counted = 0;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    double exact = 0;
    for (const LightRecord& light : lights.records()) exact += reflected(light, receivers[r]);
    if (!(exact > 0)) continue;
    measured.variance += squares[r] / passes / (exact * exact) - 1, ++counted;
  }
  const double choices = double(passes) * static_cast<double>(receivers.size());
  measured.variance /= counted, measured.weighed /= choices;
  measured.microseconds = seconds / choices * 1e6, measured.pass_ms = pass_seconds / passes * 1e3;
  return measured;
}

struct Variant {
  const char* name;
  LightChoice lights;
  Resampling resampling;
  Importance importance;
  RangeNumbers numbers;
};

constexpr Variant kVariants[] = {
    {"uniform", LightChoice::uniform, {}, {}, {}},
    {"power", LightChoice::power, {}, {}, {}},
    {"tree", LightChoice::tree, {}, {}, {}},
    {"culling", LightChoice::culling, Resampling::all, Importance::reflected, RangeNumbers::independent},
    {"culling, stratified", LightChoice::culling, Resampling::all, Importance::reflected, RangeNumbers::stratified},
    {"culling, [TH16] Eq. 9", LightChoice::culling, Resampling::all, Importance::printed, RangeNumbers::independent},
    {"culling, list of 8", LightChoice::culling, Resampling::list, Importance::reflected, RangeNumbers::independent},
    {"culling, list of 8, Eq. 9", LightChoice::culling, Resampling::list, Importance::printed,
     RangeNumbers::independent},
    {"exhaustive", LightChoice::exhaustive, {}, {}, {}},
};

void print_scene(const std::string& name) {
  const Stage stage = open_stage(name, {});
  const LightSet lights(*stage.scene);
  const Result<RayScene> rays = RayScene::create(stage.scene);
  PathSettings settings;
  settings.isa = stage.settings.isa;
  const CameraRays camera(stage.camera, settings);
  const std::vector<Receiver> all = probe_receivers(*rays, camera, settings);
  std::vector<Receiver> some;
  for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(all.size() / kReceivers, 1))
    some.push_back(all[i]);
  std::printf("\n## `%s`, %u lights\n\n", name.c_str(), lights.size());
  std::printf("| choice | relative variance | lights weighed | µs per choice | ms per pass | bytes per light |\n");
  std::printf("| --- | ---: | ---: | ---: | ---: | ---: |\n");
  for (const Variant& variant : kVariants) {
    settings.lights = variant.lights, settings.resampling = variant.resampling;
    settings.importance = variant.importance, settings.range_samples = variant.numbers;
    const auto sampler = make_light_sampler({*stage.scene, lights, settings, all, rays->bounds().diagonal()});
    const bool slow = variant.lights == LightChoice::exhaustive && lights.size() > 100000;
    const Measured m = measure(lights, *sampler, some, slow ? 4 : kPasses);
    std::printf("| %s | %.3g | %.1f | %.2f | %.2f | %.0f |\n", variant.name, m.variance, m.weighed, m.microseconds,
                m.pass_ms, double(lights.memory_bytes() + sampler->memory_bytes()) / lights.size());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  std::vector<std::string> scenes(argv + 1, argv + argc);
  if (scenes.empty()) scenes = {"recipe:lamps?count=5000", "recipe:lamps?count=60000", "recipe:lamps?count=1000000"};
  luciole::print_page_head("The choice of lights alone", "benchmarks/run.sh light_choice");
  std::printf(
      "\nSurface points of paths of three bounces; the light that one chosen lamp's centre reflects towards the eye, "
      "over\n"
      "its probability: unoccluded, without multiple importance sampling. One choice at a time, on one thread; in a\n"
      "picture neighbouring points share most of the walk through the lights.\n");
  for (const std::string& scene : scenes) luciole::print_scene(scene);
}
