#include "scene/recipes/recipe_list.h"
#include "scene/recipes/scene_kit.h"
namespace luciole::workshop {
Recipe gallery_recipe() { return {{"gallery", "", {}}, [](const Values&) { return Scene(); }}; }
}
