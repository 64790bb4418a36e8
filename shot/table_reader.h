// SPDX-License-Identifier: Apache-2.0
// Reads one TOML table key by key. Keeps the first fault; after it, every answer is empty, so that a reader needs to
// ask for the fault only once, at the end.
#pragma once
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace luciole {

struct NumberLimits {
  float low = -1e30f, high = 1e30f;  // inclusive
  bool above_low = false;            // exclusive at the lower end
};

class TableReader {
 public:
  //   where   names file and table in sentences: "hall.toml: [camera]"
  //   fault   shared by all readers of a file
  TableReader(const toml::table& table, std::string where, std::optional<Error>& fault);

  // Each remembers the key as a valid one; empty if the key is missing or a fault was met.
  std::optional<float> number(std::string_view key, NumberLimits limits);
  std::optional<Vec3> vector(std::string_view key, NumberLimits limits);
  std::optional<std::string> text(std::string_view key);
  const toml::table* table(std::string_view key);
  std::vector<const toml::table*> tables(std::string_view key);  // [[key]]
  // A scalar, or an array of two whole numbers as "AxB".
  std::optional<std::string> as_text(std::string_view key);

  template <class T>
  T required(std::string_view key, std::optional<T> value) {
    if (!value) refuse("needs the key '" + std::string(key) + "'");
    return value.value_or(T{});
  }

  std::vector<std::string> keys() const;
  void refuse(const std::string& sentence);  // "WHERE sentence", unless a fault is kept already
  void refuse_unknown_keys();                // call last

 private:
  const toml::node* find(std::string_view key);
  std::optional<float> number_of(const toml::node& node, std::string_view key, NumberLimits limits);

  const toml::table& table_;
  std::string where_;
  std::optional<Error>& fault_;
  std::vector<std::string> valid_keys_;
};

}  // namespace luciole
