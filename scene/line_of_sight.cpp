// SPDX-License-Identifier: Apache-2.0
#include "scene/line_of_sight.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace luciole {
namespace {

constexpr std::size_t kLinesPerTask = 64;
constexpr std::size_t kIndicesPerBlock = 3 * 64;

// Moeller and Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection" (1997).
void meet(const SightLine& line, Vec3 a, Vec3 e1, Vec3 e2, Sight& sight) {
  const Vec3 p = cross(line.direction, e2);
  const float determinant = dot(e1, p);
  if (determinant == 0) return;
  const Vec3 s = line.origin - a;
  const float u = dot(s, p) / determinant;
  if (!(u >= 0 && u <= 1)) return;
  const Vec3 q = cross(s, e1);
  const float v = dot(line.direction, q) / determinant;
  if (!(v >= 0 && u + v <= 1)) return;
  const float distance = dot(e2, q) / determinant;
  if (distance > line.nearest && distance < sight.distance) sight = {distance, determinant > 0};
}

// Finite also along an axis: a line that starts on the side of a box would get zero times infinity there.
float inverse(float x) { return std::abs(x) > 1e-20f ? 1 / x : 1e20f; }

// Whether a line passes through a box before it meets what it has met so far.
bool passes(const SightLine& line, Vec3 inverse_direction, const Bounds& box, float furthest) {
  const Vec3 t0 = (box.low - line.origin) * inverse_direction, t1 = (box.high - line.origin) * inverse_direction;
  float enter = 0, leave = furthest;
  for (const auto& [a, b] : {std::pair(t0.x, t1.x), std::pair(t0.y, t1.y), std::pair(t0.z, t1.z)}) {
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave * 1.00001f;
}

// Triangles that follow each other in a mesh lie near each other, so most lines miss most boxes.
class Block {
 public:
  Block(const Mesh& mesh, std::size_t begin, std::size_t end) : mesh_(mesh), begin_(begin), end_(end) {
    for (std::size_t i = begin; i < end; ++i) box_.grow(mesh.positions[mesh.indices[i]]);
  }
  void look(const SightLine& line, Vec3 inverse_direction, Sight& sight) const {
    if (!passes(line, inverse_direction, box_, sight.distance)) return;
    for (std::size_t i = begin_; i + 2 < end_; i += 3) {
      const Vec3 a = mesh_.positions[mesh_.indices[i]];
      meet(line, a, mesh_.positions[mesh_.indices[i + 1]] - a, mesh_.positions[mesh_.indices[i + 2]] - a, sight);
    }
  }

 private:
  const Mesh& mesh_;
  std::size_t begin_, end_;  // of the indices
  Bounds box_;
};

}  // namespace

std::vector<Sight> look_along(const Scene& scene, const std::vector<SightLine>& lines) {
  std::vector<Sight> sights(lines.size());
  parallel_for(lines.size(), kLinesPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3> inverses;
    for (std::size_t k = begin; k < end; ++k) {
      const Vec3 d = lines[k].direction;
      inverses.emplace_back(inverse(d.x), inverse(d.y), inverse(d.z));
    }
    for (const Mesh& mesh : scene.meshes) {
      for (std::size_t i = 0; i < mesh.indices.size(); i += kIndicesPerBlock) {
        const Block block(mesh, i, std::min(i + kIndicesPerBlock, mesh.indices.size()));
        for (std::size_t k = begin; k < end; ++k) block.look(lines[k], inverses[k - begin], sights[k]);
      }
    }
  });
  return sights;
}

std::vector<Vec3> even_directions(std::size_t count) {
  constexpr float kGoldenAngle = 2.39996323f;  // [rad]: the points of a Fibonacci spiral
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const float y = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
    const float radius = std::sqrt(1 - y * y), angle = kGoldenAngle * static_cast<float>(i);
    directions.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
  }
  return directions;
}

}  // namespace luciole
