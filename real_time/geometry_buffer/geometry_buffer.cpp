// SPDX-License-Identifier: Apache-2.0
#include "real_time/geometry_buffer/geometry_buffer.h"

namespace luciole {

void GeometryBuffer::resize(std::uint32_t new_width, std::uint32_t new_height) {
  width = new_width, height = new_height;
  const std::size_t pixels = pixel_count();
  for (Plane3* planes : {&position, &normal, &geometric_normal, &diffuse_albedo, &f0, &emission}) {
    for (Plane& plane : *planes) plane.resize(pixels);
  }
  for (Plane* plane : {&depth, &f90, &ggx_alpha}) plane->resize(pixels);
  material.resize(pixels);
}

}  // namespace luciole
