// SPDX-License-Identifier: Apache-2.0
// MTL files: Phong materials to metallic-roughness.
#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/file_access.h"
#include "scene/image_request.h"
#include "scene/scene.h"

namespace luciole::obj {

// Materials, textures and warnings while an OBJ file is read. The mapping:
//   Kd, or white where map_Kd is given     base colour
//   Ns                                     roughness = (2 / (Ns + 2))^(1/4) if Ks is not black, else 1
//   illum 3 or 5 with a Ks of 0.5 or more  a metal of colour Ks, as smooth as it gets: a mirror
//   d, Tr                                  opacity; below 1 the material blends
//   Ke, map_Ke                             emission [W/(m^2 sr)]
//   norm                                   normal map
// Height maps (bump) and opacity maps (map_d) are ignored, refraction is not expressed. Both sides are drawn alike: OBJ
// has no sides, but light leaves on the front side.
class MaterialLibrary {
 public:
  MaterialLibrary(const FileReader& files, const LoadLimits& limits) : files_(files), limits_(limits) {}

  void read_file(const std::string& name);  // one warning if it is missing
  // The scene's index of a material; the default one, with one warning, if no file defines it.
  std::uint32_t find(const std::string& name);
  std::uint32_t default_material();

  void warn(const std::string& key, const std::string& sentence);
  // Decodes the images and moves everything into the scene.
  void finish(Scene& scene);

 private:
  struct Phong;
  void define(const Phong& phong);
  TextureSlot texture(std::string_view statement, bool srgb);
  std::int32_t request_image(const std::string& path, bool srgb, bool clamped);

  const FileReader& files_;
  LoadLimits limits_;
  std::vector<Material> materials_;
  std::map<std::string, std::uint32_t> by_name_;
  std::vector<Texture> textures_;
  std::vector<std::pair<std::string, bool>> image_of_texture_;  // (path, sRGB)
  std::map<std::string, ImageRequest> images_;
  std::set<std::string> files_read_, warned_;
  std::vector<std::string> warnings_;
};

}  // namespace luciole::obj
