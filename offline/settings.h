// SPDX-License-Identifier: Apache-2.0
// Every switch of the path tracer that changes its picture. Saved into each picture and into the statistics.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/isa.h"
#include "base/name_table.h"
#include "base/result.h"
#include "base/setting_table.h"

namespace luciole {

// How the light that a shadow ray goes to is chosen, among lamps that can be tens of thousands.
enum class LightChoice : std::uint8_t {
  culling,     // stochastic light culling, then all overlapping lights by importance      [TH16] sect. 5
  uniform,     // every light alike
  power,       // by flux
  tree,        // a light tree with orientation cones                                        [Conty and Kulla 2018]
  exhaustive,  // by importance among all lights: [TH16] Fig. 10's brute force, the measure of the others, slow
  clamped      // culling with one constant range for all lights and passes: too dark
};
// Which of the overlapping lights are weighed.
enum class Resampling : std::uint8_t {
  all,  // one weighted choice among all of them
  list  // k of them, uniformly, then one of the k by importance                             [TH16] Algorithm 3
};
// What a light is weighed by.
enum class Importance : std::uint8_t {
  reflected,  // light that an unoccluded light reflects towards the eye, over its probability to overlap
  printed     // [TH16] Eq. 9: stochastic fall-off, without the probability and the surface's material
};
enum class RangeNumbers : std::uint8_t {
  independent,  // multiple importance sampling completes the realised choice
  stratified    // over the lights along a curve; multiple importance sampling with a deterministic stand-in
};
enum class PixelFilter : std::uint8_t { box, tent, gaussian };

struct PathSettings {
  std::uint32_t width = 1280, height = 720;  // [pixels]
  std::uint32_t bounces = 3;                 // surface scatterings: 1 direct light, 2 with single-bounce indirect
  LightChoice lights = LightChoice::culling;
  Resampling resampling = Resampling::all;
  std::uint32_t list_length = 8;  // k of Resampling::list
  Importance importance = Importance::reflected;
  RangeNumbers range_samples = RangeNumbers::independent;
  float error_bound =
      0;  // [TH16] eps_max, display units, of one light in one pass; 0: so that some two dozen lights overlap
  PixelFilter pixel_filter = PixelFilter::gaussian;
  float aperture = 0;  // radius of the thin lens [m]; 0: a pinhole
  float focus = 0;     // distance to the plane in focus [m]; 0: what the picture's centre shows
  float exposure = 1;  // E: display value per radiance
  std::uint64_t seed = 1;
  Isa isa = Isa::automatic;
};

constexpr NameTable<LightChoice, 6> names(LightChoice) {
  return {{{LightChoice::culling, "culling"},
           {LightChoice::uniform, "uniform"},
           {LightChoice::power, "power"},
           {LightChoice::tree, "tree"},
           {LightChoice::exhaustive, "exhaustive"},
           {LightChoice::clamped, "clamped"}}};
}
constexpr NameTable<Resampling, 2> names(Resampling) {
  return {{{Resampling::all, "all"}, {Resampling::list, "list"}}};
}
constexpr NameTable<Importance, 2> names(Importance) {
  return {{{Importance::reflected, "reflected"}, {Importance::printed, "printed"}}};
}
constexpr NameTable<RangeNumbers, 2> names(RangeNumbers) {
  return {{{RangeNumbers::independent, "independent"}, {RangeNumbers::stratified, "stratified"}}};
}
constexpr NameTable<PixelFilter, 3> names(PixelFilter) {
  return {{{PixelFilter::box, "box"}, {PixelFilter::tent, "tent"}, {PixelFilter::gaussian, "gaussian"}}};
}

// The names that settings have on the command line and in pictures.
const SettingTable<PathSettings>& path_setting_table();

}  // namespace luciole
