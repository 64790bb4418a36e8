// SPDX-License-Identifier: Apache-2.0
// For tests of the path tracer: small pictures, rendered in one call.
#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "offline/render.h"

namespace luciole::test {

inline PathSettings small(std::uint32_t bounces, LightChoice lights = LightChoice::culling) {
  PathSettings settings;
  settings.width = 32, settings.height = 18, settings.bounces = bounces, settings.lights = lights;
  settings.pixel_filter = PixelFilter::box, settings.exposure = 0.1f;
  return settings;
}

inline Film render(const std::shared_ptr<const Scene>& scene, const Camera& camera, const PathSettings& settings,
                   std::uint32_t samples) {
  Result<PathTracer> tracer = PathTracer::create(scene, camera, settings);
  EXPECT_TRUE(tracer.has_value());
  Film film(settings.width, settings.height, settings.exposure);
  for (std::uint32_t i = 0; i < samples; ++i) EXPECT_TRUE(tracer->add_sample(film));
  return film;
}

}  // namespace luciole::test
