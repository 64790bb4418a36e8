// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <sys/resource.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>
#include <vector>

#include "base/thread_sanitizer.h"

namespace luciole {
namespace {

std::atomic<bool> stop_flag{false};

// Flush-to-zero and denormals-are-zero for the scope: the same arithmetic on every thread, and Embree's advice.
class DenormalsFlushed {
 public:
  DenormalsFlushed() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~DenormalsFlushed() { _mm_setcsr(saved_); }
  DenormalsFlushed(const DenormalsFlushed&) = delete;
  DenormalsFlushed& operator=(const DenormalsFlushed&) = delete;

 private:
  unsigned saved_;
};

}  // namespace

#if defined(LUCIOLE_THREAD_SANITIZER)

// Plain threads have the same freedom of order as TBB's, and the sanitizer sees all that happens (thread_sanitizer.h).
namespace {
std::atomic<int> thread_limit{0};
thread_local bool inside_loop = false;
}  // namespace

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t step = std::max<std::size_t>(grain, 1);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    const DenormalsFlushed scope;
    const bool outer = std::exchange(inside_loop, true);
    for (std::size_t begin = next.fetch_add(step); begin < count; begin = next.fetch_add(step)) {
      body(begin, std::min(begin + step, count));
    }
    inside_loop = outer;
  };
  std::vector<std::thread> helpers;
  for (int i = 1; i < thread_count() && !inside_loop && std::size_t(i) * step < count; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
}

void with_threads(int threads, const std::function<void()>& work) {
  const int before = thread_limit.exchange(threads);
  work();
  thread_limit = before;
}

int thread_count() {
  const int limit = thread_limit;
  return limit > 0 ? limit : static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
}

#else

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain == 0 ? 1 : grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const DenormalsFlushed scope;
                      body(range.begin(), range.end());
                    });
}

void with_threads(int threads, const std::function<void()>& work) {
  if (threads <= 0) return work();
  // The arena may hold more threads than the machine has cores; global_control lets it really have them.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(work);
}

int thread_count() { return tbb::this_task_arena::max_concurrency(); }

#endif

void request_stop() { stop_flag.store(true, std::memory_order_relaxed); }
bool stop_requested() { return stop_flag.load(std::memory_order_relaxed); }

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;
}

}  // namespace luciole
