// SPDX-License-Identifier: Apache-2.0
// Ways to cull and shade on a device. The first two are the engine's (real_time/shading/shade_tiles.comp), which takes
// the one that suits the device; the others are one idea away from the first.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/shading_variants/device_stage.h"

namespace luciole {

// How near to the engine's a variant's sums are, where the driver translates both kernels alike.
enum class Agreement : std::uint8_t {
  bits,
  rounding,       // the same terms in another order
  half_precision  // a factor of each term is rounded to 11 bits
};

struct Variant {
  std::string name;
  std::string what;  // one line
  Agreement agreement = Agreement::bits;
  bool kinds_together = false;  // record() does all kinds of light, whichever it is given
  std::function<void(gpu::CommandList&, LightKind)> record;
};

struct Variants {
  std::vector<Variant> tried;
  std::vector<std::pair<std::string, std::string>> left_out;  // name, and what the device lacks
};

// For a stage with tiled culling by the tight tile test, whose longest subset the device takes in one part; else an
// error. The stage must outlive them.
Result<Variants> make_variants(gpu::Device& device, DeviceStage& stage);

}  // namespace luciole
