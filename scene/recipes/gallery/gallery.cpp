// SPDX-License-Identifier: Apache-2.0
// The showcase: a museum hall of polished metal in the evening sun.
#include "scene/recipes/gallery/exhibits.h"
#include "scene/recipes/gallery/hall.h"
#include "scene/recipes/recipe_list.h"

namespace luciole::workshop {
namespace {

void add_lights(Scene& scene) {
  // Low enough to reach the far wall, from ahead of the camera, so that reflections fall towards it.
  const Vec3 towards{std::cos(radians(24)) * std::cos(radians(20)), -std::sin(radians(24)),
                     std::cos(radians(24)) * std::sin(radians(20))};
  scene.lights.push_back(sun_light("evening sun", towards, {40, 33, 23}));
  scene.lights.push_back(spot_light("spot on the crown", {{0.4f, 5.6f, 5.2f}, {2.7f, 1.2f, 3.4f}}, {160, 150, 130}, 9, 15));
  scene.lights.push_back(spot_light("spot on the stairs", {{-2.6f, 5.6f, -3.4f}, {2.4f, 1.6f, -7.2f}}, {300, 290, 260}, 12, 20));
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
  scene.cameras.push_back(named_camera("showcase", {{1.9f, 1.6f, 8.3f}, {-0.7f, 1.25f, -1.0f}}, 50));
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
