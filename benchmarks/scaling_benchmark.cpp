// SPDX-License-Identifier: Apache-2.0
// What more virtual point lights cost at a fixed error bound: stochastic ranges against the constant range of the same
// bound ([TH16] Appendix A), and against the law of docs/mathematics.md for lights spread over a plane.
//   scaling_benchmark [shot]     prints Markdown
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "benchmarks/stage.h"
#include "real_time/frame.h"

namespace luciole {
namespace {

struct Cost {
  double lights = 0, listed = 0, evaluated = 0, accepted = 0;  // per pixel, but the first
  double culling_ms = 0, shading_ms = 0, ranges_ms = 0;
};

Cost measure(const Stage& stage, std::uint32_t vpls, Ranges ranges) {
  Settings settings = stage.settings;
  settings.vpls = vpls, settings.ranges = ranges, settings.filter = Filter::none;
  Result<Renderer> renderer = Renderer::create(stage.scene, stage.camera, stage.primaries, settings);
  Cost cost;
  if (!renderer) return cost;
  const int frames = ranges == Ranges::stochastic ? 3 : 1;
  std::vector<double> culling, shading, light_ranges;
  for (int i = 0; i < frames; ++i) {
    const Result<Frame> frame = renderer->render(static_cast<std::uint64_t>(i));
    if (!frame) return cost;
    const FrameStatistics& s = frame->statistics;
    for (const auto& [pass, ms] : s.passes_ms) {
      if (pass == "culling") culling.push_back(ms);
      if (pass == "shading") shading.push_back(ms);
      if (pass == "light_range") light_ranges.push_back(ms);
    }
    cost.lights = static_cast<double>(s.virtual_point_lights);
    cost.listed += s.listed.total() / frames, cost.evaluated += s.evaluated.total() / frames;
    cost.accepted += s.accepted.total() / frames;
  }
  cost.culling_ms = median(culling), cost.shading_ms = median(shading), cost.ranges_ms = median(light_ranges);
  return cost;
}

// Lights that a point in the plane of a disc full of N lights accepts: (1 + ln(x N)) / x with x = a R^2.
double plane_law(double x, double lights) { return (1 + std::log(x * lights)) / x; }

// The x for which `lights` lights give `accepted`; the law falls with x from x N = 1 on.
double fit_plane_law(double lights, double accepted) {
  double low = 1 / lights, high = 1e6;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (plane_law(middle, lights) > accepted ? low : high) = middle;
  }
  return low;
}

double exponent(double from, double to, double light_ratio) {
  return from > 0 && to > 0 ? std::log(to / from) / std::log(light_ratio) : 0;
}

void stochastic_table(const Stage& stage) {
  std::printf(
      "\n## Stochastic ranges\n\n| lights | listed | evaluated | accepted | exponent of accepted | law of a plane |"
      " its exponent | ranges ms | culling ms | shading ms | exponent of both |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  const double subsets = stage.settings.interleave * stage.settings.interleave;
  Cost before;
  double x = 0, law_before = 0;
  for (std::uint32_t vpls = 1024; vpls <= 1048576; vpls *= 4) {
    const Cost c = measure(stage, vpls, Ranges::stochastic);
    if (before.lights == 0) x = fit_plane_law(c.lights, c.accepted * subsets);
    const double law = plane_law(x, c.lights) / subsets, more = c.lights / std::max(before.lights, 1.0);
    std::printf("| %.0f | %.2f | %.2f | %.2f | ", c.lights, c.listed, c.evaluated, c.accepted);
    if (before.lights > 0) std::printf("%.2f", exponent(before.accepted, c.accepted, more));
    std::printf(" | %.2f | ", law);
    if (before.lights > 0) std::printf("%.2f", exponent(law_before, law, more));
    std::printf(" | %.1f | %.1f | %.1f | ", c.ranges_ms, c.culling_ms, c.shading_ms);
    if (before.lights > 0) {
      std::printf("%.2f", exponent(before.culling_ms + before.shading_ms, c.culling_ms + c.shading_ms, more));
    }
    std::printf(" |\n");
    std::fflush(stdout);
    before = c, law_before = law;
  }
}

void constant_table(const Stage& stage) {
  std::printf(
      "\n## The constant range of the same error bound (`--ranges clamped-bound`)\n\n"
      "| lights | listed | accepted | exponent of accepted | culling ms | shading ms |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: |\n");
  Cost before;
  for (std::uint32_t vpls = 1024; vpls <= 65536; vpls *= 4) {
    const Cost c = measure(stage, vpls, Ranges::clamped_bound);
    std::printf("| %.0f | %.2f | %.2f | ", c.lights, c.listed, c.accepted);
    if (before.lights > 0) std::printf("%.2f", exponent(before.accepted, c.accepted, c.lights / before.lights));
    std::printf(" | %.1f | %.1f |\n", c.culling_ms, c.shading_ms);
    std::fflush(stdout);
    before = c;
  }
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  const std::string shot = argc > 1 ? argv[1] : (has_scenes() ? "sponza" : "gallery");
  const Stage stage = open_stage(shot, {{"size", "960x540"}});
  print_page_head("Scaling with the number of lights", "benchmarks/run.sh scaling");
  std::printf(
      "\nShot `%s` at 960x540, delta %g, %ux%u interleaved; means per pixel over both lobes, each pixel seeing\n"
      "its own subset of the lights. The exponent of a cost c is d ln c / d ln N between a row and the one\n"
      "above. The law is (1 + ln(x N)) / x, for lights on a plane that holds the point, x fitted to the first\n"
      "row; in closed rooms the cost ends in a constant, as no light comes nearer any more.\n",
      shot.c_str(), static_cast<double>(stage.settings.delta), stage.settings.interleave, stage.settings.interleave);
  stochastic_table(stage);
  constant_table(stage);
  return 0;
}
