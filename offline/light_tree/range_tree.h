// SPDX-License-Identifier: Apache-2.0
// The ranges of all lights in one pass, and the tree of bounding spheres that finds those that overlap a point.
//                                                                                    [TH16] sect. 5.2, Eqs. 3 and 7
//
// A light's order along a curve through space is made once. Ranges have a heavy tail, so that a tree over that order
// alone would have giants in most branches: each pass stably deals the lights into octaves of range, the largest first,
// and the tree stands on the dealt order. So a node holds lights of like range that are near each other, and one pass
// costs a few operations per light. Lights that reach further than sixteen scenes are everywhere.
#pragma once
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "base/isa.h"
#include "offline/light_set/light_set.h"
#include "offline/light_tree/overlap_kernel.h"
#include "offline/settings.h"

namespace luciole {

class RangeTree {
 public:
  RangeTree() = default;
  // lights must outlive the tree.
  //   scene_diagonal  [m]
  RangeTree(const LightSet& lights, float scene_diagonal);

  // Draws new ranges. A light of intensity I overlaps a point at distance l with probability
  // p = min(I s / (radiance_floor l^2), 1), s its directional factor.   [TH17] Eq. 2, [TH16] Eq. 1
  //   radiance_floor  delta / E: light below it is subject to roulette   [W/(m^2 sr)]  > 0
  void draw(std::uint64_t seed, std::uint64_t pass, RangeNumbers numbers, float radiance_floor);
  // The rival: the same xi for every light and pass.
  void clamp_all(float xi, float radiance_floor);

  SphereTree tree() const;
  // Calls use(light) for each light whose range of this pass touches the box.
  template <class Use>
  void for_each_overlapping(const WalkBounds& bounds, Isa isa, const Use& use) const {
    constexpr std::uint32_t kChunk = 256;
    std::uint32_t lights[kChunk];
    const SphereTree spheres = tree();
    for (TreeWalk walk(spheres); !walk.done();) {
      const std::uint32_t found = LUCIOLE_FOR_ISA(isa, overlapping_lights(spheres, bounds, walk, lights, kChunk));
      for (std::uint32_t i = 0; i < found; ++i) use(lights[i]);
    }
  }
  std::uint32_t block_count() const { return block_count_[0]; }  // of level 0
  // Before this block of level 0 all lights have ranges of at least `range`, from it on less than twice that.
  std::uint32_t first_block_below(float range) const;
  float xi(std::uint32_t light) const { return xi_[light]; }
  const float* xi() const { return xi_.data(); }
  std::uint64_t memory_bytes() const;

 private:
  static constexpr int kOctaves = 32;
  struct Sphere {
    Vec3 centre;
    float reach_sq;
  };
  Sphere sphere_of(std::uint32_t light) const;
  int octave_of(std::uint32_t light) const;
  float range_of(std::uint32_t light) const;
  void rebuild();
  void deal();
  void build_level(std::uint32_t level);

  const LightSet* lights_ = nullptr;
  float scene_diagonal_ = 0, radiance_floor_ = 0;
  int smallest_exponent_ = 0;                // of the last octave
  std::uint32_t octave_end_[kOctaves] = {};  // in blocks of level 0
  std::vector<float> xi_;
  std::vector<std::uint32_t> light_;  // by sphere of level 0
  AlignedVector<SphereBlock> spheres_;
  AlignedVector<NodeBlock> nodes_;
  std::uint32_t levels_ = 0, first_block_[SphereTree::kMostLevels] = {}, block_count_[SphereTree::kMostLevels] = {};
};

}  // namespace luciole
