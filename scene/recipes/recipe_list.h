// SPDX-License-Identifier: Apache-2.0
// The recipes themselves, one function each. Values are checked: every parameter of the description is there.
#pragma once
#include <map>
#include <string>

#include "scene/recipes/recipes.h"

namespace luciole::workshop {

using Values = std::map<std::string, double>;

struct Recipe {
  RecipeDescription description;
  Scene (*make)(const Values& values);
};

Recipe gallery_recipe();
Recipe ring_recipe();
Recipe cornell_recipe();
Recipe lights_recipe();
Recipe lamps_recipe();

}  // namespace luciole::workshop
