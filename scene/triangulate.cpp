// SPDX-License-Identifier: Apache-2.0
#include "scene/triangulate.h"

#include <cmath>
#include <cstddef>

namespace luciole {
namespace {

// A hostile polygon may make ears hard to find; past this many point tests it is cut as a fan.
constexpr std::size_t kMostTests = 1u << 20;

// Newell's sum: twice the vector area.
Vec3 area_vector(const std::vector<Vec3>& corners) {
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sum += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  return sum;
}

// Drops the axis along which the polygon is seen best, keeping its sense of rotation: counter-clockwise after.
std::vector<Vec2> projected(const std::vector<Vec3>& corners, Vec3 normal) {
  const Vec3 size = abs(normal);
  std::vector<Vec2> result;
  result.reserve(corners.size());
  for (const Vec3& p : corners) {
    if (size.x >= size.y && size.x >= size.z) {
      result.push_back(normal.x > 0 ? Vec2(p.y, p.z) : Vec2(p.z, p.y));
    } else if (size.y >= size.z) {
      result.push_back(normal.y > 0 ? Vec2(p.z, p.x) : Vec2(p.x, p.z));
    } else {
      result.push_back(normal.z > 0 ? Vec2(p.x, p.y) : Vec2(p.y, p.x));
    }
  }
  return result;
}

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return (double(b.x) - a.x) * (double(c.y) - a.y) - (double(c.x) - a.x) * (double(b.y) - a.y);
}

class EarClipper {
 public:
  explicit EarClipper(std::vector<Vec2> points) : points_(std::move(points)) {
    for (std::uint32_t i = 0; i < points_.size(); ++i) left_.push_back(i);
  }

  std::vector<std::uint32_t> triangles() {
    std::vector<std::uint32_t> result;
    std::size_t at = 0, tried = 0;
    while (left_.size() > 3) {
      at %= left_.size();
      // Where no ear is left (a polygon that crosses itself), any corner will do.
      if (tried <= left_.size() && tests_ < kMostTests && !is_ear(at)) {
        ++at;
        ++tried;
        continue;
      }
      result.insert(result.end(), {corner(at, -1), corner(at, 0), corner(at, 1)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      tried = 0;
    }
    result.insert(result.end(), left_.begin(), left_.end());
    return result;
  }

 private:
  std::uint32_t corner(std::size_t at, int step) const {
    return left_[(at + left_.size() + static_cast<std::size_t>(step + 1) - 1) % left_.size()];
  }

  bool is_ear(std::size_t at) {
    const Vec2 a = points_[corner(at, -1)], b = points_[corner(at, 0)], c = points_[corner(at, 1)];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::size_t i = 2; i + 1 < left_.size(); ++i) {
      ++tests_;
      const Vec2 p = points_[left_[(at + i) % left_.size()]];
      const bool inside = turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
      const bool is_corner = (p.x == a.x && p.y == a.y) || (p.x == b.x && p.y == b.y) || (p.x == c.x && p.y == c.y);
      if (inside && !is_corner) return false;
    }
    return true;
  }

  std::vector<Vec2> points_;
  std::vector<std::uint32_t> left_;
  std::size_t tests_ = 0;
};

}  // namespace

std::vector<std::uint32_t> triangulate(const std::vector<Vec3>& corners) {
  if (corners.size() < 3) return {};
  if (corners.size() == 3) return {0, 1, 2};
  return EarClipper(projected(corners, area_vector(corners))).triangles();
}

}  // namespace luciole
