// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/temporal_accumulation.h"

#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace luciole {
namespace {

Vec3 at(const Plane3& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }

void set(Plane3& planes, std::size_t i, Vec3 v) { planes[0][i] = v.x, planes[1][i] = v.y, planes[2][i] = v.z; }

PastLight light_of(const Radiance& radiance, std::size_t i) {
  return {at(radiance.diffuse, i), at(radiance.specular, i)};
}

void set(Radiance& radiance, std::size_t i, const PastLight& light) {
  set(radiance.diffuse, i, light.diffuse), set(radiance.specular, i, light.specular);
}

bool is_finite(Vec3 v) { return std::isfinite(v.x + v.y + v.z); }

}  // namespace

// Where the surfaces of this frame were in the frame before.
class TemporalAccumulationPass::Reprojection {
 public:
  Reprojection(const Past& past, const FrameView& now)
      : past_(past), way_(way_back(past.view, now)), eye_(now.camera.eye), view_(past_view(past.view)) {}

  Taps taps_of(const PastSurface& seen, std::size_t pixel) const {
    Taps taps;
    if (way_ == WayBack::none) return taps;
    if (way_ == WayBack::same_pixel) {
      taps.count = 1, taps.tap[0] = {pixel, 1.0f};
      return taps;
    }
    const f32::PastPlace place = f32::place_in_past(view_, seen.position);
    if (!(place.pixel_width > 0)) return taps;
    if (way_ == WayBack::same_surface) {
      add(taps, seen, pixel, 1.0f, place.pixel_width);
    } else {
      add_neighbours(taps, seen, place);
    }
    float sum = 0;
    for (int k = 0; k < taps.count; ++k) sum += taps.tap[k].weight;
    for (int k = 0; k < taps.count; ++k) taps.tap[k].weight /= sum;
    return taps;
  }

  // How much of a mean of reflected light is still worth.
  float worth_of_reflection(const PastSurface& seen, float alpha) const {
    return f32::worth_of_reflection(seen.position, eye_, view_.eye, alpha);
  }

 private:
  void add_neighbours(Taps& taps, const PastSurface& seen, const f32::PastPlace& place) const {
    const float w = view_.width, h = view_.height;
    if (!(place.x > -1 && place.x < w && place.y > -1 && place.y < h)) return;
    const float left = std::floor(place.x), top = std::floor(place.y);
    for (int k = 0; k < 4; ++k) {
      const float column = left + static_cast<float>(k % 2), row = top + static_cast<float>(k / 2);
      const float weight = f32::tap_weight(place, column, row);
      if (column < 0 || column >= w || row < 0 || row >= h || !(weight > f32::least_tap_weight())) continue;
      add(taps, seen, static_cast<std::size_t>(row) * past_.view.width + static_cast<std::size_t>(column), weight,
          place.pixel_width);
    }
  }

  void add(Taps& taps, const PastSurface& seen, std::size_t pixel, float weight, float width_there) const {
    const PastSurface& was = past_.surface[pixel];
    if (was.diffuse_frames == 0 || was.material != seen.material) return;
    const f32::Likeness like = f32::likeness(seen.position, seen.normal, seen.geometric_normal, was.position,
                                             was.normal, was.geometric_normal);
    if (f32::is_same_surface(like, width_there)) taps.tap[taps.count++] = {pixel, weight};
  }

  const Past& past_;
  WayBack way_;
  Vec3 eye_;  // of now
  f32::PastView view_;
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
  if (surface.specular_frames > 0)
    surface.specular_frames *= reprojection.worth_of_reflection(seen, g.ggx_alpha[pixel]);
  const bool has_many = !present_.many.empty();
  const PastLight now = light_of(indirect, pixel), now_many = has_many ? light_of(many, pixel) : PastLight();
  if (is_finite(now.diffuse + now.specular + now_many.diffuse + now_many.specular)) {
    const float most = static_cast<float>(inputs.longest - 1);
    surface.diffuse_frames = f32::frames_with_this(surface.diffuse_frames, most);
    surface.specular_frames = f32::frames_with_this(surface.specular_frames, most);
    const auto go_on_with = [&](PastLight light, PastLight& mean) {
      mean.diffuse = f32::mean_with_this(mean.diffuse, light.diffuse, surface.diffuse_frames);
      mean.specular = f32::mean_with_this(mean.specular, light.specular, surface.specular_frames);
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
  present_.view = {g.camera, g.sub_pixel_x, g.sub_pixel_y, g.width, g.height, inputs.view, !many.diffuse[0].empty()};
  present_.surface.resize(pixels), present_.indirect.resize(pixels);
  present_.many.resize(present_.view.has_many ? pixels : 0);
  frames_.resize(pixels);
  const Reprojection reprojection(past_, present_.view);
  parallel_for(pixels, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) go_on(inputs, reprojection, i, indirect, many);
  });
  std::swap(past_, present_);
}

}  // namespace luciole
