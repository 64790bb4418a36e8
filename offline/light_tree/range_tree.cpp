// SPDX-License-Identifier: Apache-2.0
#include "offline/light_tree/range_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/fold_seed.h"
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
  spheres_.resize(blocks);
  std::uint32_t total = 0;
  for (levels_ = 1; blocks > 1; ++levels_) {
    blocks = (blocks + kBlockSpheres - 1) / kBlockSpheres;
    first_block_[levels_] = total, total += blocks;
  }
  nodes_.resize(total);
}

float RangeTree::range_of(std::uint32_t light) const {
  return std::sqrt(f32::directional_range_sq(lights_->records()[light].intensity, radiance_floor_, xi_[light]));
}

RangeTree::Sphere RangeTree::sphere_of(std::uint32_t light) const {
  const LightRecord& record = lights_->records()[light];
  const float range = range_of(light);
  if (!(range < scene_diagonal_ * kMostScenes)) return {record.centre(), kEverywhere * kEverywhere};
  // Not one radius but three: the sphere must hold all that weigh_kernel.cpp takes to be in reach, which is up to
  // (l - radius)^3 / l > l^2 - 3 radius l, so l < 3 radius + range sqrt(s).
  const float radius = (range * record.reach_radius + 3 * record.radius) * kRounding;
  return {record.centre() + record.axis() * (range * record.reach_offset), radius * radius};
}

int RangeTree::octave_of(std::uint32_t light) const {
  const float range = std::min(range_of(light), scene_diagonal_ * kMostScenes);
  return kOctaves - 1 - std::clamp(std::ilogb(range) - smallest_exponent_, 0, kOctaves - 1);  // the largest first
}

void RangeTree::draw(std::uint64_t seed, std::uint64_t pass, RangeNumbers numbers, float radiance_floor) {
  radiance_floor_ = radiance_floor;
  const std::uint32_t seed_word = folded(seed), pass_word = folded(pass);
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
    for (; next % kBlockSpheres != 0; ++next) spheres_[next / kBlockSpheres].reach_sq[next % kBlockSpheres] = -1;
    octave_end_[octave] = next / kBlockSpheres;
  }
  block_count_[0] = next / kBlockSpheres;
  for_each_chunk(lights, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto light = static_cast<std::uint32_t>(i);
      const std::uint32_t place = places[chunk][static_cast<std::size_t>(octave_of(light))]++;
      const Sphere sphere = sphere_of(light);
      SphereBlock& block = spheres_[place / kBlockSpheres];
      const std::uint32_t lane = place % kBlockSpheres;
      block.x[lane] = sphere.centre.x, block.y[lane] = sphere.centre.y, block.z[lane] = sphere.centre.z;
      block.reach_sq[lane] = sphere.reach_sq;
      light_[place] = light;
    }
  });
}

namespace {

struct Node {
  Bounds box;
  float reach_sq = -1;

  void add(Vec3 low, Vec3 high, float other_reach_sq) {
    if (other_reach_sq < 0) return;
    box.grow(low), box.grow(high);
    reach_sq = std::max(reach_sq, other_reach_sq);
  }
};

Node node_round(const SphereBlock& block) {
  Node node;
  for (std::uint32_t k = 0; k < kBlockSpheres; ++k) {
    const Vec3 centre(block.x[k], block.y[k], block.z[k]);
    node.add(centre, centre, block.reach_sq[k]);
  }
  return node;
}

Node node_round(const NodeBlock& block) {
  Node node;
  for (std::uint32_t k = 0; k < kBlockSpheres; ++k) {
    node.add({block.low[0][k], block.low[1][k], block.low[2][k]},
             {block.high[0][k], block.high[1][k], block.high[2][k]}, block.reach_sq[k]);
  }
  return node;
}

}  // namespace

// A node round each block of the level below.
void RangeTree::build_level(std::uint32_t level) {
  NodeBlock* blocks = nodes_.data() + first_block_[level];
  const std::uint32_t children = block_count_[level - 1];
  block_count_[level] = (children + kBlockSpheres - 1) / kBlockSpheres;
  parallel_for(block_count_[level], 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t child = begin * kBlockSpheres; child < end * kBlockSpheres; ++child) {
      Node node;
      if (child < children) {
        node = level == 1 ? node_round(spheres_[child]) : node_round(nodes_[first_block_[level - 1] + child]);
      }
      NodeBlock& block = blocks[child / kBlockSpheres];
      const std::size_t lane = child % kBlockSpheres;
      block.low[0][lane] = node.box.low.x, block.low[1][lane] = node.box.low.y, block.low[2][lane] = node.box.low.z;
      block.high[0][lane] = node.box.high.x, block.high[1][lane] = node.box.high.y;
      block.high[2][lane] = node.box.high.z;
      block.reach_sq[lane] = node.reach_sq;
    }
  });
}

std::uint32_t RangeTree::first_block_below(float range) const {
  // Octaves whose least range is at least `range`; the last one has no least range.
  const int exponent = std::ilogb(std::max(range, 1e-30f)) + 1;
  const int octaves = std::clamp(smallest_exponent_ + kOctaves - exponent, 0, kOctaves - 1);
  return octaves == 0 ? 0 : octave_end_[octaves - 1];
}

SphereTree RangeTree::tree() const {
  SphereTree tree;
  tree.spheres = spheres_.data(), tree.nodes = nodes_.data(), tree.light = light_.data(), tree.levels = levels_;
  std::copy(std::begin(first_block_), std::end(first_block_), std::begin(tree.first_block));
  return tree;
}

std::uint64_t RangeTree::memory_bytes() const {
  return xi_.size() * sizeof(float) + light_.size() * sizeof(std::uint32_t) + spheres_.size() * sizeof(SphereBlock) +
         nodes_.size() * sizeof(NodeBlock);
}

}  // namespace luciole
