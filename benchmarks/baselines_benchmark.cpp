// SPDX-License-Identifier: Apache-2.0
// What the rivals of tiled culling cost, as [TH17] Table 2: culling and shading of diffuse lights only and of glossy
// lights only, tiled, clustered, by splatting and without culling, in one run of one program.
//   baselines_benchmark [--size WxH] [--runs N] [shot ...]     prints Markdown
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "benchmarks/stage.h"
#include "real_time/light_range/light_range.h"
#include "real_time/shading/shading_pass.h"

namespace luciole {
namespace {

struct Options {
  std::string size = "1920x1080", interleave = "8";
  std::string rival;  // beside tiled culling; empty: all
  int runs = 5;
  std::vector<std::string> shots;
};

struct Lights {
  ReachingLights<DiffuseEmitter> diffuse;
  ReachingLights<GlossyEmitter> glossy;
  ReachingLights<ManyEmitter> many;
};

Lights reach(const PreparedStage& stage, const Settings& settings, bool glossy) {
  const RangeParameters range = range_parameters(settings, stage.geometry.camera, {settings.seed, 0}, -1.0f);
  if (glossy) return {{}, reach_glossy_lobes(stage.lights, range, settings.interleave, settings.isa), {}};
  return {reach_diffuse_lobes(stage.lights, range, settings.interleave, settings.isa), {}, {}};
}

struct Cost {
  double listed = 0, evaluated = 0, accepted = 0;  // light x pixel pairs per pixel
  double list_mib = 0;                             // memory of a frame's lists, or of its longest window's
  double culling_ms = 0, shading_ms = 0;           // of processor time
  double total_ms() const { return culling_ms + shading_ms; }
  double nanoseconds_per_pair(double pixels) const { return shading_ms * 1e6 / (evaluated * pixels); }
};

Cost measure(const PreparedStage& stage, const Settings& settings, bool glossy, int runs) {
  const Lights lights = reach(stage, settings, glossy);
  std::vector<double> culling_ms, shading_ms;
  Cost cost;
  for (int run = 0; run < runs; ++run) {
    // Processor time does not tell what other programs do. The two parts are timed by the clock on the wall; their
    // share of the whole stays the same.
    const std::clock_t start = std::clock();
    const ShadingOutputs out = shade({stage.geometry, lights.diffuse, lights.glossy, lights.many, settings});
    const double spent_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double culling_share = out.culling_seconds / (out.culling_seconds + out.shading_seconds);
    culling_ms.push_back(spent_ms * culling_share), shading_ms.push_back(spent_ms * (1 - culling_share));
    cost.list_mib = static_cast<double>(out.list_bytes) / (1 << 20);
    const LightCounts& counts = glossy ? out.glossy : out.diffuse;
    const double pixels = static_cast<double>(out.pixels);
    cost.listed = static_cast<double>(counts.listed) / pixels;
    cost.evaluated = static_cast<double>(counts.evaluated) / pixels;
    cost.accepted = static_cast<double>(counts.accepted) / pixels;
  }
  cost.culling_ms = median(culling_ms), cost.shading_ms = median(shading_ms);
  return cost;
}

void report(const PreparedStage& stage, bool glossy, const Options& options) {
  std::printf("\n## %s, %s lights only\n\n", stage.name.c_str(), glossy ? "glossy" : "diffuse");
  std::printf(
      "| culling | listed | evaluated | accepted | culling [ms] | shading [ms] | both / tiled | ns per evaluation | to "
      "tiled |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  double pixels = 0;
  for (const float depth : stage.geometry.depth) pixels += depth != kNoSurface;
  Cost tiled;
  struct Way {
    Culling culling;
    TileTest test;
    const char* name;
  };
  for (const Way& way :
       {Way{Culling::tiled, TileTest::tight, "tiled"}, Way{Culling::tiled, TileTest::paper, "tiled, paper's test"},
        Way{Culling::clustered, TileTest::tight, "clustered"},
        Way{Culling::clustered, TileTest::paper, "clustered, also below the surface"},
        Way{Culling::splatting, TileTest::tight, "splatting"},
        Way{Culling::splatting, TileTest::paper, "splatting, also below the surface"},
        Way{Culling::none, TileTest::tight, "none"}}) {
    if (!options.rival.empty() && way.culling != Culling::tiled && to_string(way.culling) != options.rival) continue;
    Settings settings = stage.settings;
    settings.culling = way.culling, settings.tile_test = way.test;
    const Cost cost = measure(stage, settings, glossy, options.runs);
    if (way.culling == Culling::tiled && way.test == TileTest::tight) tiled = cost;
    std::printf("| %s | %.2f | %.2f | %.2f | %.1f | %.1f | %.2f | %.2f | %.2f |\n", way.name, cost.listed,
                cost.evaluated, cost.accepted, cost.culling_ms, cost.shading_ms, cost.total_ms() / tiled.total_ms(),
                cost.nanoseconds_per_pair(pixels),
                cost.nanoseconds_per_pair(pixels) / tiled.nanoseconds_per_pair(pixels));
    std::fflush(stdout);
  }
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--size" && i + 1 < argc) {
      options.size = argv[++i];
    } else if (name == "--interleave" && i + 1 < argc) {
      options.interleave = argv[++i];
    } else if (name == "--rival" && i + 1 < argc) {
      options.rival = argv[++i];
    } else if (name == "--runs" && i + 1 < argc) {
      options.runs = std::max(1, std::atoi(argv[++i]));
    } else {
      options.shots.push_back(name);
    }
  }
  if (options.shots.empty()) {
    options.shots = {"recipe:ring?alpha=0.1", "gallery", "gallery-glossy"};
    if (has_scenes())
      options.shots.insert(options.shots.end(), {"sponza", "sponza-glossy", "sibenik", "sibenik-glossy"});
  }
  return options;
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  const Options options = read_options(argc, argv);
  print_page_head("Rivals of tiled culling", "benchmarks/run.sh baselines");
  std::printf(
      "\n%s, frame 0 of each shot, bounds `tight`; all ways make the same picture, bit for bit. Light x pixel pairs "
      "per "
      "pixel: listed\nby culling, evaluated by the shading kernel (16 lanes a group of pixels, whether used or not), "
      "accepted. Times are medians of\n%d runs, summed over the threads; reading the pixels is part of shading. An "
      "evaluation is one pair in the shading kernel.\nThe last but one column divides shading by evaluations. `paper` "
      "and \"also below the surface\" are `--tile-test paper`: no way\nof culling knows the plane of the light's "
      "surface, and tiles are shaded without the test per 16 pixels.\n",
      options.size.c_str(), options.runs);
  for (const std::string& shot : options.shots) {
    const PreparedStage stage = prepare_stage(shot, {{"size", options.size}, {"interleave", options.interleave}});
    for (const bool glossy : {false, true}) report(stage, glossy, options);
  }
  return 0;
}
