// SPDX-License-Identifier: Apache-2.0
// An image and its halvings.
#pragma once
#include "scene/decode_image.h"
#include "scene/scene.h"

namespace luciole {

// Each level is the box-filtered level before it, averaged in linear light; an odd side weighs its texels by the part
// that falls into the smaller texel. Colours of an sRGB image with alpha are weighted by alpha, so that the invisible
// colour of cut-out texels does not bleed into leaves.
//   srgb  the colour channels are sRGB-encoded
MipImage build_mip_pyramid(const DecodedImage& image, bool srgb);

}  // namespace luciole
