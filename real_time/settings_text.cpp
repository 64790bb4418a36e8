// SPDX-License-Identifier: Apache-2.0
#include "real_time/settings_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/text.h"
#include "real_time/setting_names.h"

namespace luciole {
namespace {

constexpr std::uint32_t kLargestSide = 16384;  // [pixels], as image/ reads and writes

struct SettingEntry {
  const char* name;
  const char* help;
  const char* valid;                                     // completes "... must be "
  std::function<bool(Settings&, std::string_view)> set;  // false: not valid
  std::function<std::string(const Settings&)> text;      // empty function: not part of settings_as_text
};

template <class T>
bool parse_number(std::string_view text, T& number) {
  T parsed{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (fault != std::errc() || end != text.data() + text.size()) return false;
  number = parsed;
  return true;
}

bool parse_positive(std::string_view text, float& number) {
  float parsed = 0;
  if (!parse_number(text, parsed) || !std::isfinite(parsed) || !(parsed > 0)) return false;
  number = parsed;
  return true;
}

bool parse_size(Settings& settings, std::string_view text) {
  const std::size_t cross = text.find('x');
  std::uint32_t width = 0, height = 0;
  if (cross == std::string_view::npos || !parse_number(text.substr(0, cross), width) ||
      !parse_number(text.substr(cross + 1), height)) {
    return false;
  }
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) return false;
  settings.width = width, settings.height = height;
  return true;
}

SettingEntry switch_entry(const char* name, const char* help, bool Settings::*member) {
  return {name, help, "true or false",
          [member](Settings& settings, std::string_view text) {
            if (text != "true" && text != "false") return false;
            settings.*member = text == "true";
            return true;
          },
          [member](const Settings& settings) { return std::string(settings.*member ? "true" : "false"); }};
}

template <class T>
SettingEntry choice_entry(const char* name, const char* help, T Settings::*member) {
  static const std::string valid = "one of " + all_names<T>();  // one per T, and each T has one setting
  return {name, help, valid.c_str(),
          [member](Settings& settings, std::string_view text) {
            const std::optional<T> value = value_named<T>(text);
            if (value) settings.*member = *value;
            return value.has_value();
          },
          [member](const Settings& settings) { return to_string(settings.*member); }};
}

template <class T>
SettingEntry whole_entry(const char* name, const char* help, const char* valid, T Settings::*member,
                         bool (*allowed)(T)) {
  return {name, help, valid,
          [member, allowed](Settings& settings, std::string_view text) {
            T value = 0;
            if (!parse_number(text, value) || !allowed(value)) return false;
            settings.*member = value;
            return true;
          },
          [member](const Settings& settings) { return std::to_string(settings.*member); }};
}

SettingEntry positive_entry(const char* name, const char* help, float Settings::*member) {
  return {name, help, "a number above 0",
          [member](Settings& settings, std::string_view text) { return parse_positive(text, settings.*member); },
          [member](const Settings& settings) { return fmt::format("{}", settings.*member); }};
}

SettingEntry size_entry() {
  return {"size", "picture size, WIDTHxHEIGHT [pixels]", "WIDTHxHEIGHT with sides from 1 to 16384", parse_size,
          [](const Settings& settings) { return fmt::format("{}x{}", settings.width, settings.height); }};
}

SettingEntry error_bound_entry() {
  const auto set = [](Settings& settings, std::string_view text) {
    float bound = 0;  // largest standard deviation of one light [display units]
    if (!parse_positive(text, bound)) return false;
    settings.delta = 2 * std::numbers::pi_v<float> * bound;  // [TH16] Eq. 6, with I(w_o) in place of its maximum
    return std::isfinite(settings.delta);
  };
  return {"error_bound", "largest standard deviation per light, instead of delta", "a number above 0", set, {}};
}

SettingEntry range_samples_entry() {
  return {
      "range_samples", "random numbers of the lights: independent|stratified", "one of independent, stratified",
      [](Settings& settings, std::string_view text) {
        if (text != "stratified" && text != "independent") return false;
        settings.stratified_ranges = text == "stratified";
        return true;
      },
      [](const Settings& settings) { return std::string(settings.stratified_ranges ? "stratified" : "independent"); }};
}

const std::vector<SettingEntry>& table() {
  static const auto any_seed = [](std::uint64_t) { return true; };
  static const std::vector<SettingEntry> entries = {
      size_entry(),
      whole_entry<std::uint32_t>("vpls", "virtual point lights in all", "a whole number from 1 to 4294967295",
                                 &Settings::vpls, [](std::uint32_t count) { return count >= 1; }),
      choice_entry("bounds", "volume round a light's reach: sphere-at-light|sphere|spheroid|tight", &Settings::bounds),
      choice_entry("tile_test", "volume against tile: paper|exact|tight (tight for tight bounds, else paper)",
                   &Settings::tile_test),
      choice_entry("culling", "lights per tile: tiled|none", &Settings::culling),
      choice_entry("ranges", "reach of lights: stochastic|clamped|clamped-bound|infinite", &Settings::ranges),
      choice_entry("near_field", "light close to a VPL: disc|point", &Settings::near_field),
      choice_entry("filter", "noise filter: bilateral|none", &Settings::filter),
      whole_entry<std::uint32_t>("interleave", "n: n*n sub-regions of pixels: 1|2|4|8", "one of 1, 2, 4, 8",
                                 &Settings::interleave,
                                 [](std::uint32_t n) { return n == 1 || n == 2 || n == 4 || n == 8; }),
      positive_entry("delta", "roulette threshold [display units]; larger is faster and noisier", &Settings::delta),
      error_bound_entry(),
      positive_entry("exposure", "display value per radiance, linear", &Settings::exposure),
      range_samples_entry(),
      switch_entry("direct_shadows", "one shadow ray per accepted punctual or emissive light",
                   &Settings::direct_shadows),
      switch_entry("jitter", "camera samples and VPLs move per frame: anti-aliasing", &Settings::jitter),
      whole_entry<std::uint64_t>("seed", "seed of ranges and interleaving", "a whole number from 0", &Settings::seed,
                                 any_seed),
      whole_entry<std::uint64_t>("vpl_seed", "seed of VPL positions; 0: texel centres", "a whole number from 0",
                                 &Settings::vpl_seed, any_seed),
      choice_entry("isa", "instruction set: auto|avx512|avx2|baseline", &Settings::isa),
  };
  return entries;
}

const SettingEntry* find_entry(std::string_view name) {
  const auto same = [name](const SettingEntry& entry) { return name == entry.name; };
  const auto found = std::find_if(table().begin(), table().end(), same);
  return found == table().end() ? nullptr : &*found;
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

const std::vector<std::string>& setting_names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> list;
    for (const SettingEntry& entry : table()) list.emplace_back(entry.name);
    return list;
  }();
  return all;
}

std::string setting_help(std::string_view name) {
  const SettingEntry* entry = find_entry(name);
  return entry ? entry->help : "";
}

Status set_setting(Settings& settings, std::string_view name, std::string_view text) {
  const SettingEntry* entry = find_entry(name);
  if (entry == nullptr) {
    return Error{ErrorKind::usage, fmt::format("there is no setting '{}'; valid: {}", name, joined(setting_names()))};
  }
  if (entry->set(settings, text)) return Done{};
  return Error{ErrorKind::usage, fmt::format("{} must be {}, not '{}'", name, entry->valid, text)};
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

std::vector<SettingText> settings_as_text(const Settings& settings) {
  std::vector<SettingText> entries;
  for (const SettingEntry& entry : table()) {
    if (entry.text) entries.emplace_back(entry.name, entry.text(settings));
  }
  return entries;
}

}  // namespace luciole
