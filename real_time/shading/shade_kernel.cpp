// SPDX-License-Identifier: Apache-2.0
// Adds a list of lights to a group of pixels: one pixel per lane, lights in ascending order. Compiled once per
// instruction set; every path of the frame (culled or not) runs this very code, so that they agree bit for bit.
#include "real_time/shading/shade_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
namespace {

#include "real_time/shading/connection.inc"

struct Sums {
  real3 diffuse, specular;
  real accepted;
};

// A light at a group of pixels, before it is shaded.
struct Tested {
  Connection connection;
  Emitted emitted;
  real l_sq;  // with the near field's disc [m^2]
  mask accepted;
};

// [TH17] Eqs. 2 and 3: accepted where p > xi.
template <class Emitter>
LUCIOLE_FN Tested test(const Pixels& pixels, const Emitter& light) {
  Tested t;
  t.connection = connect(pixels, light.position);
  t.emitted = emit(light, -t.connection.to_light);
  t.l_sq = t.connection.distance_sq + light.disc;
  t.accepted = emission_is_accepted(t.emitted, t.l_sq, light.xi);
  return t;
}

// [TH17] Eqs. 2 and 3: the weight f/p is 1 / min(l^2, E I / delta) per intensity.
//   visible  lanes that the light's shadow ray reaches
template <bool kDivideByP>
LUCIOLE_FN void add_light(const Pixels& pixels, const Tested& t, std::uint32_t visible, Sums& sums) {
  const Emitted& e = t.emitted;
  if (!any(t.accepted)) return;
  sums.accepted += select(t.accepted, real(1.0f), real(0.0f));
  const mask lit = t.accepted && mask_from_bits(visible) && dot(pixels.geometric_normal, t.connection.to_light) > 0.0f;
  if (!any(lit)) return;
  const real weight = kDivideByP ? fall_off_over_probability(e, t.l_sq) : inverse(t.l_sq);
  const real3 arriving = e.colour * select(lit, e.factor * weight, real(0.0f));
  const Reflection r = reflection(pixels.brdf, t.connection.to_light);
  sums.diffuse += arriving * r.diffuse;
  sums.specular += arriving * r.specular;
}

// Two lights are tested before either is shaded: neither test waits for the other, which hides their latency. They are
// added one after the other, so that the sums do not change.
template <bool kDivideByP, class Emitter>
void shade_list(const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) {
  for (int lane = 0; lane < kGroupPixels; lane += kLanes) {
    const Pixels pixels = load_pixels(group, lane);
    const auto light = [&](std::uint32_t i) -> const Emitter& { return list.emitters[list.index[i]]; };
    const auto visible = [&](std::uint32_t i) {
      return list.visible ? static_cast<std::uint32_t>(list.visible[i]) >> lane : 0xffffu;
    };
    Sums sums;
    std::uint32_t i = 0;
    for (; i + 1 < list.count; i += 2) {
      const Tested first = test(pixels, light(i)), second = test(pixels, light(i + 1));
      add_light<kDivideByP>(pixels, first, visible(i), sums);
      add_light<kDivideByP>(pixels, second, visible(i + 1), sums);
    }
    if (i < list.count) add_light<kDivideByP>(pixels, test(pixels, light(i)), visible(i), sums);
    store3(out.diffuse, lane, sums.diffuse);
    store3(out.specular, lane, sums.specular);
    store(out.accepted + lane, sums.accepted);
  }
}

template <class Emitter>
void shade(const PixelGroup& group, const LightList<Emitter>& list, bool divide_by_p, GroupRadiance& out) {
  divide_by_p ? shade_list<true>(group, list, out) : shade_list<false>(group, list, out);
}

template <class Emitter>
void accept(const PixelGroup& group, const LightList<Emitter>& list, std::uint16_t* lanes) {
  for (std::uint32_t i = 0; i < list.count; ++i) lanes[i] = 0;
  for (int lane = 0; lane < kGroupPixels; lane += kLanes) {
    const Pixels pixels = load_pixels(group, lane);
    for (std::uint32_t i = 0; i < list.count; ++i) {
      const Emitter& light = list.emitters[list.index[i]];
      const Connection c = connect(pixels, light.position);
      const Emitted e = emit(light, -c.to_light);
      const mask accepted = emission_is_accepted(e, c.distance_sq + light.disc, light.xi);
      lanes[i] = static_cast<std::uint16_t>(lanes[i] | (lane_bits(accepted) << lane));
    }
  }
}

}  // namespace

void shade_group(const PixelGroup& group, const LightList<DiffuseEmitter>& list, bool divide_by_p, GroupRadiance& out) {
  shade(group, list, divide_by_p, out);
}
void shade_group(const PixelGroup& group, const LightList<GlossyEmitter>& list, bool divide_by_p, GroupRadiance& out) {
  shade(group, list, divide_by_p, out);
}
void shade_group(const PixelGroup& group, const LightList<ManyEmitter>& list, bool divide_by_p, GroupRadiance& out) {
  shade(group, list, divide_by_p, out);
}
void accepted_lanes(const PixelGroup& group, const LightList<DiffuseEmitter>& list, std::uint16_t* lanes) {
  accept(group, list, lanes);
}
void accepted_lanes(const PixelGroup& group, const LightList<GlossyEmitter>& list, std::uint16_t* lanes) {
  accept(group, list, lanes);
}
void accepted_lanes(const PixelGroup& group, const LightList<ManyEmitter>& list, std::uint16_t* lanes) {
  accept(group, list, lanes);
}

}  // namespace luciole::LUCIOLE_ISA
