// SPDX-License-Identifier: Apache-2.0
#include "offline/path/camera_rays.h"

#include <cmath>
#include <numbers>

namespace luciole {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
// The gaussian: standard deviation and where it ends [pixels].
constexpr float kDeviation = 0.5f, kRadius = 1.5f;

// Of the triangle on [-1, 1].
float tent(float u) { return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u)); }

Vec2 on_disc(float radius, float turn) {
  return {radius * std::cos(2 * kPi * turn), radius * std::sin(2 * kPi * turn)};
}

}  // namespace

Vec2 filter_offset(PixelFilter filter, Vec2 u) {
  switch (filter) {
    case PixelFilter::box:
      return {u.x - 0.5f, u.y - 0.5f};
    case PixelFilter::tent:
      return {tent(u.x), tent(u.y)};
    case PixelFilter::gaussian: {
      const float inside = 1 - std::exp(-kRadius * kRadius / (2 * kDeviation * kDeviation));
      return on_disc(kDeviation * std::sqrt(-2 * std::log(1 - u.x * inside)), u.y);
    }
  }
  return {0, 0};
}

float filter_density(PixelFilter filter, Vec2 offset) {
  const float x = std::abs(offset.x), y = std::abs(offset.y);
  switch (filter) {
    case PixelFilter::box:
      return x < 0.5f && y < 0.5f ? 1.0f : 0.0f;
    case PixelFilter::tent:
      return x < 1 && y < 1 ? (1 - x) * (1 - y) : 0.0f;
    case PixelFilter::gaussian: {
      constexpr float kTwoVariances = 2 * kDeviation * kDeviation;
      const float radius_sq = x * x + y * y;
      if (radius_sq >= kRadius * kRadius) return 0;
      return std::exp(-radius_sq / kTwoVariances) /
             (kPi * kTwoVariances * (1 - std::exp(-kRadius * kRadius / kTwoVariances)));
    }
  }
  return 0;
}

float filter_radius(PixelFilter filter) {
  return filter == PixelFilter::box ? 0.5f : filter == PixelFilter::tent ? 1.0f : kRadius;
}

CameraRays::CameraRays(const Camera& camera, const PathSettings& settings)
    : camera_(camera),
      filter_(settings.pixel_filter),
      pixel_size_(2 * std::tan(0.5f * camera.vertical_fov) / static_cast<float>(settings.height)),
      half_width_(0.5f * static_cast<float>(settings.width)),
      half_height_(0.5f * static_cast<float>(settings.height)),
      aperture_(settings.aperture),
      focus_(settings.focus) {}

CameraRay CameraRays::ray(std::uint32_t x, std::uint32_t y, Vec2 filter_numbers, Vec2 lens_numbers) const {
  const Vec2 offset = filter_offset(filter_, filter_numbers);
  const float right = (static_cast<float>(x) + 0.5f + offset.x - half_width_) * pixel_size_;
  const float up = -(static_cast<float>(y) + 0.5f + offset.y - half_height_) * pixel_size_;
  const Vec3 through = camera_.forward + camera_.right * right + camera_.up * up;
  if (!(aperture_ > 0)) return {camera_.eye, normalize(through), offset};
  const Vec3 moved = on_lens(lens_numbers);
  return {camera_.eye + moved, normalize(through * focus_ - moved), offset};
}

Vec3 CameraRays::on_lens(Vec2 lens_numbers) const {
  if (!(aperture_ > 0)) return {0, 0, 0};
  const Vec2 lens = on_disc(aperture_ * std::sqrt(lens_numbers.x), lens_numbers.y);
  return camera_.right * lens.x + camera_.up * lens.y;
}

FilmPlace CameraRays::place_of(Vec3 point, Vec2 lens_numbers) const {
  FilmPlace place;
  const float depth = dot(point - camera_.eye, camera_.forward);
  if (!(depth > 0)) return place;
  const Vec3 moved = on_lens(lens_numbers);
  place.in_front = true;
  place.lens = camera_.eye + moved;
  // Where the ray from the lens through the point pierces the plane in focus, scaled to distance 1.
  const float focus = aperture_ > 0 ? focus_ : depth;
  const Vec3 pierced = (moved + (point - place.lens) * (focus / depth)) / focus;
  place.pixels = {dot(pierced, camera_.right) / pixel_size_ + half_width_,
                  half_height_ - dot(pierced, camera_.up) / pixel_size_};
  return place;
}

float CameraRays::film_per_area(Vec3 direction, float distance_sq, float cos_surface) const {
  const float cos_film = dot(direction, camera_.forward);
  return cos_surface / (distance_sq * cos_film * cos_film * cos_film * pixel_size_ * pixel_size_);
}

}  // namespace luciole
