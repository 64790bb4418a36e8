// SPDX-License-Identifier: Apache-2.0
// A data race on purpose. Built only under the thread sanitizer, whose suppressions must not hide it: ./do check fails
// if this program ends without a report.
#include <cstdio>

#include "base/parallel.h"

int main() {
  long unguarded = 0;
  luciole::with_threads(2, [&] {
    luciole::parallel_for(1 << 16, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++unguarded;
    });
  });
  std::printf("counted %ld\n", unguarded);
  return 0;
}
