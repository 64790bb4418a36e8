// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/recipes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "scene/recipes/recipe_list.h"

namespace luciole {
namespace {

using workshop::Recipe;

const std::vector<Recipe>& all() {
  static const std::vector<Recipe> list = {workshop::gallery_recipe(), workshop::ring_recipe(),
                                           workshop::cornell_recipe(), workshop::lights_recipe(),
                                           workshop::lamps_recipe()};
  return list;
}

Error usage(std::string sentence) { return {ErrorKind::usage, std::move(sentence)}; }

template <class Items>
std::string names_of(const Items& items, const std::string& (*name)(const typename Items::value_type&)) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + name(item);
  return text;
}

std::string number_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

Result<double> read_value(const RecipeDescription& recipe, const RecipeParameter& parameter, const std::string& text) {
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = problem == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  if (is_number && value >= parameter.low && value <= parameter.high &&
      (!parameter.whole || value == std::floor(value))) {
    return value;
  }
  return usage("recipe " + recipe.name + ": " + parameter.name + "=" + text + " is not a " +
               (parameter.whole ? "whole number" : "number") + " from " + number_text(parameter.low) + " to " +
               number_text(parameter.high) + " (" + parameter.meaning + ")");
}

const RecipeParameter* find_parameter(const RecipeDescription& recipe, const std::string& name) {
  for (const RecipeParameter& parameter : recipe.parameters) {
    if (parameter.name == name) return &parameter;
  }
  return nullptr;
}

Result<workshop::Values> read_values(const RecipeDescription& recipe, const std::map<std::string, std::string>& given) {
  workshop::Values values;
  for (const RecipeParameter& parameter : recipe.parameters) values[parameter.name] = parameter.default_value;
  for (const auto& [name, text] : given) {
    const RecipeParameter* parameter = find_parameter(recipe, name);
    if (!parameter) {
      const auto valid = names_of(
          recipe.parameters, +[](const RecipeParameter& p) -> const std::string& { return p.name; });
      return usage("recipe " + recipe.name + " has no parameter \"" + name + "\"; it has: " + valid);
    }
    Result<double> value = read_value(recipe, *parameter, text);
    if (!value) return value.error();
    values[name] = *value;
  }
  return values;
}

constexpr std::string_view kScheme = "recipe:";

}  // namespace

std::vector<RecipeDescription> recipes() {
  std::vector<RecipeDescription> list;
  for (const Recipe& recipe : all()) list.push_back(recipe.description);
  return list;
}

Result<Scene> make_recipe(const std::string& name, const std::map<std::string, std::string>& parameters) {
  for (const Recipe& recipe : all()) {
    if (recipe.description.name != name) continue;
    const Result<workshop::Values> values = read_values(recipe.description, parameters);
    if (!values) return values.error();
    Scene scene = recipe.make(*values);
    scene.name = name;
    return scene;
  }
  const auto valid = names_of(
      all(), +[](const Recipe& r) -> const std::string& { return r.description.name; });
  return usage("there is no recipe \"" + name + "\"; the recipes are: " + valid);
}

bool is_recipe_address(const std::string& address) { return address.starts_with(kScheme); }

Result<Scene> make_recipe_from_address(const std::string& address) {
  if (!is_recipe_address(address)) return usage("\"" + address + "\" does not start with " + std::string(kScheme));
  const std::string text = address.substr(kScheme.size());
  const std::size_t question = std::min(text.find('?'), text.size());
  std::map<std::string, std::string> parameters;
  for (std::size_t begin = question + 1; begin < text.size();) {
    const std::size_t end = std::min(text.find('&', begin), text.size());
    const std::string pair = text.substr(begin, end - begin);
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      return usage("\"" + address + "\": \"" + pair + "\" is not of the form key=value");
    }
    if (!parameters.emplace(pair.substr(0, equals), pair.substr(equals + 1)).second) {
      return usage("\"" + address + "\": " + pair.substr(0, equals) + " is given twice");
    }
    begin = end + 1;
  }
  return make_recipe(text.substr(0, question), parameters);
}

}  // namespace luciole
