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

// [TH17] Eqs. 2 and 3 at once: accepted where p > xi; weight f/p = 1 / min(l^2, E I / delta) per intensity.
//   visible  lanes that the light's shadow ray reaches
template <bool kDivideByP, class Emitter>
LUCIOLE_FN void add_light(const Pixels& pixels, const Emitter& light, std::uint32_t visible, Sums& sums) {
  const Connection c = connect(pixels, light.position);
  const Emitted e = emit(light, -c.to_light);
  const real l_sq = c.distance_sq + light.disc;
  const mask accepted = e.peak > l_sq * light.xi;
  if (!any(accepted)) return;
  sums.accepted += select(accepted, real(1.0f), real(0.0f));
  const mask lit = accepted && mask_from_bits(visible) && dot(pixels.geometric_normal, c.to_light) > 0.0f;
  if (!any(lit)) return;
  const real fall_off = inverse(kDivideByP ? min(l_sq, e.peak) : l_sq);
  const real3 arriving = e.colour * select(lit, e.factor * fall_off, real(0.0f));
  const Reflection r = reflection(pixels.brdf, c.to_light);
  sums.diffuse += arriving * r.diffuse;
  sums.specular += arriving * r.specular;
}

template <bool kDivideByP, class Emitter>
void shade_list(const PixelGroup& group, const LightList<Emitter>& list, GroupRadiance& out) {
  for (int lane = 0; lane < kGroupPixels; lane += kLanes) {
    const Pixels pixels = load_pixels(group, lane);
    Sums sums;
    for (std::uint32_t i = 0; i < list.count; ++i) {
      const std::uint32_t visible = list.visible ? static_cast<std::uint32_t>(list.visible[i]) >> lane : 0xffffu;
      add_light<kDivideByP>(pixels, list.emitters[list.index[i]], visible, sums);
    }
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
      const mask accepted = e.peak > (c.distance_sq + light.disc) * light.xi;
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
