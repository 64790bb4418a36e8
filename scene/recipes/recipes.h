// SPDX-License-Identifier: Apache-2.0
// Scenes made by code: no files, the same on every machine. `luciole make NAME key=value ... -o FILE` and shots with
// scene = "recipe:NAME?key=value&key=value" come here.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace luciole {

struct RecipeParameter {
  std::string name, meaning;
  double default_value = 0, low = 0, high = 1;  // both ends are allowed
  bool whole = false;                           // whole numbers only
};

struct RecipeDescription {
  std::string name, summary;
  std::vector<RecipeParameter> parameters;
};

std::vector<RecipeDescription> recipes();

// Unknown recipes and parameters, and values out of range, are refused in one sentence that lists what is valid.
Result<Scene> make_recipe(const std::string& name, const std::map<std::string, std::string>& parameters);

// "recipe:ring?alpha=0.1&detail=0.5", as shots write it.
bool is_recipe_address(const std::string& address);
Result<Scene> make_recipe_from_address(const std::string& address);

}  // namespace luciole
