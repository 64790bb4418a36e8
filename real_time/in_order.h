// SPDX-License-Identifier: Apache-2.0
// Keeps some of many items, in their order, on all threads.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/parallel.h"

namespace luciole {

// How many items are kept in all, and where those of each chunk go.
class KeptItems {
 public:
  // Asks keep(item) for every item of [0, items).
  template <class Keep>
  KeptItems(std::size_t items, const Keep& keep) : items_(items), first_((items + kChunk - 1) / kChunk + 1, 0) {
    for_each_chunk([&](std::size_t chunk, std::size_t begin, std::size_t end) {
      for (std::size_t item = begin; item < end; ++item) first_[chunk + 1] += keep(item) ? 1 : 0;
    });
    for (std::size_t chunk = 1; chunk < first_.size(); ++chunk) first_[chunk] += first_[chunk - 1];
  }

  std::size_t count() const { return first_.back(); }

  // Calls write(item, place) for every kept item, places 0 ... count()-1 in the order of the items. keep must answer as
  // before.
  template <class Keep, class Write>
  void write(const Keep& keep, const Write& write) const {
    for_each_chunk([&](std::size_t chunk, std::size_t begin, std::size_t end) {
      std::size_t place = first_[chunk];
      for (std::size_t item = begin; item < end; ++item) {
        if (keep(item)) write(item, place++);
      }
    });
  }

 private:
  static constexpr std::size_t kChunk = 4096;  // items per unit of work

  template <class Body>
  void for_each_chunk(const Body& body) const {
    parallel_for((items_ + kChunk - 1) / kChunk, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t chunk = begin; chunk < end; ++chunk) {
        body(chunk, chunk * kChunk, std::min(items_, (chunk + 1) * kChunk));
      }
    });
  }

  std::size_t items_;
  std::vector<std::size_t> first_;  // of each chunk; the last is the number of kept items
};

}  // namespace luciole
