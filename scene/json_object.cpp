// SPDX-License-Identifier: Apache-2.0
#include "scene/json_object.h"

#include <cmath>
#include <utility>

#include "scene/file_fault.h"

namespace luciole {
namespace {

constexpr int kDeepestJson = 64;

// Depth of brackets outside strings. Counted ahead of the parser, so that no parser and no destructor meets more.
int bracket_depth(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

Json parse_json(std::string_view text) {
  if (bracket_depth(text) > kDeepestJson) {
    fail("INVALID_JSON", "", "the JSON nests deeper than " + std::to_string(kDeepestJson) + " levels");
  }
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    fail("INVALID_JSON", "", "not valid JSON at byte " + std::to_string(error.byte));
  } catch (const Json::exception&) {
    fail("INVALID_JSON", "", "not valid JSON: a number is out of range");
  }
}

JsonObject::JsonObject(const Json& value, std::string label) : value_(&value), label_(std::move(label)) {
  if (!value.is_object()) fail("TYPE_MISMATCH", label_, "is not a JSON object");
}

const Json* JsonObject::find(const char* property) const {
  const auto found = value_->find(property);
  return found == value_->end() ? nullptr : &*found;
}

void JsonObject::mismatch(const char* property, const char* expected) const {
  fail("TYPE_MISMATCH", label_, std::string("property \"") + property + "\" is not " + expected);
}

std::optional<JsonObject> JsonObject::object(const char* property) const {
  const Json* value = find(property);
  if (value == nullptr) return std::nullopt;
  return JsonObject(*value, label_of(property));
}

std::optional<JsonObject> JsonObject::extension(const char* name) const {
  const std::optional<JsonObject> extensions = object("extensions");
  return extensions ? extensions->object(name) : std::nullopt;
}

std::string JsonObject::text(const char* property, const std::string& fallback) const {
  const Json* value = find(property);
  if (value == nullptr) return fallback;
  if (!value->is_string()) mismatch(property, "a string");
  return value->get<std::string>();
}

bool JsonObject::boolean(const char* property, bool fallback) const {
  const Json* value = find(property);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) mismatch(property, "true or false");
  return value->get<bool>();
}

float JsonObject::number(const char* property, float fallback) const {
  const Json* value = find(property);
  if (value == nullptr) return fallback;
  if (!value->is_number()) mismatch(property, "a number");
  const auto result = value->get<double>();
  if (!std::isfinite(static_cast<float>(result))) mismatch(property, "a finite number");
  return static_cast<float>(result);
}

std::uint64_t JsonObject::whole_number(const Json& value, const char* property) const {
  if (!value.is_number()) mismatch(property, "a whole number");
  constexpr double kLargest = 9007199254740992.0;  // 2^53: beyond it JSON numbers skip integers
  const auto number = value.get<double>();
  if (!(number >= 0) || number > kLargest || number != std::floor(number)) mismatch(property, "a whole number");
  return static_cast<std::uint64_t>(number);
}

std::size_t JsonObject::index_below(const Json& value, const char* property, std::size_t count) const {
  const std::uint64_t index = whole_number(value, property);
  if (index >= count) {
    fail("UNRESOLVED_REFERENCE", label_,
         std::string("property \"") + property + "\" refers to number " + std::to_string(index) + " of " +
             std::to_string(count));
  }
  return static_cast<std::size_t>(index);
}

std::uint64_t JsonObject::whole(const char* property, std::uint64_t fallback) const {
  const Json* value = find(property);
  return value == nullptr ? fallback : whole_number(*value, property);
}

std::uint64_t JsonObject::required_whole(const char* property) const {
  if (!has(property)) fail("UNDEFINED_PROPERTY", label_, std::string("property \"") + property + "\" is missing");
  return whole(property, 0);
}

std::optional<std::size_t> JsonObject::reference(const char* property, std::size_t count) const {
  const Json* value = find(property);
  if (value == nullptr) return std::nullopt;
  return index_below(*value, property, count);
}

std::size_t JsonObject::required_reference(const char* property, std::size_t count) const {
  const std::optional<std::size_t> index = reference(property, count);
  if (!index) fail("UNDEFINED_PROPERTY", label_, std::string("property \"") + property + "\" is missing");
  return *index;
}

const Json* JsonObject::array(const char* property) const {
  const Json* values = find(property);
  if (values != nullptr && !values->is_array()) mismatch(property, "an array");
  return values;
}

std::vector<std::size_t> JsonObject::references(const char* property, std::size_t count) const {
  std::vector<std::size_t> result;
  const Json* values = array(property);
  if (values == nullptr) return result;
  result.reserve(values->size());
  for (const Json& value : *values) result.push_back(index_below(value, property, count));
  return result;
}

void JsonObject::read_numbers(const Json& values, const char* property, float* result, std::size_t count) const {
  if (!values.is_array()) mismatch(property, "an array of numbers");
  if (values.size() != count) {
    fail("ARRAY_LENGTH_NOT_IN_LIST", label_,
         std::string("property \"") + property + "\" has " + std::to_string(values.size()) + " numbers instead of " +
             std::to_string(count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!values[i].is_number()) mismatch(property, "an array of numbers");
    result[i] = static_cast<float>(values[i].get<double>());
    if (!std::isfinite(result[i])) mismatch(property, "an array of finite numbers");
  }
}

std::vector<JsonObject> JsonObject::objects(const char* property, const char* singular) const {
  std::vector<JsonObject> result;
  const Json* values = array(property);
  if (values == nullptr) return result;
  result.reserve(values->size());
  for (std::size_t i = 0; i < values->size(); ++i) {
    result.emplace_back((*values)[i], label_of(singular + (" " + std::to_string(i))));
  }
  return result;
}

}  // namespace luciole
