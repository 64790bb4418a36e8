// SPDX-License-Identifier: Apache-2.0
#include "real_time/settings_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "real_time/setting_names.h"

namespace luciole {
namespace {

using Entry = SettingEntry<Settings>;

Entry error_bound_entry() {
  const auto set = [](Settings& settings, std::string_view text) {
    float bound = 0;  // largest standard deviation of one light [display units]
    if (!parse_positive(text, bound)) return false;
    settings.delta = 2 * std::numbers::pi_v<float> * bound;  // [TH16] Eq. 6, with I(w_o) in place of its maximum
    return std::isfinite(settings.delta);
  };
  return {"error_bound", "largest standard deviation per light, instead of delta", "a number above 0", set, {}};
}

Entry range_samples_entry() {
  return {
      "range_samples", "random numbers of the lights: independent|stratified", "one of independent, stratified",
      [](Settings& settings, std::string_view text) {
        if (text != "stratified" && text != "independent") return false;
        settings.stratified_ranges = text == "stratified";
        return true;
      },
      [](const Settings& settings) { return std::string(settings.stratified_ranges ? "stratified" : "independent"); }};
}

// Which device was taken stands beside the settings, with its full name.
Entry device_entry() {
  const auto set = [](Settings& settings, std::string_view text) {
    settings.device = text;
    return !text.empty();
  };
  return {"device", "Vulkan device: its number or a part of its name (luciole devices)", "a number or a name", set, {}};
}

// No part of the picture either.
Entry validation_entry() {
  Entry entry = switch_entry("vulkan_validation", "whatever Vulkan's validation layers say fails the run; slow",
                             &Settings::vulkan_validation);
  entry.text = nullptr;
  return entry;
}

const SettingTable<Settings>& table() {
  static const auto any_seed = [](std::uint64_t) { return true; };
  static const SettingTable<Settings> entries({
      size_entry<Settings>(),
      whole_entry<Settings, std::uint32_t>("vpls", "virtual point lights in all", "a whole number from 1 to 4294967295",
                                           &Settings::vpls, [](std::uint32_t count) { return count >= 1; }),
      choice_entry("bounds", "volume round a light's reach: sphere-at-light|sphere|spheroid|tight", &Settings::bounds),
      choice_entry("tile_test", "volume against tile: paper|exact|tight (tight for tight bounds, else paper)",
                   &Settings::tile_test),
      choice_entry("culling", "lights of a pixel, by: tiled|clustered|splatting|none; the same bits",
                   &Settings::culling),
      choice_entry("ranges", "reach of lights: stochastic|clamped|clamped-bound|infinite", &Settings::ranges),
      choice_entry("lobes", "light of virtual point lights: all|diffuse|glossy", &Settings::lobes),
      choice_entry("near_field", "light close to a VPL: disc|point", &Settings::near_field),
      choice_entry("filter", "noise filter: bilateral|none", &Settings::filter),
      whole_entry<Settings, std::uint32_t>("interleave", "n: n*n sub-regions of pixels: 1|2|4|8", "one of 1, 2, 4, 8",
                                           &Settings::interleave,
                                           [](std::uint32_t n) { return n == 1 || n == 2 || n == 4 || n == 8; }),
      positive_entry("delta", "roulette threshold [display units]; larger is faster and noisier", &Settings::delta),
      error_bound_entry(),
      positive_entry("exposure", "display value per radiance, linear", &Settings::exposure),
      range_samples_entry(),
      switch_entry("direct_shadows", "one shadow ray per accepted punctual or emissive light",
                   &Settings::direct_shadows),
      whole_entry<Settings, std::uint32_t>("temporal",
                                           "average light over up to this many frames, following the camera; 1: do not",
                                           "a whole number from 1 to 16777216", &Settings::temporal,
                                           [](std::uint32_t count) { return count >= 1 && count <= 1u << 24; }),
      switch_entry("jitter", "camera samples and VPLs move per frame: anti-aliasing", &Settings::jitter),
      whole_entry<Settings, std::uint64_t>("seed", "seed of ranges and interleaving", "a whole number from 0",
                                           &Settings::seed, any_seed),
      whole_entry<Settings, std::uint64_t>("vpl_seed", "seed of VPL positions; 0: texel centres",
                                           "a whole number from 0", &Settings::vpl_seed, any_seed),
      choice_entry("isa", "instruction set: auto|avx512|avx2|baseline", &Settings::isa),
      choice_entry("engine", "what computes the frame: cpu|vulkan|auto (a GPU if there is one)", &Settings::engine),
      device_entry(),
      choice_entry("front", "with Vulkan, what makes pixels, VPLs and direct light: auto|cpu|raster|rays",
                   &Settings::front),
      validation_entry(),
  });
  return entries;
}

bool has(const std::vector<SettingText>& entries, std::string_view name) {
  return std::any_of(entries.begin(), entries.end(), [name](const SettingText& entry) { return entry.first == name; });
}

Status apply(Settings& settings, const std::vector<SettingText>& entries) {
  if (has(entries, "delta") && has(entries, "error_bound")) {
    return Error{ErrorKind::usage, "delta and error_bound say the same in two ways: give one of them"};
  }
  for (const auto& [name, text] : entries) {
    if (Status status = set_setting(settings, name, text); !status) return status;
  }
  return Done{};
}

}  // namespace

const std::vector<std::string>& setting_names() { return table().names(); }

std::string setting_help(std::string_view name) { return table().help(name); }

Status set_setting(Settings& settings, std::string_view name, std::string_view text) {
  return table().set(settings, name, text);
}

Result<Settings> settings_from(const std::vector<SettingText>& shot, const std::vector<SettingText>& command_line) {
  Settings settings;
  for (const std::vector<SettingText>* entries : {&shot, &command_line}) {
    if (Status status = apply(settings, *entries); !status) return status.error();
  }
  if (!has(shot, "tile_test") && !has(command_line, "tile_test")) {
    settings.tile_test = settings.bounds == BoundingVolume::tight ? TileTest::tight : TileTest::paper;
  }
  return settings;
}

std::vector<SettingText> settings_as_text(const Settings& settings) { return table().as_text(settings); }

}  // namespace luciole
