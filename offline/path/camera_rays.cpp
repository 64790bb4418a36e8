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
  if (!(aperture_ > 0)) return {camera_.eye, normalize(through)};
  const Vec2 lens = on_disc(aperture_ * std::sqrt(lens_numbers.x), lens_numbers.y);
  const Vec3 moved = camera_.right * lens.x + camera_.up * lens.y;
  return {camera_.eye + moved, normalize(through * focus_ - moved)};
}

}  // namespace luciole
