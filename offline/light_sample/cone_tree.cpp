// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/cone_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace luciole {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float sine_of(float cosine) { return std::sqrt(std::max(1 - cosine * cosine, 0.0f)); }
float angle_of(float cosine) { return std::acos(std::clamp(cosine, -1.0f, 1.0f)); }

// cos(max(a - b, 0)) of angles given by their cosines and sines, both in [0, pi].
float cos_of_difference(float cos_a, float sin_a, float cos_b, float sin_b) {
  return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_of_difference(float cos_a, float sin_a, float cos_b, float sin_b) {
  return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

// The smallest cone round two.
DirectionCone joined_cones(const DirectionCone& a, const DirectionCone& b) {
  const float angle_a = angle_of(a.cos_angle), angle_b = angle_of(b.cos_angle);
  const float between = angle_of(dot(a.axis, b.axis));
  if (std::min(between + angle_b, kPi) <= angle_a) return a;
  if (std::min(between + angle_a, kPi) <= angle_b) return b;
  const float angle = (angle_a + between + angle_b) / 2;
  const Vec3 turn_axis = cross(a.axis, b.axis);
  if (angle >= kPi || !(dot(turn_axis, turn_axis) > 0)) return {a.axis, -1};
  // a's axis turned towards b's, in their plane.
  const float turn = angle - angle_a;
  const Vec3 across = normalize(cross(turn_axis, a.axis));
  return {normalize(a.axis * std::cos(turn) + across * std::sin(turn)), std::cos(angle)};
}

float surface_area(const Bounds& box) {
  const Vec3 d = box.high - box.low;
  return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
}

float component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3 vector(const float v[3]) { return {v[0], v[1], v[2]}; }

}  // namespace

ConeTreeSampler::Bound ConeTreeSampler::bound_of(const LightRecord& light, const Scene& scene) {
  Bound bound;
  bound.normals.axis = light.axis();
  bound.flux = light.intensity * (1 + light.two_sided), bound.two_sided = light.two_sided;
  if (light.lamp == 0) {
    const Mesh& mesh = scene.meshes[light.mesh];
    for (std::size_t k = 0; k < 3; ++k)
      bound.box.grow(mesh.positions[mesh.indices[std::size_t(light.triangle) * 3 + k]]);
    return bound;
  }
  bound.box.grow(light.centre());
  bound.flux = 4 * light.intensity;  // against pi * intensity of a facet, without the common pi
  if (light.scale == 0) {
    bound.normals.cos_angle = -1;
  } else {
    const float outer = -light.offset / light.scale, inner = std::min(outer + 1 / light.scale, 1.0f);
    bound.normals.cos_angle = inner;
    bound.cos_emission = std::cos(angle_of(outer) - angle_of(inner));
    bound.flux *= 0.5f * (1 - (inner + outer) / 2);
  }
  return bound;
}

ConeTreeSampler::Bound ConeTreeSampler::joined(const Bound& a, const Bound& b) {
  if (a.flux == 0) return b;
  if (b.flux == 0) return a;
  Bound both;
  both.box = a.box, both.box.grow(b.box.low), both.box.grow(b.box.high);
  both.normals = joined_cones(a.normals, b.normals);
  both.cos_emission = std::min(a.cos_emission, b.cos_emission);
  both.flux = a.flux + b.flux;
  both.two_sided = std::max(a.two_sided, b.two_sided);
  return both;
}

// Flux times area times the solid angle that the node's light fills, with a penalty for thin boxes.   Sect. 4.4, Eq. 1
double ConeTreeSampler::cost(const Bound& bound, float longest_side, float side) {
  const float theta_o = angle_of(bound.normals.cos_angle), theta_e = angle_of(bound.cos_emission);
  const float theta_w = std::min(theta_o + theta_e, kPi);
  const float sin_o = sine_of(bound.normals.cos_angle), cos_o = bound.normals.cos_angle;
  const float orientation =
      2 * kPi * (1 - cos_o) +
      kPi / 2 * (2 * theta_w * sin_o - std::cos(theta_o - 2 * theta_w) - 2 * theta_o * sin_o + cos_o);
  return double(bound.flux) * orientation * (longest_side / std::max(side, 1e-20f)) * surface_area(bound.box);
}

// Where to cut items[begin, end): reorders them and returns the first of the second half.
std::size_t ConeTreeSampler::split(std::vector<Item>& items, std::size_t begin, std::size_t end,
                                   const Bound& bound) const {
  constexpr int kBuckets = 12;
  Bounds centres;
  for (std::size_t i = begin; i < end; ++i) centres.grow(items[i].bound.box.centre());
  const Vec3 sides = bound.box.high - bound.box.low;
  const float longest = std::max({sides.x, sides.y, sides.z});
  double best_cost = std::numeric_limits<double>::infinity();
  int best_axis = -1, best_cut = 0;
  const auto bucket_of = [&](const Item& item, int axis) {
    const float low = component(centres.low, axis), high = component(centres.high, axis);
    const float share = (component(item.bound.box.centre(), axis) - low) / (high - low);
    return std::clamp(static_cast<int>(share * kBuckets), 0, kBuckets - 1);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!(component(centres.high, axis) > component(centres.low, axis))) continue;
    std::array<Bound, kBuckets> buckets{}, from_right{};
    for (std::size_t i = begin; i < end; ++i) {
      Bound& bucket = buckets[static_cast<std::size_t>(bucket_of(items[i], axis))];
      bucket = joined(bucket, items[i].bound);
    }
    from_right[kBuckets - 1] = buckets[kBuckets - 1];
    for (std::size_t b = kBuckets - 1; b-- > 0;) from_right[b] = joined(buckets[b], from_right[b + 1]);
    Bound left;
    for (int cut = 1; cut < kBuckets; ++cut) {
      left = joined(left, buckets[static_cast<std::size_t>(cut - 1)]);
      const Bound& right = from_right[static_cast<std::size_t>(cut)];
      if (left.flux == 0 || right.flux == 0) continue;
      const float side = component(sides, axis);
      const double sum = cost(left, longest, side) + cost(right, longest, side);
      if (sum < best_cost) best_cost = sum, best_axis = axis, best_cut = cut;
    }
  }
  const auto first = items.begin() + static_cast<std::ptrdiff_t>(begin),
             last = items.begin() + static_cast<std::ptrdiff_t>(end);
  if (best_axis >= 0) {
    const auto middle =
        std::partition(first, last, [&](const Item& item) { return bucket_of(item, best_axis) < best_cut; });
    if (middle != first && middle != last) return static_cast<std::size_t>(middle - items.begin());
  }
  return (begin + end) / 2;
}

std::uint32_t ConeTreeSampler::build(std::vector<Item>& items, std::size_t begin, std::size_t end, std::uint64_t trail,
                                     std::uint32_t depth) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (end - begin == 1) {
    nodes_[index].bound = items[begin].bound, nodes_[index].light = items[begin].light;
    trail_[items[begin].light] = trail;
    return index;
  }
  Bound bound;
  for (std::size_t i = begin; i < end; ++i) bound = joined(bound, items[i].bound);
  nodes_[index].bound = bound;
  // Deep down the trail's bits must suffice, whatever the costs say.
  const std::size_t middle = depth < 32 ? split(items, begin, end, bound) : (begin + end) / 2;
  build(items, begin, middle, trail, depth + 1);
  nodes_[index].second_child = build(items, middle, end, trail | (std::uint64_t(1) << depth), depth + 1);
  return index;
}

ConeTreeSampler::ConeTreeSampler(const LightSet& lights, const Scene& scene) : trail_(lights.size()) {
  std::vector<Item> items;
  for (std::uint32_t i = 0; i < lights.size(); ++i) items.push_back({bound_of(lights.records()[i], scene), i});
  nodes_.reserve(2 * items.size());
  if (!items.empty()) build(items, 0, items.size(), 0, 0);
}

// An upper bound, roughly, of what the node sends to the receiver.   Sect. 5.2
float ConeTreeSampler::importance(const Bound& bound, const Receiver& receiver) {
  const Vec3 centre = bound.box.centre(), position = vector(receiver.position);
  const Vec3 half = bound.box.high - centre, apart = centre - position;
  const float radius_sq = dot(half, half), distance_sq = dot(apart, apart);
  const Vec3 to_light = distance_sq > 0 ? apart * (1 / std::sqrt(distance_sq)) : Vec3(0, 0, 1);
  // The cone in which the box is seen.
  const float sin_box_sq = distance_sq > radius_sq ? radius_sq / distance_sq : 2.0f;
  const float cos_box = sin_box_sq > 1 ? -1.0f : std::sqrt(1 - sin_box_sq), sin_box = sine_of(cos_box);
  float cos_axis = -dot(bound.normals.axis, to_light);
  if (bound.two_sided > 0) cos_axis = std::abs(cos_axis);
  const float cos_o = bound.normals.cos_angle, sin_o = sine_of(cos_o), sin_axis = sine_of(cos_axis);
  const float cos_x = cos_of_difference(cos_axis, sin_axis, cos_o, sin_o);
  const float sin_x = sin_of_difference(cos_axis, sin_axis, cos_o, sin_o);
  const float cos_least = cos_of_difference(cos_x, sin_x, cos_box, sin_box);
  if (cos_least <= bound.cos_emission) return 0;
  const float cos_surface = dot(to_light, vector(receiver.shading_normal));
  const float cos_highest = cos_of_difference(cos_surface, sine_of(cos_surface), cos_box, sin_box);
  return bound.flux * cos_least * std::max(cos_highest, 0.0f) / std::max({distance_sq, radius_sq, 1e-20f});
}

ChosenLight ConeTreeSampler::choose(const Receiver& receiver, Candidates&, double u, ChoiceMemory&) const {
  if (nodes_.empty()) return {};
  ChosenLight chosen{kNoLight, 1, 0};
  std::uint32_t at = 0;
  while (nodes_[at].second_child != 0) {
    const std::uint32_t children[2] = {at + 1, nodes_[at].second_child};
    const float first = importance(nodes_[children[0]].bound, receiver);
    const float second = importance(nodes_[children[1]].bound, receiver);
    chosen.weighed += 2;
    if (!(first + second > 0)) return {kNoLight, 0, chosen.weighed};
    const double share = double(first) / (double(first) + second);
    if (u < share) {
      at = children[0], u /= share, chosen.pmf *= static_cast<float>(share);
    } else {
      at = children[1], u = (u - share) / (1 - share), chosen.pmf *= static_cast<float>(1 - share);
    }
  }
  if (at == 0 && !(importance(nodes_[0].bound, receiver) > 0)) return {};
  chosen.light = nodes_[at].light;
  return chosen;
}

float ConeTreeSampler::assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory&,
                                   const LightPlace&, std::uint32_t) const {
  float pmf = 1;
  std::uint32_t at = 0;
  for (std::uint64_t trail = trail_[light]; nodes_[at].second_child != 0; trail >>= 1u) {
    const std::uint32_t children[2] = {at + 1, nodes_[at].second_child};
    const float first = importance(nodes_[children[0]].bound, receiver);
    const float second = importance(nodes_[children[1]].bound, receiver);
    if (!(first + second > 0)) return 0;
    const double share = double(first) / (double(first) + second);
    at = children[trail & 1u];
    pmf *= static_cast<float>((trail & 1u) != 0 ? 1 - share : share);
  }
  return pmf;
}

std::uint64_t ConeTreeSampler::memory_bytes() const {
  return nodes_.size() * sizeof(Node) + trail_.size() * sizeof(std::uint64_t);
}

}  // namespace luciole
