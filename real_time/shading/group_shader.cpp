// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/group_shader.h"

#include "base/isa.h"
#include "real_time/shading/light_shadows.h"

namespace luciole {

void GroupShader::find_shadows(const PixelGroup& group, LightList<ManyEmitter>& list) {
  if (inputs_.shadows == nullptr) return;
  visible_.resize(list.count);
  LUCIOLE_FOR_ISA(inputs_.settings.isa, accepted_lanes(group, list, visible_.data()));
  for (std::uint32_t i = 0; i < list.count; ++i) {
    const float* light = list.emitters[list.index[i]].position;
    if (visible_[i] != 0) {
      visible_[i] = unoccluded_lanes(*inputs_.shadows, group, Vec3(light[0], light[1], light[2]), visible_[i]);
    }
  }
  list.visible = visible_.data();
}

void GroupShader::add_to_pixels(const PixelGroup& group, Radiance& radiance) const {
  const float weight = static_cast<float>(inputs_.settings.interleave * inputs_.settings.interleave);
  for (std::size_t c = 0; c < 3; ++c) {
    float* diffuse_plane = radiance.diffuse[c].data();
    float* specular_plane = radiance.specular[c].data();
    for (std::uint32_t lane = 0; lane < group.count; ++lane) {
      diffuse_plane[group.pixel[lane]] += sum_.diffuse[c][lane] * weight;
      specular_plane[group.pixel[lane]] += sum_.specular[c][lane] * weight;
    }
  }
}

// Counts are whole numbers below 2^24, kept as floats by the kernel.
void GroupShader::count(const PixelGroup& group, const float (&listed)[kGroupPixels], LightCounts& counts) {
  std::uint32_t accepted_pairs = 0, listed_pairs = 0;
  for (std::uint32_t lane = 0; lane < group.count; ++lane) {
    accepted_pairs += static_cast<std::uint32_t>(static_cast<std::int32_t>(sum_.accepted[lane]));
    listed_pairs += static_cast<std::uint32_t>(static_cast<std::int32_t>(listed[lane]));
  }
  counts.accepted += accepted_pairs, counts.listed += listed_pairs;
  if (!inputs_.count_per_pixel) return;
  for (std::uint32_t lane = 0; lane < group.count; ++lane) {
    outputs_.lights_listed[group.pixel[lane]] += listed[lane];
    outputs_.lights_false[group.pixel[lane]] += listed[lane] - sum_.accepted[lane];
  }
}

template <class Emitter>
void GroupShader::add(const PixelGroup& group, LightList<Emitter> list, const float (&listed)[kGroupPixels],
                      LightCounts& counts, Radiance& radiance, Radiance* part) {
  find_shadows(group, list);
  const bool divide_by_p = inputs_.settings.ranges == Ranges::stochastic;
  LUCIOLE_FOR_ISA(inputs_.settings.isa, shade_group(group, list, divide_by_p, sum_));
  counts.evaluated += std::uint64_t(list.count) * kGroupPixels;
  add_to_pixels(group, radiance);
  if (part != nullptr) add_to_pixels(group, *part);
  count(group, listed, counts);
}

template void GroupShader::add(const PixelGroup&, LightList<DiffuseEmitter>, const float (&)[kGroupPixels],
                               LightCounts&, Radiance&, Radiance*);
template void GroupShader::add(const PixelGroup&, LightList<GlossyEmitter>, const float (&)[kGroupPixels], LightCounts&,
                               Radiance&, Radiance*);
template void GroupShader::add(const PixelGroup&, LightList<ManyEmitter>, const float (&)[kGroupPixels], LightCounts&,
                               Radiance&, Radiance*);

}  // namespace luciole
