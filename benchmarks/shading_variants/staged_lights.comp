// SPDX-License-Identifier: Apache-2.0
// All invocations together copy the next lights of both lists to shared memory; then each pixel reads them there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "benchmarks/shading_variants/variant.glsl"
#include "real_time/shading/emitter_words.glsl"

const uint kStage = 64u;                    // lights of a list at a time: 16 KiB
shared float staged[2][kStage * 32u];       // 32: the words of the largest emitter

void stage(uint half_of_tile, SubsetRange subset, uint first, uint end) {
  for (uint i = thread(); i < (end - first) * kEmitterWords; i += kThreads) {
    const uint entry = subset.begin + listed[half_of_tile][first + i / kEmitterWords];
    staged[half_of_tile][i] = Words(push.emitters).value[entry * kEmitterWords + i % kEmitterWords];
  }
}

void shade_staged(inout ShadedPixel shaded, TilePixel pixel, TileHalves halves, SubsetRange subset, uint counts[2]) {
  const uint length[2] = uint[2](halves.pixels[0] > 0u ? counts[0] : 0u, halves.pixels[1] > 0u ? counts[1] : 0u);
  const uint own = halves.half_of_pixel;
  for (uint first = 0u; first < max(length[0], length[1]); first += kStage) {
    for (uint h = 0u; h < 2u; ++h) stage(h, subset, min(first, length[h]), min(first + kStage, length[h]));
    barrier();
    const uint end = pixel.is_surface ? min(first + kStage, length[own]) : 0u;
    for (uint i = first; i < end; ++i) {
      float w[kMostUsed];
      for (uint k = 0u; k < kMostUsed; ++k) w[k] = k < kUsedWords ? staged[own][(i - first) * kEmitterWords + k] : 0.0;
      add_light_of_words(shaded, w);
    }
    barrier();
  }
}

#define SHADE_LIGHTS shade_staged
#include "real_time/shading/tile_loop.glsl"

void main() {
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  shade_tile(gl_WorkGroupID, gl_NumWorkGroups, pixel, halve(pixel));
}
