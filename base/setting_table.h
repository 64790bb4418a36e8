// SPDX-License-Identifier: Apache-2.0
// Settings as text: a renderer's settings are a plain struct and one table that names its members. The table serves the
// command line, the [settings] of shots, the statistics and the metadata of pictures, so that a name means the same
// everywhere.
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/name_table.h"
#include "base/result.h"
#include "base/text.h"

namespace luciole {

// A setting and its value as a user writes them, for example {"tile_test", "paper"}.
using SettingText = std::pair<std::string, std::string>;

inline constexpr std::uint32_t kLargestSide = 16384;  // [pixels], as image/ reads and writes

template <class Settings>
struct SettingEntry {
  const char* name;
  const char* help;
  std::string valid;                                     // completes "... must be "
  std::function<bool(Settings&, std::string_view)> set;  // false: not valid
  std::function<std::string(const Settings&)> text;      // empty function: not part of the settings' text
};

template <class T>
bool parse_number(std::string_view text, T& number) {
  T parsed{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (fault != std::errc() || end != text.data() + text.size()) return false;
  number = parsed;
  return true;
}

// Finite; above 0, or also 0 itself.
inline bool parse_positive(std::string_view text, float& number, bool or_zero = false) {
  float parsed = 0;
  if (!parse_number(text, parsed) || !std::isfinite(parsed) || !(or_zero ? parsed >= 0 : parsed > 0)) return false;
  number = parsed;
  return true;
}

// The shortest text that reads back as the same number.
inline std::string number_text(float number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof(digits), number).ptr};
}

template <class Settings>
SettingEntry<Settings> switch_entry(const char* name, const char* help, bool Settings::*member) {
  return {name, help, "true or false",
          [member](Settings& settings, std::string_view text) {
            if (text != "true" && text != "false") return false;
            settings.*member = text == "true";
            return true;
          },
          [member](const Settings& settings) { return std::string(settings.*member ? "true" : "false"); }};
}

template <class Settings, class T>
SettingEntry<Settings> choice_entry(const char* name, const char* help, T Settings::*member) {
  return {name, help, "one of " + all_names<T>(),
          [member](Settings& settings, std::string_view text) {
            const std::optional<T> value = value_named<T>(text);
            if (value) settings.*member = *value;
            return value.has_value();
          },
          [member](const Settings& settings) { return name_of(settings.*member); }};
}

template <class Settings, class T>
SettingEntry<Settings> whole_entry(const char* name, const char* help, const char* valid, T Settings::*member,
                                   std::function<bool(T)> allowed) {
  return {name, help, valid,
          [member, allowed](Settings& settings, std::string_view text) {
            T value = 0;
            if (!parse_number(text, value) || !allowed(value)) return false;
            settings.*member = value;
            return true;
          },
          [member](const Settings& settings) { return std::to_string(settings.*member); }};
}

template <class Settings>
SettingEntry<Settings> positive_entry(const char* name, const char* help, float Settings::*member,
                                      bool or_zero = false) {
  return {name, help, or_zero ? "a number from 0" : "a number above 0",
          [member, or_zero](Settings& settings, std::string_view text) {
            return parse_positive(text, settings.*member, or_zero);
          },
          [member](const Settings& settings) { return number_text(settings.*member); }};
}

// Settings::width and ::height, "1280x720".
template <class Settings>
SettingEntry<Settings> size_entry() {
  const auto set = [](Settings& settings, std::string_view text) {
    const std::size_t cross = text.find('x');
    std::uint32_t width = 0, height = 0;
    if (cross == std::string_view::npos || !parse_number(text.substr(0, cross), width) ||
        !parse_number(text.substr(cross + 1), height)) {
      return false;
    }
    if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) return false;
    settings.width = width, settings.height = height;
    return true;
  };
  return {
      "size", "picture size, WIDTHxHEIGHT [pixels]", "WIDTHxHEIGHT with sides from 1 to 16384", set,
      [](const Settings& settings) { return std::to_string(settings.width) + "x" + std::to_string(settings.height); }};
}

template <class Settings>
class SettingTable {
 public:
  explicit SettingTable(std::vector<SettingEntry<Settings>> entries) : entries_(std::move(entries)) {
    for (const SettingEntry<Settings>& entry : entries_) names_.emplace_back(entry.name);
  }

  const std::vector<std::string>& names() const { return names_; }

  bool has(std::string_view name) const { return find(name) != nullptr; }

  // One line about a setting, with its values, for --help. Empty for an unknown name.
  std::string help(std::string_view name) const {
    const SettingEntry<Settings>* entry = find(name);
    return entry ? entry->help : "";
  }

  // Changes one setting. The sentence of a failure names the setting as it was passed and says what would be valid.
  Status set(Settings& settings, std::string_view name, std::string_view text) const {
    const SettingEntry<Settings>* entry = find(name);
    if (entry == nullptr) {
      return Error{ErrorKind::usage, "there is no setting '" + std::string(name) + "'; valid: " + joined(names_)};
    }
    if (entry->set(settings, text)) return Done{};
    return Error{ErrorKind::usage,
                 std::string(name) + " must be " + entry->valid + ", not '" + std::string(text) + "'"};
  }

  // All settings that have a text, in the order of the table.
  std::vector<SettingText> as_text(const Settings& settings) const {
    std::vector<SettingText> texts;
    for (const SettingEntry<Settings>& entry : entries_) {
      if (entry.text) texts.emplace_back(entry.name, entry.text(settings));
    }
    return texts;
  }

 private:
  const SettingEntry<Settings>* find(std::string_view name) const {
    const auto same = [name](const SettingEntry<Settings>& entry) { return name == entry.name; };
    const auto found = std::find_if(entries_.begin(), entries_.end(), same);
    return found == entries_.end() ? nullptr : &*found;
  }

  std::vector<SettingEntry<Settings>> entries_;
  std::vector<std::string> names_;
};

}  // namespace luciole
