// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <sys/resource.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <atomic>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define LUCIOLE_THREAD_SANITIZER
#endif
#endif
#if defined(__SANITIZE_THREAD__) || defined(LUCIOLE_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#else
// TBB is not compiled with the thread sanitizer, so the sanitizer has to be told what a loop orders.
#define __tsan_acquire(address) (void)(address)
#define __tsan_release(address) (void)(address)
#endif

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

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  [[maybe_unused]] char begun = 0, ended = 0;  // addresses to name the two orders by
  __tsan_release(&begun);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain == 0 ? 1 : grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      __tsan_acquire(&begun);
                      const DenormalsFlushed scope;
                      body(range.begin(), range.end());
                      __tsan_release(&ended);
                    });
  __tsan_acquire(&ended);
}

void with_threads(int threads, const std::function<void()>& work) {
  if (threads <= 0) return work();
  // The arena may hold more threads than the machine has cores; global_control lets it really have them.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(work);
}

int thread_count() { return tbb::this_task_arena::max_concurrency(); }

void request_stop() { stop_flag.store(true, std::memory_order_relaxed); }
bool stop_requested() { return stop_flag.load(std::memory_order_relaxed); }

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;
}

}  // namespace luciole
