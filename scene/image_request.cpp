// SPDX-License-Identifier: Apache-2.0
#include "scene/image_request.h"

#include <utility>

#include "base/parallel.h"
#include "scene/decode_image.h"
#include "scene/file_fault.h"
#include "scene/mip_pyramid.h"

namespace luciole {
namespace {

std::shared_ptr<const MipImage> pyramid_of(DecodedImage image, bool srgb) {
  return std::make_shared<const MipImage>(build_mip_pyramid(image, srgb));
}

void answer(ImageRequest& request, TexelBudget& budget) {
  DecodedImage image = decode_image(request.file, request.label, budget);
  if (request.as_srgb && request.as_numbers) {
    request.srgb = pyramid_of(image, true);
    request.numbers = pyramid_of(std::move(image), false);
  } else if (request.as_srgb) {
    request.srgb = pyramid_of(std::move(image), true);
  } else if (request.as_numbers) {
    request.numbers = pyramid_of(std::move(image), false);
  }
}

}  // namespace

void decode_images(const std::vector<ImageRequest*>& requests, const LoadLimits& limits) {
  TexelBudget budget(limits);
  std::vector<std::string> faults(requests.size());
  parallel_for(requests.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      try {
        answer(*requests[i], budget);
      } catch (const FileFault& fault) {
        faults[i] = fault.what();
      }
    }
  });
  for (const std::string& fault : faults) {
    if (!fault.empty()) throw FileFault(fault);
  }
}

}  // namespace luciole
