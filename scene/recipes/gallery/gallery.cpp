// SPDX-License-Identifier: Apache-2.0
// The showcase: a museum hall of polished metal in the evening sun.
#include <cmath>

#include "scene/recipes/gallery/exhibits.h"
#include "scene/recipes/gallery/hall.h"
#include "scene/recipes/recipe_list.h"

namespace luciole::workshop {
namespace {

// The sun stands low enough to reach the far wall and a little ahead of the camera, so that reflections fall towards
// it.
void add_lights(Scene& scene) {
  const float elevation = radians(24), ahead = radians(8);
  const Vec3 towards{std::cos(elevation) * std::cos(ahead), -std::sin(elevation),
                     std::cos(elevation) * std::sin(ahead)};
  scene.lights.push_back(sun_light("evening sun", towards, {46, 40, 31}));
  scene.lights.push_back(
      spot_light("spot on the table", {{-0.4f, 5.9f, 5.4f}, {1.95f, 0.9f, 3.1f}}, {150, 142, 125}, 9, 15));
  // From where its mirror image in the letters is seen by the camera.
  scene.lights.push_back(
      spot_light("spot on the letters", {{-1.5f, 5.2f, -3.6f}, {-0.6f, 3.9f, -9.5f}}, {270, 252, 212}, 22, 40));
  scene.environment.radiance = {3.0f, 3.6f, 4.6f};
}

Scene make_gallery(const Values& values) {
  const Detail detail{static_cast<float>(values.at("detail"))};
  Scene scene;
  const gallery::HallMaterials materials = gallery::add_hall_materials(scene, detail.value < 0.25 ? 256 : 1024);
  gallery::add_shell(scene, materials, detail);
  gallery::add_vault(scene, materials, detail);
  gallery::add_columns(scene, materials, detail);
  gallery::add_joinery(scene, materials, detail);
  gallery::add_exhibits(scene, materials, detail);
  add_lights(scene);
  scene.cameras.push_back(named_camera("showcase", {{1.75f, 1.65f, 7.7f}, {-0.75f, 1.12f, -1.0f}}, 50));
  return scene;
}

}  // namespace

Recipe gallery_recipe() {
  return {{"gallery",
           "the showcase: a vaulted hall of polished metal objects in the evening sun (1.4 M triangles)",
           {{"detail", "share of the full number of triangles", 1, 0.001, 1}}},
          make_gallery};
}

}  // namespace luciole::workshop
