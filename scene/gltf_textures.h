// SPDX-License-Identifier: Apache-2.0
// Textures, samplers and images of a glTF document, read as materials ask for them.
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace luciole::gltf {

class TextureReader {
 public:
  explicit TextureReader(Document& document) : document_(document) {}

  // What a material's textureInfo asks for. A texture becomes a scene texture once per meaning of its colours: one
  // image may be read as sRGB here and as numbers there. Pixels come later, by decode_images().
  //   object    the material (or its part)
  //   property  for example "baseColorTexture"
  TextureSlot slot(const JsonObject& object, const char* property, bool srgb);

  // The scene's index of a texture; -1 if it has no readable source.
  std::int32_t texture(std::size_t index, bool srgb);

  void check_sampler(std::size_t sampler) const;

  // Decodes every image that was asked for and gives the textures their pixels.
  std::vector<Texture> decoded_textures();

 private:
  void read_sampler(std::size_t sampler, Texture& texture) const;

  Document& document_;
  std::vector<Texture> textures_;
  std::vector<std::pair<std::size_t, bool>> image_of_texture_;  // (image, sRGB)
  std::map<std::pair<std::size_t, bool>, std::int32_t> known_;  // (texture, sRGB) to scene texture; -1: unreadable
};

}  // namespace luciole::gltf
