// SPDX-License-Identifier: Apache-2.0
// What the rivals of tiled culling cost, as [TH17] Table 2: culling and shading of diffuse lights only and of glossy
// lights only, tiled with each bound and each tile test, with clamped ranges, clustered, by splatting and without
// culling, in one run of one program.
//   baselines_benchmark [--size WxH] [--interleave N] [--runs N] [--rival NAME] [shot ...]     prints Markdown
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "benchmarks/stage.h"
#include "real_time/light_range/clamped_range.h"
#include "real_time/light_range/light_range.h"
#include "real_time/shading/shading_pass.h"

namespace luciole {
namespace {

struct Options {
  std::string size = "1920x1080", interleave = "8";
  std::string rival;               // beside tiled culling; empty: all
  bool with_whole_subset = false;  // also without interleaving
  int runs = 5;
  std::vector<std::string> shots;
};

struct Lights {
  ReachingLights<DiffuseEmitter> diffuse;
  ReachingLights<GlossyEmitter> glossy;
  ReachingLights<ManyEmitter> many;
};

Lights reach(const PreparedStage& stage, const Settings& settings, bool glossy, float constant_xi) {
  const RangeParameters range = range_parameters(settings, stage.geometry.camera, {settings.seed, 0}, constant_xi);
  if (glossy) return {{}, reach_glossy_lobes(stage.lights, range, settings.interleave, settings.isa), {}};
  return {reach_diffuse_lobes(stage.lights, range, settings.interleave, settings.isa), {}, {}};
}

// What all lobes of a frame share when ranges are clamped.
float clamped_xi_of(const PreparedStage& stage) {
  const Lights diffuse = reach(stage, stage.settings, false, -1.0f), glossy = reach(stage, stage.settings, true, -1.0f);
  return clamped_xi({stage.geometry, diffuse.diffuse, glossy.glossy, diffuse.many, stage.settings});
}

struct Way {
  const char* name;
  Culling culling = Culling::tiled;
  TileTest test = TileTest::tight;
  BoundingVolume bounds = BoundingVolume::tight;
  Ranges ranges = Ranges::stochastic;
};

// The first is what the others are measured by.
std::vector<Way> all_ways() {
  return {{"tiled"},
          {"tiled, exact test", Culling::tiled, TileTest::exact},
          {"tiled, paper's test", Culling::tiled, TileTest::paper},
          {"tiled, spheroids", Culling::tiled, TileTest::tight, BoundingVolume::spheroid},
          {"tiled, spheroids, paper's test", Culling::tiled, TileTest::paper, BoundingVolume::spheroid},
          {"tiled, spheres", Culling::tiled, TileTest::tight, BoundingVolume::sphere},
          {"tiled, spheres at lights", Culling::tiled, TileTest::tight, BoundingVolume::sphere_at_light},
          {"tiled, clamped ranges", Culling::tiled, TileTest::tight, BoundingVolume::tight, Ranges::clamped},
          {"clustered", Culling::clustered},
          {"clustered, also below the surface", Culling::clustered, TileTest::paper},
          {"splatting", Culling::splatting},
          {"splatting, also below the surface", Culling::splatting, TileTest::paper},
          {"none", Culling::none}};
}

bool is_asked_for(const Way& way, const Options& options) {
  return options.rival.empty() || way.culling == Culling::tiled || to_string(way.culling) == options.rival;
}

// One way, and what its runs took.
struct Trial {
  Way way;
  Settings settings;
  Lights lights;
  double listed = 0, evaluated = 0, accepted = 0;  // light x pixel pairs per pixel
  double list_mib = 0;                             // memory of a frame's lists, or of its longest window's
  std::vector<double> culling_ms, shading_ms;      // processor time of each run

  double both_ms(std::size_t run) const { return culling_ms[run] + shading_ms[run]; }
};

Trial make_trial(const PreparedStage& stage, const Way& way, bool glossy, float clamped) {
  Trial trial{way, stage.settings, {}, 0, 0, 0, 0, {}, {}};
  trial.settings.culling = way.culling, trial.settings.tile_test = way.test;
  trial.settings.bounds = way.bounds, trial.settings.ranges = way.ranges;
  trial.lights = reach(stage, trial.settings, glossy, way.ranges == Ranges::clamped ? clamped : -1.0f);
  return trial;
}

void run(const PreparedStage& stage, bool glossy, Trial& trial) {
  // Processor time does not tell what other programs do. The two parts are timed by the clock on the wall; their share
  // of the whole stays the same.
  const std::clock_t start = std::clock();
  const Lights& lights = trial.lights;
  const ShadingOutputs out = shade({stage.geometry, lights.diffuse, lights.glossy, lights.many, trial.settings});
  const double spent_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const double culling_share = out.culling_seconds / (out.culling_seconds + out.shading_seconds);
  trial.culling_ms.push_back(spent_ms * culling_share), trial.shading_ms.push_back(spent_ms * (1 - culling_share));
  trial.list_mib = static_cast<double>(out.list_bytes) / (1 << 20);
  const LightCounts& counts = glossy ? out.glossy : out.diffuse;
  const double pixels = static_cast<double>(out.pixels);
  trial.listed = static_cast<double>(counts.listed) / pixels;
  trial.evaluated = static_cast<double>(counts.evaluated) / pixels;
  trial.accepted = static_cast<double>(counts.accepted) / pixels;
}

//   pixels  with a surface
void print_trial(const Trial& trial, const Trial& tiled, double pixels) {
  std::printf("| %s | %.2f | %.2f | %.2f |", trial.way.name, trial.listed, trial.evaluated, trial.accepted);
  const bool has_lists = trial.way.culling == Culling::clustered || trial.way.culling == Culling::splatting;
  has_lists ? std::printf(" %.0f |", trial.list_mib) : std::printf(" |");
  std::vector<double> both, per_evaluation;  // to tiled, round by round
  for (std::size_t i = 0; i < trial.culling_ms.size(); ++i) {
    both.push_back(trial.both_ms(i) / tiled.both_ms(i));
    per_evaluation.push_back(trial.shading_ms[i] / trial.evaluated * tiled.evaluated / tiled.shading_ms[i]);
  }
  const double shading_ms = median(trial.shading_ms);
  std::printf(" %.1f | %.1f | %.2f | %.2f | %.2f |\n", median(trial.culling_ms), shading_ms, median(both),
              shading_ms * 1e6 / (trial.evaluated * pixels), median(per_evaluation));
}

// All ways take turns, so that what slows the machine for seconds slows them alike.
void report(const PreparedStage& stage, const std::vector<Way>& ways, bool glossy, float clamped,
            const Options& options) {
  std::vector<Trial> trials;
  for (const Way& way : ways)
    if (is_asked_for(way, options)) trials.push_back(make_trial(stage, way, glossy, clamped));
  const Trial& tiled = trials.front();
  const bool interleaved = stage.settings.interleave > 1;
  for (int round = 0; round < (interleaved ? options.runs : 1); ++round)
    for (Trial& trial : trials)
      if (round == 0 || trial.way.culling != Culling::none) run(stage, glossy, trial);
  if (tiled.evaluated == 0) return;  // no such light here
  std::printf("\n## %s, %s lights only of %u%s\n\n", stage.name.c_str(), glossy ? "glossy" : "diffuse",
              stage.settings.vpls, interleaved ? "" : ", without interleaving");
  std::printf(
      "| culling | listed | evaluated | accepted | lists [MiB] | culling [ms] | shading [ms] | both, to tiled | ns per "
      "evaluation | to tiled |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  double pixels = 0;
  for (const float depth : stage.geometry.depth) pixels += depth != kNoSurface;
  for (const Trial& trial : trials) print_trial(trial, tiled, pixels);
  std::fflush(stdout);
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
    options.with_whole_subset = true;
    options.shots = {"recipe:ring?alpha=0.1", "gallery", "gallery-glossy"};
    if (has_scenes())
      options.shots.insert(options.shots.end(), {"sponza", "sponza-glossy", "sibenik", "sibenik-glossy"});
  }
  return options;
}

void print_introduction(const Options& options) {
  print_page_head("Rivals of tiled culling", "benchmarks/run.sh baselines");
  std::printf(R"(
[TH17] Table 2 compares culling and shading by tiled culling, clustered shading and splatting, for diffuse lights and for
glossy lights: on a GPU, tiled culling is 1.6 to 4.0 times as fast as clustered shading and 2.7 to 13.8 times as fast as
splatting. Here all are run by one program on the same cores, with the same shading kernel; but for clamped ranges they make
the same picture, bit for bit. The ratio that compares with the paper's is "both, to tiled". Why it is smaller here, and what
was tried to make the rivals fast: [decisions](../decisions/rivals.md).

%s, frame 0 of each shot, interleaved %sx%s. Counts come first, as they do not depend on the machine. They are light x
pixel pairs per pixel: listed by culling, evaluated by the shading kernel (16 lanes a group of pixels, whether used or not),
accepted. Lists are what the rivals have in memory at once. Times are medians of %d runs (of one without culling or
interleaving), processor time of all threads; reading the pixels is part of shading. Ratios are medians over rounds in which
all ways took turns. An evaluation is one pair in the shading kernel: the last columns divide shading by evaluations.

"Tiled" is our ellipsoid with our tile test and the test per 16 pixels. The paper's test knows neither the plane of the
light's surface nor groups of pixels. "Also below the surface" leaves the rivals' proxies as published (`--tile-test paper`).
Clamped ranges share one number, found so that lights of both kinds together are accepted as often as with stochastic ranges.
)",
              options.size.c_str(), options.interleave.c_str(), options.interleave.c_str(), options.runs);
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  const Options options = read_options(argc, argv);
  print_introduction(options);
  for (const std::string& shot : options.shots) {
    const PreparedStage stage = prepare_stage(shot, {{"size", options.size}, {"interleave", options.interleave}});
    const float clamped = clamped_xi_of(stage);
    for (const bool glossy : {false, true}) report(stage, all_ways(), glossy, clamped, options);
  }
  if (!options.with_whole_subset) return 0;
  const PreparedStage stage = prepare_stage("gallery", {{"size", options.size}, {"interleave", "1"}});
  const std::vector<Way> ways = {{"tiled"}, {"clustered", Culling::clustered}, {"splatting", Culling::splatting}};
  for (const bool glossy : {false, true}) report(stage, ways, glossy, -1.0f, options);
  return 0;
}
