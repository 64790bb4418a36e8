// SPDX-License-Identifier: Apache-2.0
#include "offline/settings.h"

namespace luciole {

const SettingTable<PathSettings>& path_setting_table() {
  using S = PathSettings;
  static const auto positive = [](std::uint32_t n) { return n >= 1 && n <= 1024; };
  static const auto any_seed = [](std::uint64_t) { return true; };
  static const SettingTable<S> table({
      size_entry<S>(),
      whole_entry<S, std::uint32_t>("bounces", "surface scatterings: 1 direct light, 2 with one bounce, ...",
                                    "a whole number from 1 to 1024", &S::bounces, positive),
      choice_entry("lights", "choice of lights: culling|uniform|power|tree|exhaustive|clamped", &S::lights),
      choice_entry("resampling", "culling: overlapping lights that are weighed: all|list", &S::resampling),
      whole_entry<S, std::uint32_t>("list_length", "lights that a list keeps", "a whole number from 1 to 32",
                                    &S::list_length, [](std::uint32_t n) { return n >= 1 && n <= 32; }),
      choice_entry("importance", "culling: weight of a light: reflected|printed ([TH16] Eq. 9)", &S::importance),
      choice_entry("range_samples", "random numbers of the lights: independent|stratified", &S::range_samples),
      positive_entry("error_bound", "largest standard deviation per light and pass [display units]; 0: automatic",
                     &S::error_bound, true),
      choice_entry("pixel_filter", "box (one pixel)|tent|gaussian", &S::pixel_filter),
      positive_entry("aperture", "radius of the lens [m]; 0: everything is sharp", &S::aperture, true),
      positive_entry("focus", "distance in focus [m]; 0: the picture's centre", &S::focus, true),
      positive_entry("exposure", "display value per radiance, linear", &S::exposure),
      whole_entry<S, std::uint64_t>("seed", "seed of all random numbers", "a whole number from 0", &S::seed, any_seed),
      choice_entry("isa", "instruction set: auto|avx512|avx2|baseline", &S::isa),
  });
  return table;
}

}  // namespace luciole
