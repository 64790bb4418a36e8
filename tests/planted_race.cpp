// SPDX-License-Identifier: Apache-2.0
// A data race on purpose. Built only under the thread sanitizer, whose suppressions must not hide it: ./do check fails
// if this program ends without a report.
#include <atomic>
#include <chrono>
#include <cstdio>

#include "base/parallel.h"

int main() {
  long unguarded = 0;
  std::atomic<int> arrived{0};
  luciole::with_threads(2, [&] {
    luciole::parallel_for(2, 1, [&](std::size_t, std::size_t) {
      // Each half waits for the other, so that two threads are here. Relaxed: the meeting must not order them.
      arrived.fetch_add(1, std::memory_order_relaxed);
      const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (arrived.load(std::memory_order_relaxed) < 2 && std::chrono::steady_clock::now() < patience) {
      }
      for (int i = 0; i < 1000; ++i) ++unguarded;
    });
  });
  std::printf("%d threads counted %ld\n", arrived.load(), unguarded);
  return 0;
}
