// SPDX-License-Identifier: Apache-2.0
#include "real_time/vulkan_transfer.h"

#include <algorithm>

#include "base/parallel.h"

namespace luciole {
namespace {

constexpr std::size_t kAtOnce = 16384;  // of a thread

void put(const Plane3& from, std::size_t i, float (&to)[3]) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = from[axis][i];
}

void get(const float (&from)[3], std::size_t i, Plane3& to) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis][i] = from[axis];
}

void add(const float (&sums)[3], float weight, std::size_t pixel, Plane3& to) {
  for (std::size_t c = 0; c < 3; ++c) to[c][pixel] += sums[c] * weight;
}

LightCounts& counts_of(LightKind kind, ShadingOutputs& out) {
  return kind == kDiffuseLights ? out.diffuse : kind == kGlossyLights ? out.glossy : out.many;
}

// The radiance that a kind is added to, and the layer that has it alone; null: nobody asked, the planes are empty.
std::array<Radiance*, 2> radiance_of(LightKind kind, ShadedRadiance& radiance) {
  const auto if_wanted = [](Radiance& light) { return light.diffuse[0].empty() ? nullptr : &light; };
  if (kind == kManyLights) return {if_wanted(radiance.from_many), nullptr};
  return {if_wanted(radiance.indirect),
          if_wanted(kind == kDiffuseLights ? radiance.from_diffuse : radiance.from_glossy)};
}

}  // namespace

void pack(const GeometryBuffer& geometry, PixelRecord* to) {
  parallel_for(geometry.pixel_count(), kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      PixelRecord& r = to[i];
      put(geometry.position, i, r.position), put(geometry.normal, i, r.normal), put(geometry.f0, i, r.f0);
      put(geometry.geometric_normal, i, r.geometric_normal);
      r.depth = geometry.depth[i], r.f90 = geometry.f90[i], r.ggx_alpha = geometry.ggx_alpha[i], r.unused = 0;
    }
  });
}

void pack(const VirtualPointLights& lights, const SubsetLayout& layout, VplRecord* to) {
  parallel_for(layout.light.size(), kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t entry = begin; entry < end; ++entry) {
      VplRecord& r = to[entry];
      r = {};
      const std::uint32_t i = layout.light[entry];
      if (i == kNoLight) continue;
      put(lights.position, i, r.position), put(lights.normal, i, r.normal), put(lights.incident, i, r.incident);
      put(lights.geometric_normal, i, r.geometric_normal), put(lights.flux, i, r.flux), put(lights.f0, i, r.f0);
      put(lights.diffuse_albedo, i, r.diffuse_albedo);
      r.f90 = lights.f90[i], r.ggx_alpha = lights.ggx_alpha[i], r.area = lights.area[i];
      r.key = lights.key[i], r.is_light = 1;
    }
  });
}

void unpack(const VplRecord* from, std::size_t entries, VirtualPointLights& lights) {
  std::vector<const VplRecord*> order;
  for (std::size_t i = 0; i < entries; ++i) {
    if (from[i].is_light != 0) order.push_back(from + i);
  }
  std::sort(order.begin(), order.end(), [](const VplRecord* a, const VplRecord* b) { return a->key < b->key; });
  lights.resize(order.size());
  parallel_for(order.size(), kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VplRecord& r = *order[i];
      get(r.position, i, lights.position), get(r.normal, i, lights.normal), get(r.incident, i, lights.incident);
      get(r.geometric_normal, i, lights.geometric_normal), get(r.flux, i, lights.flux), get(r.f0, i, lights.f0);
      get(r.diffuse_albedo, i, lights.diffuse_albedo);
      lights.f90[i] = r.f90, lights.ggx_alpha[i] = r.ggx_alpha, lights.area[i] = r.area, lights.key[i] = r.key;
    }
  });
}

void pack(const ManyLights& lights, const SubsetLayout& layout, ManyLightRecord* to) {
  parallel_for(layout.light.size(), kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t entry = begin; entry < end; ++entry) {
      ManyLightRecord& r = to[entry];
      r = {};
      const std::uint32_t i = layout.light[entry];
      if (i == kNoLight) continue;
      put(lights.position, i, r.position), put(lights.axis, i, r.axis), put(lights.intensity, i, r.intensity);
      r.scale = lights.scale[i], r.offset = lights.offset[i], r.two_sided = lights.two_sided[i];
      r.squared = lights.squared[i], r.area = lights.area[i], r.key = lights.key[i], r.is_light = 1;
    }
  });
}

void pack(const SubsetLayout& layout, SubsetRange* to) {
  for (std::size_t s = 0; s < layout.begin.size(); ++s) to[s] = {layout.begin[s], layout.count[s]};
}

void unpack(const GeometryBuffer& geometry, LightKind kind, const PixelSums* sums, float weight, ShadingOutputs& out) {
  const std::array<Radiance*, 2> targets = radiance_of(kind, out.radiance);
  const bool count = !out.lights_listed.empty();
  parallel_for(geometry.pixel_count(), kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (geometry.depth[i] == kNoSurface) continue;
      for (Radiance* radiance : targets) {
        if (radiance == nullptr) continue;
        add(sums[i].diffuse, weight, i, radiance->diffuse);
        add(sums[i].specular, weight, i, radiance->specular);
      }
      if (!count) continue;
      out.lights_listed[i] += static_cast<float>(sums[i].listed);
      out.lights_false[i] += static_cast<float>(sums[i].listed - sums[i].accepted);
    }
  });
}

void unpack(const PixelLight* from, std::size_t pixels, Radiance& light) {
  light.resize(pixels);
  parallel_for(pixels, kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        light.diffuse[c][i] = from[i].diffuse[c], light.specular[c][i] = from[i].specular[c];
      }
    }
  });
}

void unpack(LightKind kind, const TileCounts* tiles, std::size_t count, ShadingOutputs& out) {
  LightCounts& counts = counts_of(kind, out);
  std::uint64_t pixels = 0;
  for (std::size_t tile = 0; tile < count; ++tile) {
    for (int half = 0; half < 2; ++half) {
      if (tiles[tile].pixels[half] == 0) continue;
      pixels += tiles[tile].pixels[half];
      counts.listed += std::uint64_t(tiles[tile].listed[half]) * tiles[tile].pixels[half];
      out.list_lengths.push_back(tiles[tile].listed[half]);
    }
    counts.accepted += tiles[tile].accepted;
    counts.tests += tiles[tile].tests;
  }
  counts.evaluated = counts.listed;
  out.pixels = pixels;  // with a surface: the same for each kind
}

}  // namespace luciole
