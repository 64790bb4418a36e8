// SPDX-License-Identifier: Apache-2.0
#include "shot/camera_path.h"

#include <algorithm>
#include <cmath>

namespace luciole {
namespace {

// The place between two keys: which ones, and how far, 0 at `before` and 1 at `after`.
struct Span {
  std::size_t before, after;
  double fraction;
};

Span span_at(const std::vector<CameraKey>& keys, double at) {
  if (!(at > keys.front().at)) return {0, 0, 0};
  if (at >= keys.back().at) return {keys.size() - 1, keys.size() - 1, 0};
  const auto behind =
      std::upper_bound(keys.begin(), keys.end(), at, [](double value, const CameraKey& key) { return value < key.at; });
  const auto after = static_cast<std::size_t>(behind - keys.begin());
  return {after - 1, after, (at - keys[after - 1].at) / (keys[after].at - keys[after - 1].at)};
}

// A value per key, and its curve.
template <class Value>
class Curve {
 public:
  Curve(const std::vector<CameraKey>& keys, Value value) : keys_(keys), value_(value) {}

  // Hermite's cubic, written so that equal values give just that value, without rounding.
  double operator()(const Span& span) const {
    const double from = value(span.before), to = value(span.after), t = span.fraction;
    if (span.before == span.after) return from;
    const double duration = keys_[span.after].at - keys_[span.before].at;
    return from + (to - from) * (t * t * (3 - 2 * t)) +
           duration * t * (1 - t) * (velocity(span.before) * (1 - t) - velocity(span.after) * t);
  }

 private:
  double value(std::size_t key) const { return static_cast<double>(value_(keys_[key])); }
  double velocity(std::size_t key) const {
    const std::size_t before = key == 0 ? 0 : key - 1, after = std::min(key + 1, keys_.size() - 1);
    return (value(after) - value(before)) / (keys_[after].at - keys_[before].at);
  }

  const std::vector<CameraKey>& keys_;
  Value value_;
};

template <class Value>
float on_curve(const std::vector<CameraKey>& keys, const Span& span, Value value) {
  return static_cast<float>(Curve<Value>(keys, value)(span));
}

Vec3 point_on_curve(const std::vector<CameraKey>& keys, const Span& span, Vec3 CameraKey::*point) {
  return {on_curve(keys, span, [point](const CameraKey& key) { return (key.*point).x; }),
          on_curve(keys, span, [point](const CameraKey& key) { return (key.*point).y; }),
          on_curve(keys, span, [point](const CameraKey& key) { return (key.*point).z; })};
}

}  // namespace

Camera camera_at(const CameraPath& path, double frame, double frames_per_second) {
  const std::vector<CameraKey>& keys = path.keys;
  const Span span = span_at(keys, path.in_frames ? frame : frame / frames_per_second);
  const float fov = on_curve(keys, span, [](const CameraKey& key) { return key.vertical_fov; });
  const auto [narrow, wide] = std::minmax(keys[span.before].vertical_fov, keys[span.after].vertical_fov);
  return look_at(point_on_curve(keys, span, &CameraKey::eye), point_on_curve(keys, span, &CameraKey::target),
                 std::clamp(fov, narrow, wide));
}

}  // namespace luciole
