// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/temporal_accumulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace luciole {
namespace {

// Of the same surface: normals no farther apart, and the tangent plane no farther off, in widths of a pixel there.
constexpr float kLeastNormalCosine = 0.9f, kFarthestFromPlane = 1.0f;

Vec3 at(const Plane3& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }

void set(Plane3& planes, std::size_t i, Vec3 v) { planes[0][i] = v.x, planes[1][i] = v.y, planes[2][i] = v.z; }

PastLight light_of(const Radiance& radiance, std::size_t i) {
  return {at(radiance.diffuse, i), at(radiance.specular, i)};
}

void set(Radiance& radiance, std::size_t i, const PastLight& light) {
  set(radiance.diffuse, i, light.diffuse), set(radiance.specular, i, light.specular);
}

bool is_finite(Vec3 v) { return std::isfinite(v.x + v.y + v.z); }

bool is_same_direction(const Camera& a, const Camera& b) {
  const auto same = [](Vec3 u, Vec3 v) { return u.x == v.x && u.y == v.y && u.z == v.z; };
  return same(a.eye, b.eye) && same(a.right, b.right) && same(a.up, b.up) && same(a.forward, b.forward) &&
         a.vertical_fov == b.vertical_fov;
}

}  // namespace

// Where the surfaces of this frame were in the frame before.
class TemporalAccumulationPass::Reprojection {
 public:
  Reprojection(const GeometryBuffer& now, const Past& past, std::uint64_t view, bool has_many)
      : past_(past),
        comparable_(past.width == now.width && past.height == now.height && past.many.empty() != has_many),
        same_geometry_(comparable_ && past.view == view),
        same_camera_(comparable_ && is_same_direction(past.camera, now.camera)),
        pixel_size_(2 * std::tan(0.5f * past.camera.vertical_fov) / static_cast<float>(std::max(past.height, 1u))) {}

  Taps taps_of(const PastSurface& seen, std::size_t pixel) const {
    Taps taps;
    if (!comparable_) return taps;
    if (same_geometry_) {
      taps.count = 1, taps.tap[0] = {pixel, 1.0f};
      return taps;
    }
    const Vec3 d = seen.position - past_.camera.eye;
    const float depth = dot(d, past_.camera.forward);
    if (!(depth > 0)) return taps;
    const float width_there = pixel_size_ * depth;
    if (same_camera_) {
      // Only the place in the pixel moves: whoever takes the nearest pixel does not blur the light frame after frame.
      add(taps, seen, pixel, 1.0f, width_there);
    } else {
      const float x =
          dot(d, past_.camera.right) / width_there + 0.5f * static_cast<float>(past_.width) - past_.sub_pixel_x;
      const float y =
          0.5f * static_cast<float>(past_.height) - dot(d, past_.camera.up) / width_there - past_.sub_pixel_y;
      add_neighbours(taps, seen, x, y, width_there);
    }
    float sum = 0;
    for (int k = 0; k < taps.count; ++k) sum += taps.tap[k].weight;
    for (int k = 0; k < taps.count; ++k) taps.tap[k].weight /= sum;
    return taps;
  }

  // How much of a mean of reflected light is still worth, seen from where the eye is now. The half vector turns by half
  // of what the view turns, and the lobe is about alpha wide.
  float worth_of_reflection(const PastSurface& seen, Vec3 eye, float alpha) const {
    const Vec3 turned = normalize(eye - seen.position) - normalize(past_.camera.eye - seen.position);
    return 4 * alpha * alpha / (4 * alpha * alpha + dot(turned, turned));
  }

 private:
  void add_neighbours(Taps& taps, const PastSurface& seen, float x, float y, float width_there) const {
    const float w = static_cast<float>(past_.width), h = static_cast<float>(past_.height);
    if (!(x > -1 && x < w && y > -1 && y < h)) return;
    const float left = std::floor(x), top = std::floor(y);
    for (int k = 0; k < 4; ++k) {
      const float column = left + static_cast<float>(k % 2), row = top + static_cast<float>(k / 2);
      const float weight = (1 - std::abs(x - column)) * (1 - std::abs(y - row));
      if (column < 0 || column >= w || row < 0 || row >= h || !(weight > 1e-3f)) continue;
      add(taps, seen, static_cast<std::size_t>(row) * past_.width + static_cast<std::size_t>(column), weight,
          width_there);
    }
  }

  void add(Taps& taps, const PastSurface& seen, std::size_t pixel, float weight, float width_there) const {
    const PastSurface& was = past_.surface[pixel];
    if (was.diffuse_frames == 0 || was.material != seen.material) return;
    if (dot(was.normal, seen.normal) < kLeastNormalCosine || dot(was.geometric_normal, seen.geometric_normal) < 0)
      return;
    const float off = std::abs(dot(seen.geometric_normal, was.position - seen.position));
    if (off <= kFarthestFromPlane * width_there) taps.tap[taps.count++] = {pixel, weight};
  }

  const Past& past_;
  bool comparable_, same_geometry_, same_camera_;
  float pixel_size_;  // at depth 1
};

TemporalAccumulationPass::PastSurface TemporalAccumulationPass::surface_of(const GeometryBuffer& g, std::size_t pixel) {
  if (g.depth[pixel] == kNoSurface) return {};
  return {at(g.position, pixel), at(g.normal, pixel), at(g.geometric_normal, pixel), g.material[pixel], 0, 0};
}

// The mean that the surface had in the frame before, and of how many frames.
TemporalAccumulationPass::Means TemporalAccumulationPass::means_before(const PastSurface& seen,
                                                                       const Taps& taps) const {
  Means means{seen, {}, {}};
  for (int k = 0; k < taps.count; ++k) {
    const auto [pixel, weight] = taps.tap[k];
    const auto add = [&, i = pixel, w = weight](PastLight& sum, const AlignedVector<PastLight>& light) {
      if (light.empty()) return;
      sum.diffuse += light[i].diffuse * w, sum.specular += light[i].specular * w;
    };
    add(means.indirect, past_.indirect), add(means.many, past_.many);
    means.surface.diffuse_frames += past_.surface[pixel].diffuse_frames * weight;
    means.surface.specular_frames += past_.surface[pixel].specular_frames * weight;
  }
  return means;
}

void TemporalAccumulationPass::go_on(const Inputs& inputs, const Reprojection& reprojection, std::size_t pixel,
                                     Radiance& indirect, Radiance& many) {
  const GeometryBuffer& g = inputs.geometry;
  const PastSurface seen = surface_of(g, pixel);
  present_.surface[pixel] = seen, frames_[pixel] = 0;
  if (g.depth[pixel] == kNoSurface) return;
  Means means = means_before(seen, reprojection.taps_of(seen, pixel));
  PastSurface& surface = means.surface;
  surface.specular_frames *= reprojection.worth_of_reflection(seen, g.camera.eye, g.ggx_alpha[pixel]);
  const bool has_many = !present_.many.empty();
  const PastLight now = light_of(indirect, pixel), now_many = has_many ? light_of(many, pixel) : PastLight();
  if (is_finite(now.diffuse + now.specular + now_many.diffuse + now_many.specular)) {
    const float most = static_cast<float>(inputs.longest - 1);
    surface.diffuse_frames = std::min(surface.diffuse_frames, most) + 1;
    surface.specular_frames = std::min(surface.specular_frames, most) + 1;
    const auto go_on_with = [&](PastLight light, PastLight& mean) {
      mean.diffuse += (light.diffuse - mean.diffuse) * (1 / surface.diffuse_frames);
      mean.specular += (light.specular - mean.specular) * (1 / surface.specular_frames);
    };
    go_on_with(now, means.indirect), go_on_with(now_many, means.many);
  } else if (surface.diffuse_frames == 0) {
    return;
  }
  present_.surface[pixel] = surface, frames_[pixel] = surface.diffuse_frames;
  present_.indirect[pixel] = means.indirect;
  set(indirect, pixel, means.indirect);
  if (!has_many) return;
  present_.many[pixel] = means.many;
  set(many, pixel, means.many);
}

void TemporalAccumulationPass::run(const Inputs& inputs, Radiance& indirect, Radiance& many) {
  const GeometryBuffer& g = inputs.geometry;
  const std::size_t pixels = g.pixel_count();
  present_.camera = g.camera, present_.view = inputs.view;
  present_.sub_pixel_x = g.sub_pixel_x, present_.sub_pixel_y = g.sub_pixel_y;
  present_.width = g.width, present_.height = g.height;
  present_.surface.resize(pixels), present_.indirect.resize(pixels);
  present_.many.resize(many.diffuse[0].empty() ? 0 : pixels);
  frames_.resize(pixels);
  const Reprojection reprojection(g, past_, inputs.view, !present_.many.empty());
  parallel_for(pixels, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) go_on(inputs, reprojection, i, indirect, many);
  });
  std::swap(past_, present_);
}

}  // namespace luciole
