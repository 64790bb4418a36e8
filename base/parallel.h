// SPDX-License-Identifier: Apache-2.0
// Threads. A pass says how many independent items it has; which thread does which is never visible in the result.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>

namespace luciole {

// Calls body(begin, end) over a partition of [0, count) into ranges of at least `grain` items, on all threads of the
// current arena. Render arithmetic runs with denormals flushed to zero on every thread, as Embree asks.
void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

// Runs `work` with at most `threads` threads (0: all that the machine has).
void with_threads(int threads, const std::function<void()>& work);

// How many threads parallel_for uses here.
int thread_count();

// Ctrl-C: set by the command line's signal handler, asked by long loops between items.
void request_stop();
bool stop_requested();

// Largest resident set of this process so far [bytes].
std::uint64_t peak_memory_bytes();

}  // namespace luciole
