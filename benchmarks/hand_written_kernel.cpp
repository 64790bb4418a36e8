// SPDX-License-Identifier: Apache-2.0
// Compiled with AVX-512; to be called on such processors only.
#include "benchmarks/hand_written_kernel.h"

#include <immintrin.h>

#define LUCIOLE_FN inline __attribute__((always_inline))

namespace luciole::hand_written {
namespace {

#include "benchmarks/hand_written_body.inc"

template <Loop kLoop, class Emitter>
void shade_list(const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) {
  constexpr bool kExact = kLoop == Loop::exact;
  const Pixels pixels = load_pixels(group);
  const V zero = _mm512_setzero_ps();
  Sums sums{{zero, zero, zero}, {zero, zero, zero}, zero};
  std::uint32_t i = 0;
  if constexpr (kLoop == Loop::two_lights) {
    for (; i + 1 < list.count; i += 2) {
      const Tested a = test<kExact>(pixels, list.emitters[list.index[i]]);
      const Tested b = test<kExact>(pixels, list.emitters[list.index[i + 1]]);
      if (a.accepted) add<kExact>(pixels, a, sums);
      if (b.accepted) add<kExact>(pixels, b, sums);
    }
  }
  for (; i < list.count; ++i) {
    const Tested t = test<kExact>(pixels, list.emitters[list.index[i]]);
    if (kLoop == Loop::branch_free || t.accepted) add<kExact>(pixels, t, sums);
  }
  store3(out.diffuse, sums.diffuse);
  store3(out.specular, sums.specular);
  _mm512_store_ps(out.accepted, sums.accepted);
}

template <class Emitter>
void shade(Loop loop, const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) {
  switch (loop) {
    case Loop::early_out:
      return shade_list<Loop::early_out>(group, list, out);
    case Loop::branch_free:
      return shade_list<Loop::branch_free>(group, list, out);
    case Loop::two_lights:
      return shade_list<Loop::two_lights>(group, list, out);
    case Loop::exact:
      return shade_list<Loop::exact>(group, list, out);
  }
}

}  // namespace

void shade_group(Loop loop, const PixelGroup& group, const LightList<DiffuseEmitter>& list, GroupRadiance& out) {
  shade(loop, group, list, out);
}
void shade_group(Loop loop, const PixelGroup& group, const LightList<GlossyEmitter>& list, GroupRadiance& out) {
  shade(loop, group, list, out);
}

}  // namespace luciole::hand_written
