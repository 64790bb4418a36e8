// SPDX-License-Identifier: Apache-2.0
#include "shot/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"

namespace luciole {

TableReader::TableReader(const toml::table& table, std::string where, std::optional<Error>& fault)
    : table_(table), where_(std::move(where)), fault_(fault) {}

void TableReader::refuse(const std::string& sentence) {
  if (!fault_) fault_ = Error{ErrorKind::bad_scene, where_ + " " + sentence};
}

const toml::node* TableReader::find(std::string_view key) {
  valid_keys_.emplace_back(key);
  return fault_ ? nullptr : table_.get(key);
}

std::optional<float> TableReader::number_of(const toml::node& node, std::string_view key, NumberLimits limits) {
  const double value = node.value<double>().value_or(std::numeric_limits<double>::quiet_NaN());
  const bool high_enough = limits.above_low ? value > limits.low : value >= limits.low;
  if (std::isfinite(value) && high_enough && value <= limits.high) return static_cast<float>(value);
  const bool open_ended = limits.high >= 1e30f;
  if (limits.low <= -1e30f) {
    refuse(fmt::format("needs finite numbers in '{}'", key));
  } else if (open_ended) {
    refuse(fmt::format("needs '{}' {} {}", key, limits.above_low ? "above" : "of at least", limits.low));
  } else {
    refuse(fmt::format("needs '{}' {} {} and at most {}", key, limits.above_low ? "above" : "of at least", limits.low,
                       limits.high));
  }
  return std::nullopt;
}

std::optional<float> TableReader::number(std::string_view key, NumberLimits limits) {
  const toml::node* node = find(key);
  return node ? number_of(*node, key, limits) : std::nullopt;
}

std::optional<Vec3> TableReader::vector(std::string_view key, NumberLimits limits) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != 3) {
    refuse(fmt::format("needs three numbers in '{}'", key));
    return std::nullopt;
  }
  const auto component = [&](std::size_t i) { return number_of(*array->get(i), key, limits).value_or(0.0f); };
  const Vec3 value(component(0), component(1), component(2));
  return fault_ ? std::nullopt : std::optional<Vec3>(value);
}

std::optional<std::string> TableReader::text(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) refuse(fmt::format("needs text in '{}'", key));
  return node->value<std::string>();
}

const toml::table* TableReader::table(std::string_view key) {
  const toml::node* node = find(key);
  if (node != nullptr && !node->is_table()) refuse(fmt::format("needs a table [{}]", key));
  return node ? node->as_table() : nullptr;
}

std::vector<const toml::table*> TableReader::tables(std::string_view key) {
  std::vector<const toml::table*> found;
  const toml::node* node = find(key);
  if (node == nullptr) return found;
  if (!node->is_array_of_tables()) {
    refuse(fmt::format("needs tables [[{}]]", key));
    return found;
  }
  for (const toml::node& entry : *node->as_array()) found.push_back(entry.as_table());
  return found;
}

std::optional<std::string> TableReader::as_text(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const toml::value<std::string>* text = node->as_string()) return text->get();
  if (const toml::value<bool>* flag = node->as_boolean()) return flag->get() ? "true" : "false";
  if (const toml::value<std::int64_t>* whole = node->as_integer()) return std::to_string(whole->get());
  // Shots are written in decimal, settings are floats: the shortest text that gives the same float.
  if (const toml::value<double>* real = node->as_floating_point()) {
    return fmt::format("{}", static_cast<float>(real->get()));
  }
  const toml::array* pair = node->as_array();
  if (pair != nullptr && pair->size() == 2 && pair->get(0)->is_integer() && pair->get(1)->is_integer()) {
    return fmt::format("{}x{}", pair->get(0)->as_integer()->get(), pair->get(1)->as_integer()->get());
  }
  refuse(fmt::format("needs a number, text, true, false or a size in '{}'", key));
  return std::nullopt;
}

std::vector<std::string> TableReader::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, node] : table_) names.emplace_back(key.str());
  return names;
}

void TableReader::refuse_unknown_keys() {
  for (const std::string& key : keys()) {
    if (std::find(valid_keys_.begin(), valid_keys_.end(), key) == valid_keys_.end()) {
      refuse(fmt::format("has no key '{}'; valid keys: {}", key, joined(valid_keys_)));
    }
  }
}

}  // namespace luciole
