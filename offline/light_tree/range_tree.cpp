// SPDX-License-Identifier: Apache-2.0
#include "offline/light_tree/range_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "equations/cpp/float.h"

namespace luciole {
namespace {

constexpr std::uint32_t kDimensionRange = 33, kDimensionShift = 34;
constexpr std::size_t kChunk = 16384;   // lights per unit of work
constexpr float kEverywhere = 1e18f;    // radius of what is everywhere [m]; its square is a float
constexpr float kMostScenes = 16;       // ranges beyond so many scenes are everywhere
constexpr float kRounding = 1 + 1e-5f;  // spheres grow by it, so that rounding loses no light

std::size_t chunk_count(std::size_t lights) { return (lights + kChunk - 1) / kChunk; }

template <class Body>
void for_each_chunk(std::size_t lights, const Body& body) {
  parallel_for(chunk_count(lights), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      body(chunk, chunk * kChunk, std::min(lights, (chunk + 1) * kChunk));
    }
  });
}

}  // namespace

RangeTree::RangeTree(const LightSet& lights, float scene_diagonal)
    : lights_(&lights), scene_diagonal_(std::max(scene_diagonal, 1e-20f)), xi_(lights.size(), 1.0f) {
  smallest_exponent_ = std::ilogb(scene_diagonal_ * kMostScenes) - (kOctaves - 1);
  if (lights.size() == 0) return;
  // Each octave starts a new block.
  std::uint32_t blocks = (lights.size() + kBlockSpheres - 1) / kBlockSpheres + kOctaves;
  light_.resize(std::size_t(blocks) * kBlockSpheres);
  std::uint32_t total = 0;
  do {
    first_block_[levels_] = total, total += blocks;
    blocks = (blocks + kBlockSpheres - 1) / kBlockSpheres;
    ++levels_;
  } while (total - first_block_[levels_ - 1] > 1);
  blocks_.resize(total);
}

float RangeTree::range_of(std::uint32_t light) const {
  return std::sqrt(f32::directional_range_sq(lights_->records()[light].intensity, radiance_floor_, xi_[light]));
}

RangeTree::Sphere RangeTree::sphere_of(std::uint32_t light) const {
  const LightRecord& record = lights_->records()[light];
  const float range = range_of(light);
  if (!(range < scene_diagonal_ * kMostScenes)) return {record.centre(), kEverywhere * kEverywhere};
  const float radius = (range * record.reach_radius + record.radius) * kRounding;
  return {record.centre() + record.axis() * (range * record.reach_offset), radius * radius};
}

int RangeTree::octave_of(std::uint32_t light) const {
  const float range = std::min(range_of(light), scene_diagonal_ * kMostScenes);
  return kOctaves - 1 - std::clamp(std::ilogb(range) - smallest_exponent_, 0, kOctaves - 1);  // the largest first
}

bool RangeTree::overlaps(std::uint32_t light, Vec3 point) const {
  const Sphere sphere = sphere_of(light);
  const Vec3 apart = point - sphere.centre;
  return dot(apart, apart) < sphere.reach_sq;
}

void RangeTree::draw(std::uint64_t seed, std::uint64_t pass, RangeNumbers numbers, float radiance_floor) {
  radiance_floor_ = radiance_floor;
  const auto seed_word = static_cast<std::uint32_t>(seed ^ (seed >> 32u)), pass_word = static_cast<std::uint32_t>(pass);
  const std::uint32_t shift = f32::random_words(seed_word, pass_word, 0, kDimensionShift).first;
  parallel_for(xi_.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto light = static_cast<std::uint32_t>(i);
      xi_[i] = f32::unit_real(numbers == RangeNumbers::stratified
                                  ? f32::stratified_bits(light, shift)
                                  : f32::random_words(seed_word, pass_word, light, kDimensionRange).first);
    }
  });
  rebuild();
}

void RangeTree::clamp_all(float xi, float radiance_floor) {
  radiance_floor_ = radiance_floor;
  std::fill(xi_.begin(), xi_.end(), xi);
  rebuild();
}

void RangeTree::rebuild() {
  if (levels_ == 0) return;
  deal();
  for (std::uint32_t level = 1; level < levels_; ++level) build_level(level);
}

// Counts each chunk's lights per octave, then writes every light to its place: the order within an octave is the
// curve's.
void RangeTree::deal() {
  const std::size_t lights = xi_.size();
  using Places = std::array<std::uint32_t, kOctaves>;
  std::vector<Places> places(chunk_count(lights), Places{});
  for_each_chunk(lights, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      ++places[chunk][static_cast<std::size_t>(octave_of(static_cast<std::uint32_t>(i)))];
    }
  });
  std::uint32_t next = 0;
  for (std::size_t octave = 0; octave < kOctaves; ++octave) {
    for (Places& chunk : places) {
      const std::uint32_t count = chunk[octave];
      chunk[octave] = next, next += count;
    }
    for (; next % kBlockSpheres != 0; ++next) blocks_[next / kBlockSpheres].reach_sq[next % kBlockSpheres] = -1;
  }
  block_count_[0] = next / kBlockSpheres;
  for_each_chunk(lights, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto light = static_cast<std::uint32_t>(i);
      const std::uint32_t place = places[chunk][static_cast<std::size_t>(octave_of(light))]++;
      const Sphere sphere = sphere_of(light);
      SphereBlock& block = blocks_[place / kBlockSpheres];
      const std::uint32_t lane = place % kBlockSpheres;
      block.x[lane] = sphere.centre.x, block.y[lane] = sphere.centre.y, block.z[lane] = sphere.centre.z;
      block.reach_sq[lane] = sphere.reach_sq;
      light_[place] = light;
    }
  });
}

// A sphere round each block of the level below: at the middle of its centres' box.
void RangeTree::build_level(std::uint32_t level) {
  const SphereBlock* below = blocks_.data() + first_block_[level - 1];
  SphereBlock* above = blocks_.data() + first_block_[level];
  const std::uint32_t children = block_count_[level - 1];
  block_count_[level] = (children + kBlockSpheres - 1) / kBlockSpheres;
  parallel_for(block_count_[level], 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t child = begin * kBlockSpheres; child < end * kBlockSpheres; ++child) {
      SphereBlock& block = above[child / kBlockSpheres];
      const std::size_t lane = child % kBlockSpheres;
      block.x[lane] = block.y[lane] = block.z[lane] = 0, block.reach_sq[lane] = -1;
      if (child >= children) continue;
      const SphereBlock& held = below[child];
      Bounds box;
      for (std::uint32_t k = 0; k < kBlockSpheres; ++k) {
        if (held.reach_sq[k] >= 0) box.grow({held.x[k], held.y[k], held.z[k]});
      }
      const Vec3 centre = box.centre();
      float radius = -1;
      for (std::uint32_t k = 0; k < kBlockSpheres; ++k) {
        if (held.reach_sq[k] < 0) continue;
        radius = std::max(radius, length(Vec3(held.x[k], held.y[k], held.z[k]) - centre) + std::sqrt(held.reach_sq[k]));
      }
      block.x[lane] = centre.x, block.y[lane] = centre.y, block.z[lane] = centre.z;
      block.reach_sq[lane] = radius * radius * kRounding;
    }
  });
}

SphereTree RangeTree::tree() const {
  SphereTree tree;
  tree.blocks = blocks_.data(), tree.light = light_.data(), tree.levels = levels_;
  std::copy(std::begin(first_block_), std::end(first_block_), std::begin(tree.first_block));
  return tree;
}

std::uint64_t RangeTree::memory_bytes() const {
  return xi_.size() * sizeof(float) + light_.size() * sizeof(std::uint32_t) + blocks_.size() * sizeof(SphereBlock);
}

}  // namespace luciole
