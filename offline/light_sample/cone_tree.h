// SPDX-License-Identifier: Apache-2.0
// The strongest rival: a binary tree of lights whose nodes bound position, orientation and flux, walked from the root
// with one random number.
//   A. Conty Estevez, C. Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", PACM CGIT 1(2),
//   2018.
#pragma once
#include <cstdint>
#include <vector>

#include "offline/light_sample/light_sampler.h"
#include "scene/scene.h"

namespace luciole {

// Directions that lie within an angle of an axis.
struct DirectionCone {
  Vec3 axis{0, 0, 1};
  float cos_angle = 1;  // -1: all directions
};

class ConeTreeSampler final : public LightSampler {
 public:
  ConeTreeSampler(const LightSet& lights, const Scene& scene);

  ChosenLight choose(const Receiver& receiver, Candidates& candidates, double u, ChoiceMemory& memory) const override;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t random) const override;
  std::uint64_t memory_bytes() const override;

 private:
  struct Bound {
    Bounds box;
    DirectionCone normals;   // Conty and Kulla's theta_o
    float cos_emission = 0;  // theta_e: light leaves within this angle of a normal
    float flux = 0;
    float two_sided = 0;
  };
  struct Node {
    Bound bound;
    std::uint32_t second_child = 0;  // the first follows its parent; 0: a leaf
    std::uint32_t light = kNoLight;  // of a leaf
  };
  struct Item {
    Bound bound;
    std::uint32_t light;
  };
  static constexpr std::uint32_t kDeepest = 63;

  static Bound bound_of(const LightRecord& light, const Scene& scene);
  static Bound joined(const Bound& a, const Bound& b);
  static double cost(const Bound& bound, float longest_side, float side);
  static float importance(const Bound& bound, const Receiver& receiver);
  std::size_t split(std::vector<Item>& items, std::size_t begin, std::size_t end, const Bound& bound) const;
  std::uint32_t build(std::vector<Item>& items, std::size_t begin, std::size_t end, std::uint64_t trail,
                      std::uint32_t depth);

  std::vector<Node> nodes_;
  std::vector<std::uint64_t> trail_;  // by light: bit d says which child its path takes at depth d
};

}  // namespace luciole
