// SPDX-License-Identifier: Apache-2.0
// How good are the lists? Lights listed per pixel for every bound and tile test, as [TH17] Figs. 9 and 10, beside two
// floors: an exact ellipsoid-tile test, and an oracle that lists just what some pixel of the tile half accepts.
//   culling_benchmark [shot ...]     prints Markdown; no machine is in the figures
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "base/isa.h"
#include "benchmarks/stage.h"
#include "real_time/light_culling/tile.h"
#include "real_time/light_range/light_range.h"
#include "real_time/shading/shade_kernel.h"
#include "real_time/shading/shading_pass.h"

namespace luciole {
namespace {

struct Lists {
  double listed = 0, false_positives = 0, accepted = 0, in_groups = 0;  // glossy lights per pixel
};

struct Reached {
  ReachingLights<DiffuseEmitter> diffuse;
  ReachingLights<GlossyEmitter> glossy;
  ReachingLights<ManyEmitter> many;
};

Reached reach(const PreparedStage& stage, const Settings& settings) {
  const RangeParameters range = range_parameters(settings, stage.geometry.camera, {settings.seed, 0}, -1.0f);
  return {{}, reach_glossy_lobes(stage.lights, range, settings.interleave, settings.isa), {}};
}

Lists measure(const PreparedStage& stage, BoundingVolume bounds, TileTest test) {
  Settings settings = stage.settings;
  settings.bounds = bounds, settings.tile_test = test;
  const Reached lights = reach(stage, settings);
  const ShadingOutputs out = shade({stage.geometry, lights.diffuse, lights.glossy, lights.many, settings});
  const double pixels = static_cast<double>(out.pixels);
  Lists lists;
  lists.listed = static_cast<double>(out.glossy.listed) / pixels;
  lists.accepted = static_cast<double>(out.glossy.accepted) / pixels;
  lists.false_positives = lists.listed - lists.accepted;
  lists.in_groups = static_cast<double>(out.glossy.evaluated) / pixels;
  return lists;
}

// What some pixel accepts, per tile half and per group.
Lists oracle(const PreparedStage& stage) {
  const Settings& settings = stage.settings;
  const Reached lights = reach(stage, settings);
  const std::uint32_t n = settings.interleave, side = kTileSide * n;
  ScreenTile tile;
  std::vector<std::uint16_t> lanes;
  std::vector<std::uint32_t> index;
  double listed = 0, in_groups = 0, pixels = 0;
  for (std::uint32_t by = 0; by * side < settings.height; ++by)
    for (std::uint32_t bx = 0; bx * side < settings.width; ++bx)
      for (std::uint32_t s = 0; s < n * n; ++s) {
        read_tile(stage.geometry, {n, bx, by, s % n, s / n}, tile);
        const std::uint32_t count = lights.glossy.count[s];
        index.resize(count), lanes.resize(count);
        std::iota(index.begin(), index.end(), 0u);
        std::vector<char> wanted[2] = {std::vector<char>(count), std::vector<char>(count)};
        for (std::uint32_t g = 0; g < tile.group_count; ++g) {
          const PixelGroup& group = tile.groups[g];
          const LightList<GlossyEmitter> list{lights.glossy.emitters.data() + lights.glossy.begin[s], index.data(),
                                              count, nullptr};
          LUCIOLE_FOR_ISA(settings.isa, accepted_lanes(group, list, lanes.data()));
          for (std::uint32_t i = 0; i < count; ++i) {
            if (lanes[i] == 0) continue;
            wanted[group.part][i] = 1;
            in_groups += kGroupPixels;
          }
        }
        for (int half = 0; half < 2; ++half) {
          const double here = tile.half[half].pixels;
          listed += here * std::accumulate(wanted[half].begin(), wanted[half].end(), 0.0);
          pixels += here;
        }
      }
  Lists lists;
  lists.listed = listed / pixels, lists.in_groups = in_groups / pixels;
  return lists;
}

void row(const char* bounds, const char* test, const Lists& lists, double worst) {
  std::printf("| %s | %s | %.2f | %.2f | %.3f | %.2f |\n", bounds, test, lists.listed, lists.false_positives,
              lists.false_positives / worst, lists.in_groups);
}

void report(const PreparedStage& stage) {
  std::printf("\n## %s\n\n", stage.name.c_str());
  const Lists at_light = measure(stage, BoundingVolume::sphere_at_light, TileTest::paper);
  const std::vector<double> alpha(stage.lights.ggx_alpha.begin(), stage.lights.ggx_alpha.end());
  std::printf(
      "%zu virtual point lights, %.2f glossy ones accepted per pixel. Their GGX alpha: a tenth below %.2g, half below "
      "%.2g, a tenth above %.2g.\n\n",
      stage.lights.size(), at_light.accepted, quantile(alpha, 0.1), quantile(alpha, 0.5), quantile(alpha, 0.9));
  std::printf("| bound | tile test | listed | false | false / false of sphere at light | listed per group of 16 |\n");
  std::printf("| --- | --- | ---: | ---: | ---: | ---: |\n");
  const double worst = at_light.false_positives;
  row("sphere at light", "paper", at_light, worst);
  row("sphere", "paper", measure(stage, BoundingVolume::sphere, TileTest::paper), worst);
  row("spheroid", "paper", measure(stage, BoundingVolume::spheroid, TileTest::paper), worst);
  row("spheroid", "tight", measure(stage, BoundingVolume::spheroid, TileTest::tight), worst);
  row("tight", "paper", measure(stage, BoundingVolume::tight, TileTest::paper), worst);
  row("tight", "tight", measure(stage, BoundingVolume::tight, TileTest::tight), worst);
  row("tight", "exact", measure(stage, BoundingVolume::tight, TileTest::exact), worst);
  Lists floor = oracle(stage);
  floor.false_positives = floor.listed - at_light.accepted;
  row("oracle", "", floor, worst);
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) {
    names = {
        "recipe:ring?alpha=0.4", "recipe:ring?alpha=0.2", "recipe:ring?alpha=0.1", "recipe:ring?alpha=0.05", "gallery",
        "gallery-glossy"};
  }
  if (argc == 1 && has_scenes()) {
    for (const char* more : {"sponza", "sponza-glossy", "sibenik", "sibenik-glossy"}) names.emplace_back(more);
  }
  print_page_head("Culling efficiency", "benchmarks/run.sh culling");
  std::printf(
      "\nGlossy lights per pixel at 1920x1080, 8x8 interleaved, frame 0. "
      "No machine is in these figures.\n"
      "A lobe of alpha near one is round: then no bound beats a sphere at the light by much, and few lights are listed "
      "at all.\n");
  for (const std::string& name : names) report(prepare_stage(name, {{"size", "1920x1080"}}));
  return 0;
}
