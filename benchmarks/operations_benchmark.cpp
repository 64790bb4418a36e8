// SPDX-License-Identifier: Apache-2.0
// What culling and shading must at least do on a device, counted: operations per test, per listed and per accepted pair
// of a light and a pixel, in the order of real_time/shading/shade_tiles.comp, and bytes per pixel and light. Prints
// lines "name number"; benchmarks/gpu.sh makes floors of them.
#include <cstdio>

#include "equations/cpp/counting.h"
#include "real_time/light_range/emitters.h"
#include "real_time/light_range/reaching_lights.h"
#include "real_time/shading/shading_records.h"

namespace luciole {
namespace {

using counting::dot;
using counting::real;
using counting::real3;

// A division or root counts as four operations: so many fewer of them does a GPU do per clock.
constexpr std::uint64_t kSpecial = 4;

template <class Work>
void print(const char* name, const Work& work) {
  counting::counted = {};
  work();
  std::printf("%s %llu\n", name,
              static_cast<unsigned long long>(counting::counted.simple + kSpecial * counting::counted.special));
}

counting::FixedDirectionBrdf a_surface() {
  counting::SurfaceBrdf surface;
  surface.diffuse_albedo = surface.f0 = real3(0.5f, 0.5f, 0.5f);
  surface.f90 = 1.0f, surface.ggx_alpha = 0.3f;
  return fix_direction(surface, real3(0.0f, 0.0f, 1.0f), real3(0.6f, 0.0f, 0.8f));
}

struct Pair {
  real3 to_light{0.0f, 0.6f, 0.8f};
  real l_sq{4.0f}, xi{0.5f};
};

// Distance and direction: the same for every light.
void connect(Pair& pair) {
  const real3 d = real3(1.0f, 2.0f, 3.0f) - real3(0.0f, 0.0f, 0.0f);
  const real distance_sq = dot(d, d);
  pair.to_light = d * inverse_sqrt(max(distance_sq, real(1e-30f)));
  pair.l_sq = distance_sq + real(0.01f);
}

counting::Emitted diffuse_emission(const Pair& pair) {
  return emitted_by_diffuse_lobe(a_surface(), real3(0.0f, 0.0f, 1.0f), real3(1.0f, 1.0f, 1.0f), 1.0f, -pair.to_light);
}
counting::Emitted glossy_emission(const Pair& pair) {
  return emitted_by_glossy_lobe(a_surface(), real3(0.0f, 0.0f, 1.0f), real3(1.0f, 1.0f, 1.0f), 1.0f, -pair.to_light);
}

void accept(const counting::FixedDirectionBrdf& pixel, const counting::Emitted& e, const Pair& pair) {
  if (!(dot(real3(0.0f, 0.0f, 1.0f), pair.to_light) > real(0.0f))) return;
  const real weight = fall_off_over_probability(e, pair.l_sq);
  const real3 arriving = e.colour * (e.factor * weight);
  const counting::Reflection r = reflection(pixel, pair.to_light);
  real3 diffuse, specular;
  diffuse += arriving * r.diffuse;
  specular += arriving * r.specular;
}

void print_operations() {
  const counting::FixedDirectionBrdf surface = a_surface();
  const counting::Tile tile{-0.1f, 0.1f, -0.1f, 0.1f, 1.0f, 2.0f, 2.0f, 3.0f};
  const counting::SidePlanes sides = side_planes(tile);
  counting::TileTestEllipsoid ellipsoid;  // of no extent round the eye, with no surface: passes
  print("sphere_test", [&] { sphere_may_touch(sides, real3(0.0f, 0.0f, 1.5f), 1.0f); });
  print("ellipsoid_test", [&] { ellipsoid_touches_tile(ellipsoid, tile); });
  for (const bool glossy : {false, true}) {
    Pair pair;
    counting::Emitted emitted;
    counting::counted = {};
    (void)a_surface();  // is made once per light, not per pair
    const counting::Operations made_once = counting::counted;
    print(glossy ? "glossy_listed" : "diffuse_listed", [&] {
      connect(pair);
      emitted = glossy ? glossy_emission(pair) : diffuse_emission(pair);
      (void)emission_is_accepted(emitted, pair.l_sq, pair.xi);
      counting::counted.simple -= made_once.simple, counting::counted.special -= made_once.special;
    });
    print(glossy ? "glossy_accepted" : "diffuse_accepted", [&] { accept(surface, emitted, pair); });
  }
}

}  // namespace
}  // namespace luciole

int main() {
  using namespace luciole;
  print_operations();
  // What must be read or written once.
  std::printf("bytes_per_pixel %zu\n", sizeof(PixelRecord));
  std::printf("bytes_per_pixel_and_kind %zu\n", sizeof(PixelSums));
  std::printf("diffuse_bytes_per_light %zu\n", sizeof(DiffuseEmitter) + sizeof(BoundBlock) / 16);
  std::printf("glossy_bytes_per_light %zu\n", sizeof(GlossyEmitter) + sizeof(BoundBlock) / 16);
}
