// SPDX-License-Identifier: Apache-2.0
// One interface for all ways to choose the light that a shadow ray goes to. Everything else of the path tracer is the
// same for all of them, so that they can be compared.
#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "offline/light_sample/light_rows.h"
#include "offline/light_sample/weigh_kernel.h"
#include "offline/settings.h"

namespace luciole {

// What a choice leaves behind for the multiple importance sampling of the ray that the BSDF samples next.
struct ChoiceMemory {
  static constexpr std::uint32_t kMostListed = 32;  // as settings.cpp allows
  float total_weight = 0;                           // of all lights that were weighed
  std::uint32_t overlapping = 0;                    // m: lights that overlapped; only of lists
  std::uint32_t listed = 0;                         // of them in the list
  std::array<std::uint32_t, kMostListed> light;
  std::array<float, kMostListed> weight;
};

struct ChosenLight {
  std::uint32_t light = kNoLight;  // kNoLight: the estimate of this point is 0
  float pmf = 0;                   // probability of the choice, given that the light overlaps
  std::uint32_t weighed = 0;       // lights that were looked at
  // Sum over all weighed lights of weight * tint, less that as it would be if all had the chosen one's: 0 on average
  // over the choice, and about what the colour of one light says wrongly of all. 0 where a sampler does not weigh all.
  Vec3 colour_apart{0, 0, 0};
};

// A point on a light, as its sampler needs it to be known.
struct LightPlace {
  float distance_sq;  // from the receiver [m^2]
  float factor;       // directional factor s towards the receiver, mean over a lamp's or triangle's texture
};

// Memory for the lights that a receiver may choose: first those that it shares, then its own.
struct Candidates {
  LightRows rows;
  std::uint32_t shared = 0;           // rows
  std::uint32_t first_own_block = 0;  // of the range tree's level 0: from here on each receiver looks for itself
};

class LightSampler {
 public:
  virtual ~LightSampler() = default;

  // Draws what is random per pass. No other function changes anything.
  virtual void begin_pass(std::uint64_t /*pass*/) {}

  // What receivers that lie near each other share: lights that some of them may choose. Which receivers come together
  // changes the cost, never the choice.
  virtual void share_candidates(const Receiver* /*receivers*/, std::uint32_t /*count*/, Candidates&) const {}

  // candidates: shared by a group that the receiver belongs to; u: a number in [0,1).
  virtual ChosenLight choose(const Receiver& receiver, Candidates& candidates, double u,
                             ChoiceMemory& memory) const = 0;

  // Probability that the place of a light is in reach, for every random range of the light; 0 where this pass's range
  // ends before it. A sample's density is pmf * acceptance * density of the place on the light.   [TH16] Eq. 10
  virtual float acceptance(std::uint32_t /*light*/, const LightPlace&) const { return 1; }

  // The factor pmf * acceptance that both techniques' weights assume for a place on `light`. It must have the same law
  // whether the place was found by a shadow ray or by the BSDF: docs/mathematics.md, "Combining with BSDF sampling".
  //   random  32 bits, for lists
  virtual float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory,
                            const LightPlace& place, std::uint32_t random) const = 0;

  virtual std::uint64_t memory_bytes() const { return 0; }
  // [TH16] eps_max as chosen; 0 for samplers without ranges.
  virtual float error_bound() const { return 0; }
};

}  // namespace luciole
