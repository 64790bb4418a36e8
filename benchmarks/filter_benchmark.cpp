// SPDX-License-Identifier: Apache-2.0
// How fast the cross bilateral filter is, in a synthetic room of walls, floor and spheres with interleaved noise.
//   filter_benchmark [--size WxH] [--threads N] [--isa avx512|avx2|baseline] [--radius X,Y] [--runs N] [--clock GHz]
// prints ms per picture and per megapixel, taps per second, and the share of the port bound at the given clock. All but
// the first of these come from the processor time of all threads over their number: what a machine that does nothing
// else would take, and steadier than the clock on the wall.
#include <sys/resource.h>

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
  double clock_ghz = 0;  // 0: not known, no share is printed
};

bool parse(int count, char** arguments, Options& o) {
  for (int i = 1; i + 1 < count; i += 2) {
    const std::string name = arguments[i];
    const char* value = arguments[i + 1];
    if (name == "--size" && std::sscanf(value, "%ux%u", &o.width, &o.height) == 2) continue;
    if (name == "--threads" && std::sscanf(value, "%d", &o.threads) == 1) continue;
    if (name == "--runs" && std::sscanf(value, "%d", &o.runs) == 1) continue;
    if (name == "--radius" && std::sscanf(value, "%d,%d", &o.radius.x, &o.radius.y) == 2) continue;
    if (name == "--clock" && std::sscanf(value, "%lf", &o.clock_ghz) == 1) continue;
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

// Vector operations of a tap: 14 of weight and 8 of accumulation as multiply-adds; the baseline has none.
double operations(Isa isa) { return isa == Isa::baseline ? 36 : 22; }

double processor_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& t) { return double(t.tv_sec) * 1e3 + double(t.tv_usec) * 1e-3; };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void report(const Options& o, int threads, double wall_ms, double median_ms) {
  const double pixels = double(o.width) * o.height;
  const double taps = pixels * (2 * o.radius.x + 1) * (2 * o.radius.y + 1);
  std::printf(
      "%ux%u, %s, %d threads, %dx%d taps: best %.2f ms on the wall, median %.2f ms of processor per thread; %.1f ms "
      "per megapixel, %.2f G taps/s",
      o.width, o.height,
      o.isa == Isa::avx512 ? "avx512"
      : o.isa == Isa::avx2 ? "avx2"
                           : "baseline",
      threads, 2 * o.radius.x + 1, 2 * o.radius.y + 1, wall_ms, median_ms, median_ms / pixels * 1e6,
      taps / median_ms * 1e-6);
  if (o.clock_ghz > 0) {  // two ports for such operations per core
    const double bound_ms = taps * operations(o.isa) / lanes(o.isa) / (2.0 * threads * o.clock_ghz * 1e6);
    std::printf(", %.0f %% of the port bound at %.2f GHz", 100 * bound_ms / median_ms, o.clock_ghz);
  }
  std::printf("\n");
}

}  // namespace

int main(int count, char** arguments) {
  Options options;
  if (!parse(count, arguments, options)) {
    std::fprintf(stderr,
                 "usage: filter_benchmark [--size WxH] [--threads N] [--isa ISA] [--radius X,Y] [--runs N] "
                 "[--clock GHz]\n");
    return 2;
  }
  const SyntheticRoom room = make_synthetic_room(options.width, options.height);
  const Radiance noisy = interleaved_noise(room, 8, 1);
  with_threads(options.threads, [&] {
    BilateralFilterPass pass;
    std::vector<double> wall_ms, thread_ms;
    for (int run = 0; run <= options.runs; ++run) {  // the first warms up
      const double before_ms = processor_ms();
      const auto start = std::chrono::steady_clock::now();
      pass.run({room.geometry, noisy, options.radius, options.isa});
      const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
      if (run == 0) continue;
      wall_ms.push_back(time.count());
      thread_ms.push_back((processor_ms() - before_ms) / thread_count());
    }
    report(options, thread_count(), *std::min_element(wall_ms.begin(), wall_ms.end()), median(thread_ms));
  });
  return 0;
}
