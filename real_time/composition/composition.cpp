// SPDX-License-Identifier: Apache-2.0
#include "real_time/composition/composition.h"

#include <functional>
#include <map>

#include "base/parallel.h"

namespace luciole {
namespace {

using Colours = std::vector<Vec3>;

Vec3 at(const Plane3& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }

// Radiance towards the eye: the demodulated light on the pixel's own albedo.
Colours modulate(const GeometryBuffer& geometry, const Radiance& radiance) {
  Colours out(geometry.pixel_count(), Vec3(0, 0, 0));
  if (radiance.diffuse[0].empty()) return out;
  parallel_for(out.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (geometry.depth[i] != kNoSurface)
        out[i] = at(radiance.diffuse, i) * at(geometry.diffuse_albedo, i) + at(radiance.specular, i);
    }
  });
  return out;
}

Colours colours_of(const Plane3& planes) {
  Colours out(planes[0].size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = at(planes, i);
  return out;
}

Colours add(Colours a, const Colours& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

std::vector<float> values_of(const Plane& plane) { return {plane.begin(), plane.end()}; }

// Albedo as denoisers expect it: what the surface reflects in all, 1 for the sky.
Colours albedo_layer(const GeometryBuffer& geometry) {
  Colours out(geometry.pixel_count(), Vec3(1, 1, 1));
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (geometry.depth[i] != kNoSurface)
      out[i] = min(at(geometry.diffuse_albedo, i) + at(geometry.f0, i), Vec3(1, 1, 1));
  }
  return out;
}

Colours normal_layer(const GeometryBuffer& geometry) {
  Colours out(geometry.pixel_count(), Vec3(0, 0, 0));
  for (std::size_t i = 0; i < out.size(); ++i)
    if (geometry.depth[i] != kNoSurface) out[i] = at(geometry.normal, i);
  return out;
}

// Frames that the light of each pixel is the mean of, 0 for the sky.
std::vector<float> history_layer(const CompositionInputs& in) {
  if (!in.history.empty()) return values_of(in.history);
  std::vector<float> out(in.geometry.pixel_count());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = in.geometry.depth[i] == kNoSurface ? 0.0f : 1.0f;
  return out;
}

using LayerWriter = std::function<void(const CompositionInputs&, const std::string& name, Image&)>;

// Every layer by name; a new one is one entry here.
const std::vector<std::pair<std::string, LayerWriter>>& layer_table() {
  static const std::vector<std::pair<std::string, LayerWriter>> table = {
      {"direct",
       [](const CompositionInputs& in, const std::string& name, Image& image) {
         image.set_colours(name, add(colours_of(in.direct), modulate(in.geometry, in.many)));
       }},
      {"indirect", [](const CompositionInputs& in, const std::string& name,
                      Image& image) { image.set_colours(name, modulate(in.geometry, in.indirect)); }},
      {"indirect_from_diffuse",
       [](const CompositionInputs& in, const std::string& name, Image& image) {
         image.set_colours(name, modulate(in.geometry, in.shaded.from_diffuse));
       }},
      {"indirect_from_glossy",
       [](const CompositionInputs& in, const std::string& name, Image& image) {
         image.set_colours(name, modulate(in.geometry, in.shaded.from_glossy));
       }},
      {"unfiltered",
       [](const CompositionInputs& in, const std::string& name, Image& image) {
         image.set_colours(name,
                           add(modulate(in.geometry, in.shaded.indirect), modulate(in.geometry, in.shaded.from_many)));
       }},
      {"albedo", [](const CompositionInputs& in, const std::string& name,
                    Image& image) { image.set_colours(name, albedo_layer(in.geometry)); }},
      {"normal", [](const CompositionInputs& in, const std::string& name,
                    Image& image) { image.set_colours(name, normal_layer(in.geometry)); }},
      {"depth", [](const CompositionInputs& in, const std::string& name,
                   Image& image) { image.set_values(name, values_of(in.geometry.depth)); }},
      {"history", [](const CompositionInputs& in, const std::string& name,
                     Image& image) { image.set_values(name, history_layer(in)); }},
      {"lights_listed", [](const CompositionInputs& in, const std::string& name,
                           Image& image) { image.set_values(name, values_of(in.counts.lights_listed)); }},
      {"lights_false", [](const CompositionInputs& in, const std::string& name,
                          Image& image) { image.set_values(name, values_of(in.counts.lights_false)); }},
      {"reference", [](const CompositionInputs& in, const std::string& name,
                       Image& image) { image.set_colours(name, colours_of(in.prediction.reference)); }},
      {"predicted_variance", [](const CompositionInputs& in, const std::string& name,
                                Image& image) { image.set_colours(name, colours_of(in.prediction.variance)); }},
      {"predicted_accepted", [](const CompositionInputs& in, const std::string& name,
                                Image& image) { image.set_values(name, values_of(in.prediction.accepted)); }},
  };
  return table;
}

}  // namespace

const std::vector<std::string>& composition_layers() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& [name, writer] : layer_table()) out.push_back(name);
    return out;
  }();
  return names;
}

void compose(const CompositionInputs& inputs, const std::vector<std::string>& layers, Frame& frame) {
  frame.picture = modulate(inputs.geometry, inputs.indirect);
  const bool has_many = !inputs.many.diffuse[0].empty();
  const Colours many = has_many ? modulate(inputs.geometry, inputs.many) : Colours();
  parallel_for(frame.picture.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      frame.picture[i] += at(inputs.direct, i) + at(inputs.geometry.emission, i);
      if (has_many) frame.picture[i] += many[i];
    }
  });
  frame.layers.width = frame.width, frame.layers.height = frame.height;
  for (const auto& [name, write] : layer_table()) {
    for (const std::string& wanted : layers)
      if (wanted == name) write(inputs, name, frame.layers);
  }
}

}  // namespace luciole
