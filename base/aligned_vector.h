// SPDX-License-Identifier: Apache-2.0
// std::vector for planes of pixels: its memory starts on a 64-byte boundary and may be read 64 bytes past its end, as
// SIMD loops and Embree ask. Growing leaves new values uninitialised on purpose: planes are written before they are
// read, by many threads.
#pragma once
#include <sys/mman.h>

#include <atomic>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace luciole {

namespace aligned_memory {

inline constexpr std::size_t kLine = 64, kHugePage = std::size_t{2} << 20, kLarge = std::size_t{1} << 20;
// A pixel lies at the same place of two dozen planes. Were these all aligned alike, it would lie in the same cache set
// of each, more often than a cache has ways: writing a geometry buffer took 2.5 times as long. So large planes start
// at different lines, 33 lines apart.
inline constexpr std::size_t kColours = 31, kColourStride = 33 * kLine;

inline std::align_val_t alignment(std::size_t bytes) {
  return bytes >= kLarge ? std::align_val_t{kHugePage} : std::align_val_t{kLine};
}

inline void* allocate(std::size_t bytes) {
  static std::atomic<std::size_t> next_colour{0};
  const bool large = bytes >= kLarge;
  const std::size_t offset = kLine + (large ? next_colour.fetch_add(1) % kColours * kColourStride : 0);
  const std::size_t total = offset + bytes + kLine;
  char* const start = static_cast<char*>(::operator new(total, alignment(bytes)));
  // Page by page, the first touch of a frame's planes would cost more than some passes.
  if (large) madvise(start, total, MADV_HUGEPAGE);
  std::memcpy(start + offset - sizeof(start), &start, sizeof(start));  // for release
  return start + offset;
}

inline void release(void* memory, std::size_t bytes) {
  char* start = nullptr;
  std::memcpy(&start, static_cast<char*>(memory) - sizeof(start), sizeof(start));
  ::operator delete(start, alignment(bytes));
}

}  // namespace aligned_memory

template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(aligned_memory::allocate(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) { aligned_memory::release(memory, count * sizeof(T)); }
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace luciole
