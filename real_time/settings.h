// SPDX-License-Identifier: Apache-2.0
// Every switch of the real-time frame, with what it buys. Saved into each picture and into the statistics.
#pragma once
#include <cstdint>
#include <string>

#include "base/isa.h"

namespace luciole {

// Which volume encloses the part of space that a light reaches this frame.
enum class BoundingVolume : std::uint8_t {
  sphere_at_light,  // [TH17] Fig. 9 a: around the light, the lobe's largest intensity in every direction
  sphere,           // [TH17] Fig. 9 b: the smallest sphere around the spheroid
  spheroid,         // [TH17] Eqs. 12-15
  tight             // our ellipsoid: also knows Fresnel, masking and the lobe's squeeze at grazing incidence
};
enum class TileTest : std::uint8_t {
  paper,  // [TH17] Eqs. 16-17 with Modified HalfZ; clusters and splats of the proxies alone
  exact,  // ellipsoid against frustum without slack: the measure of the others, slow
  tight   // triangular factor, side planes, below-surface plane; of these splats take the last
};
enum class Culling : std::uint8_t {
  tiled,      // each tile asks all lights, [TH17] sect. 5
  clustered,  // each light asks for its clusters: conservative rasterisation, Örtegren and Persson 2016
  splatting,  // each light asks for its pixels: Dachsbacher and Stamminger 2006
  none        // all lights everywhere
};
enum class Ranges : std::uint8_t {
  stochastic,     // one random number per light and frame; exact in the mean
  clamped,        // one constant for all lights that accepts as many as stochastic ones: what engines do; too dark
  clamped_bound,  // [TH16] Appendix A: a constant range from the error bound; too dark
  infinite        // every light everywhere, no roulette: the reference
};
enum class Lobes : std::uint8_t {
  all,      // each virtual point light scatters evenly and reflects
  diffuse,  // only what it scatters evenly: [TH16], and the upper half of [TH17] Table 2
  glossy    // only what it reflects: [TH17] Figs. 9 and 10, and the lower half of Table 2
};
enum class NearField : std::uint8_t {
  disc,  // 1/(l^2 + A/pi): the texel's area softens the singularity; a bias near surfaces, docs/noise_and_bias.md
  point  // 1/l^2
};
enum class Filter : std::uint8_t { bilateral, none };
enum class Engine : std::uint8_t {
  cpu,       // needs no driver; the same picture everywhere
  vulkan,    // a Vulkan device
  automatic  // Vulkan where there is a device in hardware that can do the settings, else the CPU
};

// With the Vulkan engine: what makes geometry buffer, virtual point lights and direct light.
enum class Front : std::uint8_t {
  automatic,  // raster on a GPU, or rays where it has no rasteriser; the CPU for software Vulkan, which traces slowly
  cpu,        // the CPU engine's passes, whose output is sent
  raster,     // the device: pixels by rasterisation, lights and shadows by a ray caster in compute shaders
  rays        // the device: all by the ray caster
};

struct Settings {
  std::uint32_t width = 1280, height = 720;  // [pixels]
  std::uint32_t vpls = 65536;                // total over all primary lights, >= 1
  BoundingVolume bounds = BoundingVolume::tight;
  TileTest tile_test = TileTest::tight;
  Culling culling = Culling::tiled;
  Ranges ranges = Ranges::stochastic;
  Lobes lobes = Lobes::all;
  NearField near_field = NearField::disc;
  Filter filter = Filter::bilateral;
  std::uint32_t interleave = 8;  // 1, 2, 4 or 8: pixels split into n*n sub-regions, each sees 1/(n*n) of the lights
  float delta = 0.001f;   // [TH17] Eq. 2, display units: p = min(E I / (delta l^2), 1); larger is faster, noisier
  float exposure = 1.0f;  // E: display value per radiance
  bool stratified_ranges = false;  // random numbers stratified over the lights: steadier; independent ones else
  bool direct_shadows = false;     // one shadow ray per accepted punctual or emissive light
  std::uint32_t temporal = 1;      // frames that a pixel's light is averaged over, following the camera; 1: none
  bool jitter = false;             // camera samples and VPLs move per frame
  std::uint64_t seed = 1;          // moves ranges and interleaving only
  std::uint64_t vpl_seed = 0;      // 0: VPLs at texel centres; else jittered within the texel
  Isa isa = Isa::automatic;
  Engine engine = Engine::cpu;
  std::string device;              // of the Vulkan engine: index or part of the name; empty: the best there is
  Front front = Front::automatic;  // likewise
  bool vulkan_validation = false;  // whatever the validation layers say fails the run
  // For tests of a device's loss, without a name: gpu::DeviceRequest has it.
  std::uint32_t lost_from_submission = 0;
};

// Names as on the command line ("sphere-at-light", "clamped-bound", ...).
std::string to_string(BoundingVolume);
std::string to_string(TileTest);
std::string to_string(Culling);
std::string to_string(Ranges);
std::string to_string(Lobes);
std::string to_string(NearField);
std::string to_string(Filter);
std::string to_string(Engine);
std::string to_string(Front);

}  // namespace luciole
