// SPDX-License-Identifier: Apache-2.0
// How fast the cross bilateral filter is, in a synthetic room of walls, floor and spheres with interleaved noise.
//   filter_benchmark [--size WxH] [--threads N] [--isa avx512|avx2|baseline] [--radius X,Y] [--runs N]
// prints ms per picture, ms per megapixel, taps per second, and the share of the port bound at the clock of this run.
// On a machine that is busy, one tile (--size 64x64 --threads 1 --runs 1000) still finds its undisturbed time.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "real_time/filtering/bilateral_filter.h"
#include "real_time/filtering/synthetic_room.h"

namespace {

using namespace luciole;

struct Options {
  std::uint32_t width = 1920, height = 1080;
  int threads = 0, runs = 5;
  Isa isa = Isa::avx512;
  FilterRadius radius{8, 8};
};

bool parse(int count, char** arguments, Options& o) {
  for (int i = 1; i + 1 < count; i += 2) {
    const std::string name = arguments[i];
    const char* value = arguments[i + 1];
    if (name == "--size" && std::sscanf(value, "%ux%u", &o.width, &o.height) == 2) continue;
    if (name == "--threads" && std::sscanf(value, "%d", &o.threads) == 1) continue;
    if (name == "--runs" && std::sscanf(value, "%d", &o.runs) == 1) continue;
    if (name == "--radius" && std::sscanf(value, "%d,%d", &o.radius.x, &o.radius.y) == 2) continue;
    if (name == "--isa") {
      o.isa = std::strcmp(value, "avx512") == 0 ? Isa::avx512
              : std::strcmp(value, "avx2") == 0 ? Isa::avx2
                                                : Isa::baseline;
      continue;
    }
    return false;
  }
  return count % 2 == 1 && o.runs > 0 && o.radius.x >= 0 && o.radius.x <= kLargestFilterRadius && o.radius.y >= 0 &&
         o.radius.y <= kLargestFilterRadius && o.width > 0 && o.height > 0;
}

int lanes(Isa isa) { return isa == Isa::avx512 ? 16 : isa == Isa::avx2 ? 8 : 4; }

// Vector operations of a tap: 14 of weight and 8 of accumulation as multiply-adds on two ports. The baseline has none:
// 39 operations, on three ports of recent processors.
double cycles(Isa isa) { return isa == Isa::baseline ? 39.0 / 3.0 : 22.0 / 2.0; }

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// By a chain of multiplications that wait for each other, three cycles each on every processor with AVX2 [GHz].
double measured_clock_ghz() {
  constexpr int kChain = 20000;
  double best_ms = 1e9;
  for (int attempt = 0; attempt < 200; ++attempt) {
    const auto start = std::chrono::steady_clock::now();
    std::uint64_t x = 3;
    for (int i = 0; i < kChain; ++i) {
      x *= 0x9e3779b97f4a7c15u;
      asm volatile("" : "+r"(x));
    }
    best_ms = std::min(best_ms, milliseconds_since(start));
  }
  return 3.0 * kChain / best_ms * 1e-6;
}

void report(const Options& o, int threads, const std::vector<double>& sorted_ms) {
  const double pixels = double(o.width) * o.height, best_ms = sorted_ms.front();
  const double taps = pixels * (2 * o.radius.x + 1) * (2 * o.radius.y + 1);
  const double clock_ghz = measured_clock_ghz();
  const double bound_ms = taps * cycles(o.isa) / lanes(o.isa) / (threads * clock_ghz * 1e6);
  std::printf("%ux%u, %s, %d threads, %dx%d taps: best %.2f ms, median %.2f ms\n", o.width, o.height,
              to_string(o.isa).c_str(), threads, 2 * o.radius.x + 1, 2 * o.radius.y + 1, best_ms,
              sorted_ms[sorted_ms.size() / 2]);
  std::printf("best: %.1f ms per megapixel, %.2f G taps/s, %.0f %% of the port bound at %.2f GHz\n",
              best_ms / pixels * 1e6, taps / best_ms * 1e-6, 100 * bound_ms / best_ms, clock_ghz);
}

}  // namespace

int main(int count, char** arguments) {
  Options options;
  if (!parse(count, arguments, options)) {
    std::fprintf(stderr, "usage: filter_benchmark [--size WxH] [--threads N] [--isa ISA] [--radius X,Y] [--runs N]\n");
    return 2;
  }
  const SyntheticRoom room = make_synthetic_room(options.width, options.height);
  const Radiance noisy = interleaved_noise(room, 8, 1);
  with_threads(options.threads, [&] {
    BilateralFilterPass pass;
    std::vector<double> times_ms;
    for (int run = 0; run <= options.runs; ++run) {  // the first warms up
      const auto start = std::chrono::steady_clock::now();
      pass.run({room.geometry, noisy, options.radius, options.isa});
      if (run > 0) times_ms.push_back(milliseconds_since(start));
    }
    std::sort(times_ms.begin(), times_ms.end());
    report(options, thread_count(), times_ms);
  });
  return 0;
}
