// SPDX-License-Identifier: Apache-2.0
// The inner loops of both kernels as straight lines between marks, for llvm-mca to count what the ports must do. Only
// ever compiled to assembly, by benchmarks/run.sh. "tested" stops at the test, as a light that no pixel accepts does;
// "accepted" goes all the way.
#include <immintrin.h>

#define LUCIOLE_ISA marked
#include "equations/cpp/wide.h"
#include "real_time/shading/shade_kernel.h"

#define LUCIOLE_MARK(name) asm volatile("# LLVM-MCA-" name ::: "memory")

namespace luciole::marked {

#include "real_time/shading/connection.inc"

// Keeps a value from being computed later than here, or not at all.
LUCIOLE_FN void need(real& v) { asm volatile("" : "+v"(v.v)); }
LUCIOLE_FN void need3(real3& v) { need(v.x), need(v.y), need(v.z); }
LUCIOLE_FN void need(__m512& v) { asm volatile("" : "+v"(v)); }
LUCIOLE_FN void need(std::uint32_t bits) { asm volatile("" ::"r"(bits)); }

template <class Emitter>
LUCIOLE_FN mask tested(const Pixels& pixels, const Emitter& light, Connection& c, Emitted& e, real& l_sq) {
  c = connect(pixels, light.position);
  e = emit(light, -c.to_light);
  l_sq = c.distance_sq + light.disc;
  return e.peak > l_sq * light.xi;
}

template <class Emitter>
LUCIOLE_FN void shade(const Pixels& pixels, const Emitter& light, real3& diffuse, real3& specular, real& accepted) {
  Connection c;
  Emitted e;
  real l_sq;
  const mask m = tested(pixels, light, c, e, l_sq);
  accepted += select(m, real(1.0f), real(0.0f));
  const mask lit = m && dot(pixels.geometric_normal, c.to_light) > 0.0f;
  const real3 arriving = e.colour * select(lit, e.factor * inverse(min(l_sq, e.peak)), real(0.0f));
  const Reflection r = reflection(pixels.brdf, c.to_light);
  diffuse += arriving * r.diffuse;
  specular += arriving * r.specular;
}

namespace by_hand {
#include "benchmarks/hand_written_body.inc"
}  // namespace by_hand

#define LUCIOLE_TESTED_LOOP(Emitter, name)                                                      \
  void name##_tested(const PixelGroup& group, const LightList<Emitter>& list) {                 \
    const Pixels pixels = load_pixels(group, 0);                                                \
    for (std::uint32_t i = 0; i < list.count; ++i) {                                            \
      LUCIOLE_MARK("BEGIN portable_" #name "_tested");                                          \
      Connection c;                                                                             \
      Emitted e;                                                                                \
      real l_sq;                                                                                \
      need(lane_bits(tested(pixels, list.emitters[list.index[i]], c, e, l_sq)));                \
      LUCIOLE_MARK("END portable_" #name "_tested");                                            \
    }                                                                                           \
  }                                                                                             \
  void name##_tested_by_hand(const PixelGroup& group, const LightList<Emitter>& list) {         \
    const by_hand::Pixels pixels = by_hand::load_pixels(group);                                 \
    for (std::uint32_t i = 0; i < list.count; ++i) {                                            \
      LUCIOLE_MARK("BEGIN by_hand_" #name "_tested");                                           \
      need(std::uint32_t(by_hand::test<false>(pixels, list.emitters[list.index[i]]).accepted)); \
      LUCIOLE_MARK("END by_hand_" #name "_tested");                                             \
    }                                                                                           \
  }
#define LUCIOLE_ACCEPTED_LOOP(Emitter, name)                                                                  \
  void name##_accepted(const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) {         \
    const Pixels pixels = load_pixels(group, 0);                                                              \
    real3 diffuse, specular;                                                                                  \
    real accepted;                                                                                            \
    for (std::uint32_t i = 0; i < list.count; ++i) {                                                          \
      LUCIOLE_MARK("BEGIN portable_" #name "_accepted");                                                      \
      shade(pixels, list.emitters[list.index[i]], diffuse, specular, accepted);                               \
      need3(diffuse), need3(specular), need(accepted);                                                        \
      LUCIOLE_MARK("END portable_" #name "_accepted");                                                        \
    }                                                                                                         \
    store3(out.diffuse, 0, diffuse), store3(out.specular, 0, specular), store(out.accepted, accepted);        \
  }                                                                                                           \
  void name##_accepted_by_hand(const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) { \
    const by_hand::Pixels pixels = by_hand::load_pixels(group);                                               \
    by_hand::Sums s{};                                                                                        \
    for (std::uint32_t i = 0; i < list.count; ++i) {                                                          \
      LUCIOLE_MARK("BEGIN by_hand_" #name "_accepted");                                                       \
      by_hand::add<false>(pixels, by_hand::test<false>(pixels, list.emitters[list.index[i]]), s);             \
      need(s.diffuse.x), need(s.diffuse.y), need(s.diffuse.z), need(s.specular.x), need(s.specular.y);        \
      need(s.specular.z), need(s.accepted);                                                                   \
      LUCIOLE_MARK("END by_hand_" #name "_accepted");                                                         \
    }                                                                                                         \
    by_hand::store3(out.diffuse, s.diffuse), by_hand::store3(out.specular, s.specular);                       \
    _mm512_store_ps(out.accepted, s.accepted);                                                                \
  }
LUCIOLE_TESTED_LOOP(DiffuseEmitter, diffuse)
LUCIOLE_TESTED_LOOP(GlossyEmitter, glossy)
LUCIOLE_ACCEPTED_LOOP(DiffuseEmitter, diffuse)
LUCIOLE_ACCEPTED_LOOP(GlossyEmitter, glossy)

}  // namespace luciole::marked
