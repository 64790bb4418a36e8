// SPDX-License-Identifier: Apache-2.0
// Checked reading of JSON: every access says what it expects, and a fault names the object and the property.
#pragma once
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luciole {

using Json = nlohmann::json;

// Parses text whose brackets nest at most 64 deep (a deeper one is refused before it is parsed). INVALID_JSON.
Json parse_json(std::string_view text);

// A JSON object with the name under which faults report it, for example `material 12 "chain"`. Refers to the document.
// A property that is absent gives the fallback (or nothing); one of the wrong type fails with TYPE_MISMATCH.
class JsonObject {
 public:
  JsonObject(const Json& value, std::string label);

  const std::string& label() const { return label_; }
  std::string label_of(const std::string& property) const { return label_ + ", " + property; }
  const Json& json() const { return *value_; }
  bool has(const char* property) const { return find(property) != nullptr; }

  std::optional<JsonObject> object(const char* property) const;
  std::optional<JsonObject> extension(const char* name) const;
  std::string text(const char* property, const std::string& fallback = "") const;
  bool boolean(const char* property, bool fallback) const;
  float number(const char* property, float fallback) const;  // finite
  // A whole number from 0 to 2^53.
  std::uint64_t whole(const char* property, std::uint64_t fallback) const;
  std::uint64_t required_whole(const char* property) const;  // UNDEFINED_PROPERTY
  // An index below `count`; UNRESOLVED_REFERENCE.
  std::optional<std::size_t> reference(const char* property, std::size_t count) const;
  std::size_t required_reference(const char* property, std::size_t count) const;
  std::vector<std::size_t> references(const char* property, std::size_t count) const;
  // Exactly N finite numbers; ARRAY_LENGTH_NOT_IN_LIST.
  template <std::size_t N>
  std::array<float, N> numbers(const char* property, const std::array<float, N>& fallback) const {
    const Json* values = find(property);
    if (values == nullptr) return fallback;
    std::array<float, N> result;
    read_numbers(*values, property, result.data(), N);
    return result;
  }
  // The objects of an array, labelled "<this label>, <singular> <index>".
  std::vector<JsonObject> objects(const char* property, const char* singular) const;
  const Json* array(const char* property) const;  // null if absent

 private:
  const Json* find(const char* property) const;
  [[noreturn]] void mismatch(const char* property, const char* expected) const;
  std::uint64_t whole_number(const Json& value, const char* property) const;
  std::size_t index_below(const Json& value, const char* property, std::size_t count) const;
  void read_numbers(const Json& values, const char* property, float* result, std::size_t count) const;

  const Json* value_;
  std::string label_;
};

}  // namespace luciole
