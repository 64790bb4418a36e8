// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/reference_accumulation.h"

#include <algorithm>
#include <cmath>

#include "equations/cpp/double.h"

#define LUCIOLE_FN inline
namespace luciole::f64 {
#include "real_time/filtering/reprojection.h"
}
#undef LUCIOLE_FN

namespace luciole {
namespace {

// What an operation may err, relative to its result: sums and products are correctly rounded in whatever direction; a
// division may err by 2.5 units in the last place, a vector brought to length 1 by the 2 of an inverse square root
// and what its five operations err besides ("Precision and Operation of SPIR-V Instructions" of the Vulkan
// specification).
constexpr double kUnit = 0x1p-23, kDivision = 2.5 * kUnit, kNormalized = 6 * kUnit;

using f64::real3;

real3 wide(Vec3 v) { return {v.x, v.y, v.z}; }
real3 wide(const Plane3& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }
double size_of(real3 a, real3 b) { return std::abs(a.x * b.x) + std::abs(a.y * b.y) + std::abs(a.z * b.z); }

// Of a.b where b is what it is and a a difference of such vectors: rounded once, then three products and two sums.
double dot_error(real3 difference, real3 axis) { return 4 * kUnit * size_of(difference, axis); }

f64::PastView wide(const f32::PastView& v) {
  f64::PastView w;
  w.eye = wide(v.eye), w.right = wide(v.right), w.up = wide(v.up), w.forward = wide(v.forward);
  w.pixel_size = v.pixel_size, w.width = v.width, w.height = v.height;
  w.sub_pixel_x = v.sub_pixel_x, w.sub_pixel_y = v.sub_pixel_y;
  return w;
}

// A place in the past frame, and how far off float's may be.
struct UncertainPlace {
  f64::PastPlace place;
  double x_error, y_error, width_error;
};

UncertainPlace uncertain_place(const f64::PastView& view, real3 position) {
  UncertainPlace p;
  p.place = f64::place_in_past(view, position);
  const real3 d = position - view.eye;
  const double depth = f64::dot(d, view.forward), width = p.place.pixel_width;
  p.width_error = view.pixel_size * dot_error(d, view.forward) + kUnit * std::abs(width);
  const double relative = p.width_error / std::abs(width) + kDivision;
  const auto error = [&](real3 axis, double side, double sub_pixel) {
    const double quotient = std::abs(f64::dot(d, axis) / width);
    return dot_error(d, axis) / std::abs(width) + quotient * relative + 2 * kUnit * (quotient + 0.5 * side + sub_pixel);
  };
  p.x_error = error(view.right, view.width, view.sub_pixel_x);
  p.y_error = error(view.up, view.height, view.sub_pixel_y);
  if (!(depth > 0)) p.x_error = p.y_error = 0;  // behind the camera: nobody asks
  return p;
}

// Of a sum of products that are rounded, and added one after the other.
void add_product(Uncertain& sum, const Uncertain& a, const Uncertain& b) {
  sum.value += a.value * b.value;
  sum.error += std::abs(a.value) * b.error + a.error * std::abs(b.value) + a.error * b.error +
               2 * kUnit * std::abs(a.value * b.value) + kUnit * std::abs(sum.value);
}

Uncertain worth_of_reflection(const GeometryBuffer& g, Vec3 past_eye, std::size_t i) {
  const real3 position = wide(g.position, i), eye = wide(g.camera.eye), before = wide(past_eye);
  const double alpha = g.ggx_alpha[i], width_sq = 4 * alpha * alpha;
  Uncertain worth;
  worth.value = f64::worth_of_reflection(position, eye, before, alpha);
  const real3 turned = f64::normalize(eye - position) - f64::normalize(before - position);
  // Both are unit vectors, so their difference errs by that of either, and its square by this.
  const double off = 2 * kNormalized + kUnit, length = f64::length(turned);
  const double square_error = std::sqrt(3.0) * 2 * length * off + 3 * off * off + 3 * kUnit * length * length;
  const double sum = width_sq + length * length;
  worth.error = worth.value * (square_error / sum + 6 * kUnit + kDivision);
  return worth;
}

Uncertain frames_with_this(Uncertain past, double most) {
  Uncertain frames;
  frames.value = f64::frames_with_this(past.value, most);
  frames.error = past.error + kUnit * frames.value;
  return frames;
}

Uncertain mean_with_this(Uncertain past, Uncertain light, Uncertain frames) {
  const double step = std::abs(light.value - past.value), weight = 1 / frames.value;
  Uncertain mean;
  mean.value = past.value + (light.value - past.value) * weight;
  // One frame alone takes nothing of the past; of more, the mean lies between the two.
  mean.error = past.error * (1 - weight) + light.error * weight + step * weight * (frames.error * weight) +
               step * weight * (2 * kUnit + kDivision) + kUnit * (std::abs(past.value) + std::abs(mean.value));
  return mean;
}

}  // namespace

void ReferenceAccumulation::add(Taps& taps, const GeometryBuffer& g, std::size_t pixel, std::size_t past,
                                Uncertain weight, Uncertain pixel_width) const {
  const Pixel& was = past_pixels_[past];
  if (was.diffuse_frames.value == 0 || past_.material[past] != g.material[pixel]) return;
  const real3 position = wide(g.position, pixel), plane = wide(g.geometric_normal, pixel);
  const f64::Likeness like = f64::likeness(position, wide(g.normal, pixel), plane, wide(past_.position, past),
                                           wide(past_.normal, past), wide(past_.geometric_normal, past));
  // By how much each rule is kept, and what that may err; the first two compare unit vectors: three products, two sums.
  const double off_error = dot_error(wide(past_.position, past) - position, plane) + pixel_width.error;
  const Uncertain kept[] = {{like.normal_cosine - f64::least_normal_cosine(), 3 * kUnit},
                            {like.geometric_cosine, 3 * kUnit},
                            {f64::farthest_from_plane() * pixel_width.value - like.off_plane, off_error}};
  bool certain = !was.contested;
  for (const Uncertain& rule : kept) {
    if (rule.value < -rule.error) return;
    certain = certain && rule.value > rule.error;
  }
  if (!certain) taps.contested = true;
  if (f64::is_same_surface(like, pixel_width.value)) taps.taps.push_back({past, weight});
}

ReferenceAccumulation::Taps ReferenceAccumulation::taps_of(const GeometryBuffer& g, WayBack way,
                                                           std::size_t pixel) const {
  Taps taps;
  if (way == WayBack::none) return taps;
  if (way == WayBack::same_pixel) {
    taps.taps.push_back({pixel, {1, 0}});
    taps.contested = past_pixels_[pixel].contested;
    return taps;
  }
  const f64::PastView view = wide(past_view(view_));
  const UncertainPlace p = uncertain_place(view, wide(g.position, pixel));
  const Uncertain width{p.place.pixel_width, p.width_error};
  taps.contested = std::abs(width.value) <= width.error;
  if (!(width.value > 0)) return taps;  // behind the camera
  if (way == WayBack::same_surface) {
    add(taps, g, pixel, pixel, {1, 0}, width);
    return taps;
  }
  const double left = std::floor(p.place.x), top = std::floor(p.place.y), error = p.x_error + p.y_error + 4 * kUnit;
  for (int k = 0; k < 4; ++k) {
    const double column = left + k % 2, row = top + double(k / 2);
    if (column < 0 || column >= view.width || row < 0 || row >= view.height) continue;
    // A place that float puts into the next column or row changes only taps that are too light to count.
    Uncertain weight{f64::tap_weight(p.place, column, row), error};
    if (weight.value <= f64::least_tap_weight() - error) continue;
    if (weight.value <= f64::least_tap_weight() + error) weight.error = weight.value + error;  // it may not be there
    add(taps, g, pixel, static_cast<std::size_t>(row) * past_.width + static_cast<std::size_t>(column), weight, width);
  }
  double sum = 0, sum_error = 0;
  for (const Tap& tap : taps.taps) sum += tap.weight.value, sum_error += tap.weight.error + 3 * kUnit;
  if (!taps.taps.empty() && sum <= 2 * sum_error) taps.contested = true;  // there may be none
  for (Tap& tap : taps.taps) {
    Uncertain& w = tap.weight;
    w = {w.value / sum, (w.error + w.value / sum * sum_error) / (sum - sum_error) + kDivision * w.value / sum};
  }
  return taps;
}

ReferenceAccumulation::Pixel ReferenceAccumulation::go_on(const GeometryBuffer& g, const Taps& taps, std::size_t pixel,
                                                          const Light& now) const {
  Pixel result;
  result.contested = taps.contested;
  for (const Tap& tap : taps.taps) {
    const Pixel& was = past_pixels_[tap.pixel];
    add_product(result.diffuse_frames, was.diffuse_frames, tap.weight);
    add_product(result.specular_frames, was.specular_frames, tap.weight);
    for (std::size_t c = 0; c < now.size(); ++c) add_product(result.light[c], was.light[c], tap.weight);
  }
  if (result.specular_frames.value > 0) {
    Uncertain aged;
    add_product(aged, result.specular_frames, worth_of_reflection(g, view_.camera.eye, pixel));
    result.specular_frames = aged;
  }
  result.diffuse_frames = frames_with_this(result.diffuse_frames, most_);
  result.specular_frames = frames_with_this(result.specular_frames, most_);
  for (std::size_t c = 0; c < now.size(); ++c) {
    const Uncertain& frames = c % 6 < 3 ? result.diffuse_frames : result.specular_frames;
    result.light[c] = mean_with_this(result.light[c], now[c], frames);
  }
  return result;
}

void ReferenceAccumulation::run(const GeometryBuffer& g, std::uint64_t number, const Radiance& indirect,
                                const Radiance& many) {
  const FrameView now{g.camera, g.sub_pixel_x, g.sub_pixel_y, g.width, g.height, number, !many.diffuse[0].empty()};
  const WayBack way = way_back(view_, now);
  pixels_.assign(g.pixel_count(), {});
  for (std::size_t i = 0; i < g.pixel_count(); ++i) {
    if (g.depth[i] == kNoSurface) continue;
    Light light{};
    for (std::size_t c = 0; c < 12; ++c) {
      const Radiance& of = c < 6 ? indirect : many;
      const Plane3& planes = c % 6 < 3 ? of.diffuse : of.specular;
      if (planes[0].empty()) continue;
      const double value = planes[c % 3][i];
      light[c] = {value, 3 * kUnit * std::abs(value)};  // two products, positive both, and their sum
    }
    pixels_[i] = go_on(g, taps_of(g, way, i), i, light);
  }
  view_ = now, past_ = g, past_pixels_ = pixels_;
}

}  // namespace luciole
