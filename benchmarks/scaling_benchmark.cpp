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

// Lights that a point at height h above a disc of radius R full of lights accepts, docs/mathematics.md:
// s (N rho^2 + ln((1 + k) / (rho^2 + k)) / x), x = a R^2, k = (h / R)^2, rho the share of R inside which every light
// is accepted, s the share of lights that face the point at all.
struct PlaneLaw {
  double x = 1, k = 1, share = 1;
  double lights(double n) const {
    const double rho_sq = std::clamp(1 / (x * n) - k, 0.0, 1.0);
    return share * (n * rho_sq + std::log((1 + k) / (rho_sq + k)) / x);
  }
};

// The law with the least squared relative error, over a grid of x and k.
PlaneLaw fit_law(const std::vector<Cost>& rows, double subsets) {
  PlaneLaw best;
  double least = 1e30;
  for (double x = 1e-6; x < 10; x *= 1.1)
    for (double k = 1e-6; k < 100; k *= 1.1) {
      PlaneLaw law{x, k, 1};
      double sum = 0, sum_sq = 0;
      for (const Cost& row : rows) {
        const double error = std::log(row.accepted * subsets / law.lights(row.lights));
        sum += error, sum_sq += error * error;
      }
      const double n = static_cast<double>(rows.size()), spread = sum_sq - sum * sum / n;
      if (spread >= least) continue;
      least = spread, law.share = std::exp(sum / n), best = law;
    }
  return best;
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
  std::vector<Cost> rows;
  for (std::uint32_t vpls = 1024; vpls <= 1048576; vpls *= 4) rows.push_back(measure(stage, vpls, Ranges::stochastic));
  const PlaneLaw law = fit_law(rows, subsets);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Cost &c = rows[i], &before = rows[i > 0 ? i - 1 : 0];
    const double more = c.lights / before.lights, by_law = law.lights(c.lights) / subsets;
    std::printf("| %.0f | %.2f | %.2f | %.2f | ", c.lights, c.listed, c.evaluated, c.accepted);
    if (i > 0) std::printf("%.2f", exponent(before.accepted, c.accepted, more));
    std::printf(" | %.2f | ", by_law);
    if (i > 0) std::printf("%.2f", exponent(law.lights(before.lights), law.lights(c.lights), more));
    std::printf(" | %.1f | %.1f | %.1f | ", c.ranges_ms, c.culling_ms, c.shading_ms);
    if (i > 0) std::printf("%.2f", exponent(before.culling_ms + before.shading_ms, c.culling_ms + c.shading_ms, more));
    std::printf(" |\n");
  }
  std::printf("\nLaw: a R^2 = %.3g, h / R = %.3g, share of lights that face the point %.2g.\n", law.x, std::sqrt(law.k),
              law.share);
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
      "above. The law is that of lights on a plane at some height over the point, fitted to all rows: linear while\n"
      "every light is accepted, then logarithmic, then a constant once no light is nearer than the nearest wall.\n",
      shot.c_str(), static_cast<double>(stage.settings.delta), stage.settings.interleave, stage.settings.interleave);
  stochastic_table(stage);
  constant_table(stage);
  return 0;
}
