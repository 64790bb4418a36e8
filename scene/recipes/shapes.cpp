// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/shapes.h"

#include <algorithm>
#include <cmath>

#include "scene/recipes/placement.h"

namespace luciole::workshop {
namespace {

struct Frame {
  Vec3 across, up, along;  // orthonormal, right-handed
};

Vec3 any_perpendicular(Vec3 v) {
  return normalize(cross(v, std::abs(v.x) < 0.8f * length(v) ? Vec3{1, 0, 0} : Vec3{0, 0, 1}));
}

Vec3 tangent(const Sweep& shape, std::size_t i) {
  const std::size_t count = shape.path.size();
  const std::size_t before = shape.closed ? (i + count - 1) % count : (i > 0 ? i - 1 : 0);
  const std::size_t after = shape.closed ? (i + 1) % count : std::min(i + 1, count - 1);
  return normalize(shape.path[after] - shape.path[before]);
}

Frame frame_near(Vec3 along, Vec3 wanted_up) {
  Vec3 up = wanted_up - along * dot(along, wanted_up);
  up = dot(up, up) > 1e-10f ? normalize(up) : any_perpendicular(along);
  return {cross(up, along), up, along};
}

// Frames that turn about the path no more than it makes them; a closed path's left-over turn is shared by all.
std::vector<Frame> frames(const Sweep& shape) {
  const std::size_t count = shape.path.size();
  std::vector<Frame> result(count);
  Vec3 up = shape.up ? *shape.up : any_perpendicular(tangent(shape, 0));
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = frame_near(tangent(shape, i), shape.up ? *shape.up : up);
    up = result[i].up;
  }
  if (!shape.closed || shape.up) return result;
  const Frame again = frame_near(result[0].along, up);
  const float excess = std::atan2(dot(cross(again.up, result[0].up), result[0].along), dot(again.up, result[0].up));
  for (std::size_t i = 0; i < count; ++i) {
    const float angle = excess * static_cast<float>(i) / static_cast<float>(count);
    const Frame f = result[i];
    result[i].up = f.up * std::cos(angle) - f.across * std::sin(angle);
    result[i].across = f.across * std::cos(angle) + f.up * std::sin(angle);
  }
  return result;
}

float distance(Vec2 a, Vec2 b) { return std::sqrt(dot(b - a, b - a)); }
float distance(Vec3 a, Vec3 b) { return length(b - a); }

// How far along a line each of its points lies [m]; a closed line comes back to its first point at the end.
template <class Point>
std::vector<float> way_along(const std::vector<Point>& line, bool closed) {
  std::vector<float> way = {0};
  for (std::size_t i = 1; i < line.size(); ++i) way.push_back(way.back() + distance(line[i - 1], line[i]));
  if (closed) way.push_back(way.back() + distance(line.back(), line.front()));
  return way;
}

}  // namespace

Mesh lathe(const std::vector<Vec2>& profile, std::uint32_t columns) {
  const auto rows = static_cast<std::uint32_t>(profile.size() - 1);
  const auto turned = circle(1, columns);
  Mesh mesh = grid_surface({columns, rows, true, false, {1, 1}}, [&](float u, float v) {
    const Vec2 p = profile[static_cast<std::size_t>(std::lround(v * static_cast<float>(rows)))];
    const Vec2 c = turned[static_cast<std::size_t>(std::lround(u * static_cast<float>(columns)))];
    return Vec3{p.x * c.x, p.y, -p.x * c.y};
  });
  float widest = 0;
  for (const Vec2 p : profile) widest = std::max(widest, p.x);
  std::vector<float> round;
  for (std::uint32_t i = 0; i <= columns; ++i)
    round.push_back(kTwoPi * widest * static_cast<float>(i) / static_cast<float>(columns));
  set_uv(mesh, round, way_along(profile, false));
  return mesh;
}

Mesh sweep(const Sweep& shape) {
  const std::vector<Frame> frame = frames(shape);
  const std::size_t stations = shape.path.size(), sides = shape.section.size();
  const std::size_t rows = shape.closed ? stations : stations - 1;
  const auto loop_at = [&](std::size_t station) {
    std::vector<Vec3> loop;
    const float along = static_cast<float>(station) / static_cast<float>(rows);
    const float size = shape.size ? shape.size(along) : 1.0f;
    for (const Vec2 s : shape.section) {
      loop.push_back(shape.path[station] + (frame[station].across * s.x + frame[station].up * s.y) * size);
    }
    return loop;
  };
  std::vector<Vec3> points;
  for (std::size_t j = 0; j <= rows; ++j) {
    std::vector<Vec3> loop = loop_at(j % stations);
    loop.push_back(loop.front());
    points.insert(points.end(), loop.begin(), loop.end());
  }
  Mesh mesh = grid_from_points(
      {static_cast<std::uint32_t>(sides), static_cast<std::uint32_t>(rows), true, shape.closed, {1, 1}},
      std::move(points));
  set_uv(mesh, way_along(shape.section, true), way_along(shape.path, shape.closed));
  if (shape.closed) return mesh;
  std::vector<Vec3> first = loop_at(0);
  std::reverse(first.begin(), first.end());
  append(mesh, fan(first, -frame.front().along));
  append(mesh, fan(loop_at(stations - 1), frame.back().along));
  return mesh;
}

Mesh tube(std::vector<Vec3> path, float radius, std::uint32_t sides, bool closed) {
  return sweep({std::move(path), closed, circle(radius, sides), nullptr, std::nullopt});
}

Mesh moulding(const std::vector<Vec2>& plan, const std::vector<Vec2>& profile) {
  const auto columns = static_cast<std::uint32_t>(plan.size()), rows = static_cast<std::uint32_t>(profile.size() - 1);
  std::vector<Vec3> points;
  for (const Vec2 step : profile) {
    const std::vector<Vec2> loop = moved_outwards(plan, step.x);
    for (std::size_t i = 0; i <= columns; ++i) {
      const Vec2 p = loop[i % columns];
      points.push_back({p.x, step.y, -p.y});
    }
  }
  Mesh mesh = grid_from_points({columns, rows, true, false, {1, 1}}, std::move(points));
  set_uv(mesh, way_along(plan, true), way_along(profile, false));
  return mesh;
}

std::vector<Vec3> curve(std::uint32_t samples, bool closed, const std::function<Vec3(float along)>& position) {
  std::vector<Vec3> path;
  for (std::uint32_t i = 0; i < samples; ++i) {
    path.push_back(position(static_cast<float>(i) / static_cast<float>(closed ? samples : samples - 1)));
  }
  return path;
}

std::vector<Vec3> smooth_path(const std::vector<Vec3>& through, std::uint32_t samples) {
  const auto at = [&](std::ptrdiff_t i) {
    return through[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(through) - 1))];
  };
  return curve(samples, false, [&](float along) {
    const float place = along * static_cast<float>(through.size() - 1);
    const auto i = std::min(static_cast<std::ptrdiff_t>(place), std::ssize(through) - 2);
    const float t = place - static_cast<float>(i), t2 = t * t, t3 = t2 * t;
    return (at(i - 1) * (-t3 + 2 * t2 - t) + at(i) * (3 * t3 - 5 * t2 + 2) + at(i + 1) * (-3 * t3 + 4 * t2 + t) +
            at(i + 2) * (t3 - t2)) *
           0.5f;
  });
}

}  // namespace luciole::workshop
