// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_textures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "scene/file_fault.h"
#include "scene/image_request.h"

namespace luciole::gltf {
namespace {

// GL constants of samplers.
constexpr std::uint64_t kNearest = 9728, kLinear = 9729, kNearestMipNearest = 9984, kLinearMipNearest = 9985,
                        kNearestMipLinear = 9986, kLinearMipLinear = 9987;
constexpr std::uint64_t kRepeat = 10497, kClampToEdge = 33071, kMirroredRepeat = 33648;

Wrap wrap_mode(const JsonObject& sampler, const char* property) {
  switch (sampler.whole(property, kRepeat)) {
    case kRepeat:
      return Wrap::repeat;
    case kClampToEdge:
      return Wrap::clamp_to_edge;
    case kMirroredRepeat:
      return Wrap::mirrored_repeat;
    default:
      fail("VALUE_NOT_IN_LIST", sampler.label(), std::string("property \"") + property + "\" is no wrap mode");
  }
}

// KHR_texture_transform: uv' = offset + rotation * scale * uv. Rotations turn counter-clockwise on screen, where v
// points down.
void apply_transform(const JsonObject& transform, TextureSlot& slot) {
  const auto offset = transform.numbers<2>("offset", {0, 0});
  const auto scale = transform.numbers<2>("scale", {1, 1});
  const float rotation = transform.number("rotation", 0);
  const float cosine = std::cos(rotation), sine = std::sin(rotation);
  slot.a = cosine * scale[0];
  slot.b = sine * scale[1];
  slot.c = -sine * scale[0];
  slot.d = cosine * scale[1];
  slot.offset = {offset[0], offset[1]};
}

// A texture may leave its source to an extension, if the file says that it uses that.
void check_extensions_declared(const Document& document, const JsonObject& texture) {
  const std::optional<JsonObject> extensions = texture.object("extensions");
  if (!extensions) return;
  const Json* used = document.root().array("extensionsUsed");
  for (const auto& [name, value] : extensions->json().items()) {
    if (used == nullptr || std::find(used->begin(), used->end(), name) == used->end()) {
      fail("UNDECLARED_EXTENSION", texture.label(), "its extension " + printable(name) + " is not in extensionsUsed");
    }
  }
}

}  // namespace

void TextureReader::read_sampler(std::size_t index, Texture& texture) const {
  const JsonObject sampler = document_.element(kSamplers, index);
  texture.wrap_u = wrap_mode(sampler, "wrapS");
  texture.wrap_v = wrap_mode(sampler, "wrapT");
  const std::uint64_t magnify = sampler.whole("magFilter", kLinear);
  if (magnify != kNearest && magnify != kLinear) {
    fail("VALUE_NOT_IN_LIST", sampler.label(), "property \"magFilter\" is no magnification filter");
  }
  texture.magnify_linear = magnify == kLinear;
  const std::uint64_t minify = sampler.whole("minFilter", kLinearMipLinear);
  switch (minify) {
    case kNearest:
    case kLinear:
      texture.mip_filter = MipFilter::none;
      break;
    case kNearestMipNearest:
    case kLinearMipNearest:
      texture.mip_filter = MipFilter::nearest;
      break;
    case kNearestMipLinear:
    case kLinearMipLinear:
      texture.mip_filter = MipFilter::linear;
      break;
    default:
      fail("VALUE_NOT_IN_LIST", sampler.label(), "property \"minFilter\" is no minification filter");
  }
  texture.minify_linear = minify == kLinear || minify == kLinearMipNearest || minify == kLinearMipLinear;
}

void TextureReader::check_sampler(std::size_t sampler) const {
  Texture unused;
  read_sampler(sampler, unused);
}

std::int32_t TextureReader::texture(std::size_t index, bool srgb) {
  const auto [entry, is_new] = known_.try_emplace({index, srgb}, -1);
  if (!is_new) return entry->second;
  const JsonObject object = document_.element(kTextures, index);
  const std::optional<std::size_t> image = object.reference("source", document_.count(kImages));
  const std::optional<std::size_t> sampler = object.reference("sampler", document_.count(kSamplers));
  if (!image) {
    check_extensions_declared(document_, object);
    document_.warn(object.label(), "The " + object.label() + " is ignored: it has no PNG or JPEG source.");
    return -1;
  }
  Texture result;
  result.name = document_.element(kImages, *image).text("name", object.text("name"));
  if (sampler) read_sampler(*sampler, result);
  entry->second = static_cast<std::int32_t>(textures_.size());
  textures_.push_back(std::move(result));
  image_of_texture_.emplace_back(*image, srgb);
  return entry->second;
}

TextureSlot TextureReader::slot(const JsonObject& object, const char* property, bool srgb) {
  TextureSlot slot;
  const std::optional<JsonObject> use = object.object(property);
  if (!use) return slot;
  slot.texture = texture(use->required_reference("index", document_.count(kTextures)), srgb);
  std::uint64_t uv_set = use->whole("texCoord", 0);
  if (const std::optional<JsonObject> transform = use->extension("KHR_texture_transform")) {
    apply_transform(*transform, slot);
    uv_set = transform->whole("texCoord", uv_set);
  }
  if (uv_set > 1) {
    document_.warn("uv set",
                   "Texture coordinate sets beyond the second are ignored: " + use->label() + " asks for one.");
    slot.texture = -1;
    uv_set = 0;
  }
  slot.uv_set = static_cast<std::uint32_t>(uv_set);
  return slot;
}

std::vector<Texture> TextureReader::decoded_textures() {
  std::map<std::size_t, ImageRequest> by_image;
  for (const auto& [image, srgb] : image_of_texture_) {
    ImageRequest& request = by_image[image];
    (srgb ? request.as_srgb : request.as_numbers) = true;
  }
  std::vector<ImageRequest*> requests;
  for (auto& [image, request] : by_image) {
    request.label = document_.element(kImages, image).label();
    request.file = document_.image_bytes(image, request.storage);
    requests.push_back(&request);
  }
  decode_images(requests, document_.limits());
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    const ImageRequest& request = by_image[image_of_texture_[i].first];
    textures_[i].image = image_of_texture_[i].second ? request.srgb : request.numbers;
  }
  return std::move(textures_);
}

}  // namespace luciole::gltf
