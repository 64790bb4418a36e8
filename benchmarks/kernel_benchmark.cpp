// SPDX-License-Identifier: Apache-2.0
// Light x pixel pairs per second of the shading kernel on one thread, beside a kernel written by hand with AVX-512
// intrinsics, and beside what the processor's ports allow.
//   kernel_benchmark [shot [port_bounds.txt]]
// port_bounds.txt holds lines "portable_diffuse_accepted 64.5": cycles per light and 16 pixels, as run.sh makes it
// with llvm-mca. Prints Markdown. For scripts:
//   kernel_benchmark --processor       prints the processor's class
//   kernel_benchmark --supports ISA    succeeds if the processor has the instruction set
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "base/isa.h"
#include "base/parallel.h"
#include "benchmarks/hand_written_kernel.h"
#include "benchmarks/listed_groups.h"

#if defined(LUCIOLE_OTHER_COMPILER)
namespace luciole::other_compiler {
void shade_group(const PixelGroup&, const LightList<DiffuseEmitter>&, bool divide_by_p, GroupRadiance&);
void shade_group(const PixelGroup&, const LightList<GlossyEmitter>&, bool divide_by_p, GroupRadiance&);
}  // namespace luciole::other_compiler
#endif

namespace luciole {
namespace {

constexpr int kRuns = 21;
using PortBounds = std::map<std::string, double>;  // cycles per light and group

template <class Emitter>
using Kernel = std::function<void(const PixelGroup&, const LightList<Emitter>&, GroupRadiance&)>;

template <class Emitter>
struct Variant {
  std::string name;
  Kernel<Emitter> kernel;
  std::vector<double> seconds = {};
};

template <class Emitter>
std::vector<Variant<Emitter>> variants() {
  using hand_written::Loop;
  const auto portable = [](Isa isa) {
    return [isa](const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) {
      LUCIOLE_FOR_ISA(isa, shade_group(group, list, true, out));
    };
  };
  const auto by_hand = [](Loop loop) {
    return [loop](const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) {
      hand_written::shade_group(loop, group, list, out);
    };
  };
  std::vector<Variant<Emitter>> all;
  if (choose_isa(Isa::avx512)) {
    all.push_back({"portable, AVX-512", portable(Isa::avx512)});
    all.push_back({"by hand, two lights at a time", by_hand(Loop::two_lights)});
    all.push_back({"by hand, one light at a time", by_hand(Loop::early_out)});
    all.push_back({"by hand, one light at a time, without branches", by_hand(Loop::branch_free)});
    all.push_back({"by hand, one light at a time, exact division and square root", by_hand(Loop::exact)});
#if defined(LUCIOLE_OTHER_COMPILER)
    all.push_back({"portable, AVX-512, by " LUCIOLE_OTHER_COMPILER,
                   [](const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) {
                     other_compiler::shade_group(group, list, true, out);
                   }});
#endif
  }
  if (choose_isa(Isa::avx2)) all.push_back({"portable, AVX2", portable(Isa::avx2)});
  all.push_back({"portable, baseline", portable(Isa::baseline)});
  return all;
}

template <class Emitter>
void run(const ListedGroups<Emitter>& work, const Kernel<Emitter>& kernel, std::vector<GroupRadiance>* sums) {
  GroupRadiance out;
  for (std::size_t g = 0; g < work.groups.size(); ++g) {
    if (work.lists[g].empty()) continue;
    kernel(work.groups[g], work.list(g), out);
    if (sums) sums->push_back(out);
  }
}

// Largest difference of a sum, relative to the group's largest; over groups where both accept as many lights, as a
// light whose p equals xi within rounding may go either way.
template <class Emitter>
double largest_difference(const ListedGroups<Emitter>& work, const Kernel<Emitter>& a, const Kernel<Emitter>& b) {
  std::vector<GroupRadiance> of_a, of_b;
  run(work, a, &of_a), run(work, b, &of_b);
  double worst = 0;
  for (std::size_t g = 0; g < of_a.size(); ++g) {
    if (!std::equal(of_a[g].accepted, of_a[g].accepted + kGroupPixels, of_b[g].accepted)) continue;
    const auto compare = [&](const float(&x)[3][kGroupPixels], const float(&y)[3][kGroupPixels]) {
      double largest = 1e-30, difference = 0;
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < kGroupPixels; ++i) {
          largest = std::max<double>(largest, std::abs(x[c][i]));
          difference = std::max<double>(difference, std::abs(double(x[c][i]) - y[c][i]));
        }
      worst = std::max(worst, difference / largest);
    };
    compare(of_a[g].diffuse, of_b[g].diffuse), compare(of_a[g].specular, of_b[g].specular);
  }
  return worst;
}

// The ports' bound of a mix [cycles per light and group]; 0 if not known.
//   accepting  share of light x group pairs where some pixel accepts
double bound_cycles(const PortBounds& bounds, const std::string& kernel, double accepting) {
  const auto tested = bounds.find(kernel + "_tested"), accepted = bounds.find(kernel + "_accepted");
  if (tested == bounds.end() || accepted == bounds.end()) return 0;
  return tested->second + accepting * (accepted->second - tested->second);
}

template <class Emitter>
void measure(const std::string& title, const std::string& lobe, const ListedGroups<Emitter>& work,
             const PortBounds& bounds) {
  const double pairs = static_cast<double>(work.pairs());
  if (pairs == 0) return;
  const double accepting = static_cast<double>(groups_that_accept(work)) * kGroupPixels / pairs;
  std::printf("\n## %s, %s\n\n%.0f thousand light x pixel pairs, %.1f %% accepted; some pixel of 16 accepts in %.1f %%",
              title.c_str(), lobe.c_str(), pairs / 1000, 100.0 * static_cast<double>(accepted_pairs(work)) / pairs,
              100 * accepting);
  std::vector<Variant<Emitter>> all = variants<Emitter>();
  std::vector<double> clock, ratio;
  const int repeats = std::max(1, static_cast<int>(2e6 / pairs));
  for (int r = 0; r < kRuns; ++r) {
    clock.push_back(clock_hz());
    for (Variant<Emitter>& v : all) {
      v.seconds.push_back(seconds_of([&] {
                            for (int i = 0; i < repeats; ++i) run(work, v.kernel, nullptr);
                          }) /
                          repeats);
    }
    if (all.size() > 1) ratio.push_back(all[1].seconds.back() / all[0].seconds.back());
  }
  const double hz = median(clock);
  std::printf(
      ". Clock %.2f GHz.\n\n| kernel | million pairs/s | cycles per light and 16 pixels | share of port bound |\n"
      "| --- | ---: | ---: | ---: |\n",
      hz * 1e-9);
  for (const Variant<Emitter>& v : all) {
    const double rate = pairs / median(v.seconds), cycles = hz * kGroupPixels / rate;
    const bool is_portable = &v == all.data(), is_hand = &v == all.data() + 1;
    const double bound =
        is_portable || is_hand ? bound_cycles(bounds, (is_portable ? "portable_" : "by_hand_") + lobe, accepting) : 0;
    std::printf("| %s | %.0f | %.1f | ", v.name.c_str(), rate * 1e-6, cycles);
    bound > 0 ? std::printf("%.0f %% of %.1f |\n", 100 * bound / cycles, bound) : std::printf("|\n");
  }
  if (!choose_isa(Isa::avx512)) return;
  if (const double simulated = bound_cycles(bounds, "simulated_portable_" + lobe, accepting); simulated > 0) {
    std::printf("\nOf one light after the other, with latencies and queues, llvm-mca expects %.1f cycles.\n",
                simulated);
  }
  std::printf("\nPortable / by hand: **%.2f** (median of %d runs side by side). Largest difference of a sum: %.1g.\n",
              median(ratio), kRuns, largest_difference(work, all[0].kernel, all[1].kernel));
}

template <class Emitter>
void measure_all(const std::string& lobe, const ListedGroups<Emitter>& real, const PortBounds& bounds) {
  measure("Real mix", lobe, real, bounds);
  measure("All accepted", lobe, all_accepted(real), bounds);
  measure("All rejected", lobe, all_rejected(real), bounds);
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  if (argc == 2 && std::string(argv[1]) == "--processor") return std::puts(processor_class().c_str()) < 0;
  if (argc == 3 && std::string(argv[1]) == "--supports") {
    Settings settings;
    return !set_setting(settings, "isa", argv[2]) || !choose_isa(settings.isa);
  }
  const std::string shot = argc > 1 ? argv[1] : (has_scenes() ? "sponza" : "gallery");
  PortBounds bounds;
  if (argc > 2) {
    std::ifstream file(argv[2]);
    std::string name;
    for (double cycles = 0; file >> name >> cycles;) bounds[name] = cycles;
  }
  const PreparedStage stage = prepare_stage(shot, {{"size", "1920x1080"}});
  print_page_head("The shading kernel", "benchmarks/run.sh kernel");
  std::printf(
      "\nOne thread; one block of 128x128 pixels of the shot `%s` at 1920x1080, 65,536 virtual point lights, "
      "8x8 interleaved.\nMedians of %d runs in turn. Port bound: cycles that llvm-mca 14 finds for the "
      "straight-line loop on\nthe ports of Ice Lake server.\n",
      shot.c_str(), kRuns);
  if (!choose_isa(Isa::avx512))
    std::printf("\nThis processor lacks AVX-512: the kernel written by hand is left out.\n");
  const std::uint32_t bx = stage.settings.width / 256, by = stage.settings.height / 256;
  with_threads(1, [&] {
    measure_all("diffuse", diffuse_groups(stage, bx, by), bounds);
    measure_all("glossy", glossy_groups(stage, bx, by), bounds);
  });
  return 0;
}
