// SPDX-License-Identifier: Apache-2.0
// Pass filtering on a Vulkan device: the cross bilateral filter of [TH17] sect. 6, over 16x32 pixels per workgroup. The
// 32x48 pixels that these reach come through shared memory sixteen rows at a time, 48 bytes a pixel, as all of them
// would not fit in the 32 KiB that every device has; and an invocation makes two pixels, one below the other, so that
// what it loads from there serves both. A pixel adds its taps row by row, and rows from top to bottom, so that neither
// the rows staged at once nor the width of subgroups shows in the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "equations/shading_language.h"
#include "real_time/filtering/bilateral_weight.h"
#include "real_time/filtering/demodulation.h"
#include "real_time/filtering/pixel_light.glsl"

const int kThreads = 256;
const int kPixels = kFilterGroupRows * kFilterGroupColumns / kThreads;  // of an invocation, in a column
// A group's pixels and those that they reach.
const int kAcross = kFilterGroupColumns + 2 * kLargestFilterRadius, kDown = kFilterGroupRows + 2 * kLargestFilterRadius;
const int kRows = 16;  // staged at once
layout(local_size_x = 256) in;
layout(constant_id = 0) const int kRadiusX = 8;
layout(constant_id = 1) const int kRadiusY = 8;

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Filtered { PixelLight value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counts { FilterCounts value; };
layout(push_constant, scalar) uniform Push { FilterPush push; };

shared vec4 guides[kRows * kAcross];    // normal, 1/depth [1/m]
shared vec4 diffuse[kRows * kAcross];   // demodulated light; 1 where the surface reflects diffusely, else all are 0
shared vec4 specular[kRows * kAcross];  // demodulated light, alpha

Light noisy_light(uint index) { return noisy_light(push.sums, push.more_sums, push.weight, index); }

bool is_on_screen(ivec2 pixel) {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < int(push.width) && pixel.y < int(push.height);
}
uint index_of(ivec2 pixel) { return uint(pixel.y) * push.width + uint(pixel.x); }

void stage_pixel(int at, ivec2 pixel) {
  guides[at] = vec4(0.0, 0.0, 0.0, kNoInverseDepth);
  diffuse[at] = specular[at] = vec4(0.0);
  if (!is_on_screen(pixel)) return;
  const PixelRecord record = Pixels(push.pixels).value[index_of(pixel)];
  if (!is_finite(record.depth)) return;  // the sky
  const Light light = noisy_light(index_of(pixel));
  if (!is_finite(light)) return;
  const Demodulation d = demodulation(vector(record.f0));
  guides[at] = vec4(vector(record.normal), 1.0 / record.depth);
  if (d.reflects_diffusely) diffuse[at] = vec4(light.diffuse / d.diffuse, 1.0);
  specular[at] = vec4(light.specular / d.specular, record.ggx_alpha);
}

// Rows from `first` on of what the group reaches, whose top left pixel is `corner`.
void stage_rows(ivec2 corner, int first) {
  for (int at = int(gl_LocalInvocationIndex); at < kRows * kAcross; at += kThreads) {
    stage_pixel(at, corner + ivec2(at % kAcross, first + at / kAcross));
  }
}

FilterCentre centre_of(PixelRecord record, ivec2 pixel) {
  const vec3 right = vector(push.right), up = vector(push.up);
  const float across = (float(pixel.x) + push.left_edge) * push.footprint;
  const float below = (float(pixel.y) + push.top_edge) * push.footprint;
  const vec3 ray = vector(push.forward) + right * across - up * below;
  return filter_centre(vector(record.normal), vector(record.geometric_normal), record.ggx_alpha, record.depth, ray,
                       right, up, push.footprint);
}

// Weighted light, and in w the weights.
struct WeightedSums {
  vec4 diffuse, specular;
};
const WeightedSums kNothing = WeightedSums(vec4(0.0), vec4(0.0));

struct Centre {
  FilterCentre pixel;
  float row_offset;  // of the row that is added
};

// Adds the staged pixel `at`, which lies `right` pixels to the right of the centres.
void add_tap(inout WeightedSums sums[kPixels], Centre centres[kPixels], int right, int at, float scale) {
  const vec4 guide = guides[at], diffuse_there = diffuse[at], specular_there = specular[at];
  for (int i = 0; i < kPixels; ++i) {
    const TapWeight w = tap_weight(centres[i].pixel, centres[i].row_offset, float(right), guide.w, guide.xyz,
                                   specular_there.w);
    sums[i].diffuse += (w.diffuse * scale) * diffuse_there;
    sums[i].specular += (w.specular * scale) * vec4(specular_there.xyz, 1.0);
  }
}

// All taps of one staged row; `at` is the one in the centres' column. The outermost weigh a half.
WeightedSums[kPixels] row_sums(Centre centres[kPixels], int at) {
  WeightedSums sums[kPixels];
  for (int i = 0; i < kPixels; ++i) sums[i] = kNothing;
  if (kRadiusX > 0) add_tap(sums, centres, -kRadiusX, at - kRadiusX, 0.5);
  const int inner = max(kRadiusX - 1, 0);
  for (int right = -inner; right <= inner; ++right) add_tap(sums, centres, right, at + right, 1.0);
  if (kRadiusX > 0) add_tap(sums, centres, kRadiusX, at + kRadiusX, 0.5);
  return sums;
}

// Adds the staged rows from `first` on that the invocation's pixels reach, the first of which is in `place`.
void add_rows(inout WeightedSums sums[kPixels], inout Centre centres[kPixels], ivec2 place, int first) {
  const int own = place.y + kLargestFilterRadius, column = place.x + kLargestFilterRadius;
  const int end = min(own + kPixels + kRadiusY, first + kRows);
  for (int row = max(own - kRadiusY, first); row < end; ++row) {
    for (int i = 0; i < kPixels; ++i)
      centres[i].row_offset = plane_offset_of_row(centres[i].pixel, float(row - own - i));
    const WeightedSums of_row[kPixels] = row_sums(centres, (row - first) * kAcross + column);
    for (int i = 0; i < kPixels; ++i) {
      const int down = abs(row - own - i);
      if (down > kRadiusY) continue;  // the other pixel's
      const float scale = kRadiusY > 0 && down == kRadiusY ? 0.5 : 1.0;
      sums[i].diffuse += scale * of_row[i].diffuse;
      sums[i].specular += scale * of_row[i].specular;
    }
  }
}

// Means from sums, modulated again. A pixel that nothing is like keeps what it has.
PixelLight mean_light(WeightedSums sums, PixelRecord record, Light own) {
  const Demodulation d = demodulation(vector(record.f0));
  Light light = own;
  if (sums.diffuse.w > 0.0) light.diffuse = sums.diffuse.xyz / sums.diffuse.w * d.diffuse;
  if (sums.specular.w > 0.0) light.specular = sums.specular.xyz / sums.specular.w * d.specular;
  return PixelLight(numbers(light.diffuse), numbers(light.specular));
}

void write_pixel(ivec2 pixel, WeightedSums sums) {
  if (!is_on_screen(pixel)) return;
  const uint index = index_of(pixel);
  const PixelRecord record = Pixels(push.pixels).value[index];
  PixelLight light = PixelLight(numbers(vec3(0.0)), numbers(vec3(0.0)));
  if (is_finite(record.depth)) {
    const Light own = noisy_light(index);
    if (!is_finite(own)) atomicAdd(Counts(push.counts).value.not_finite, 1u);
    light = mean_light(sums, record, own);
  }
  Filtered(push.filtered).value[index] = light;
}

void main() {
  const int thread = int(gl_LocalInvocationIndex);
  const ivec2 place = ivec2(thread % kFilterGroupColumns, thread / kFilterGroupColumns * kPixels);
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * ivec2(kFilterGroupColumns, kFilterGroupRows);
  bool any_surface = false;
  Centre centres[kPixels];
  WeightedSums sums[kPixels];
  for (int i = 0; i < kPixels; ++i) {
    const ivec2 pixel = corner + place + ivec2(0, i);
    const PixelRecord record = Pixels(push.pixels).value[is_on_screen(pixel) ? index_of(pixel) : 0u];
    any_surface = any_surface || (is_on_screen(pixel) && is_finite(record.depth));
    centres[i].pixel = centre_of(record, pixel);
    sums[i] = kNothing;
  }
  for (int first = 0; first < kDown; first += kRows) {
    stage_rows(corner - kLargestFilterRadius, first);
    barrier();
    if (any_surface) add_rows(sums, centres, place, first);
    barrier();  // the next rows take the place of these
  }
  for (int i = 0; i < kPixels; ++i) write_pixel(corner + place + ivec2(0, i), sums[i]);
}
