// SPDX-License-Identifier: Apache-2.0
// Pass temporal accumulation on a Vulkan device: each pixel finds the surface that it sees in the frame before and goes
// on from the mean that was reached there. The text follows temporal_accumulation.cpp; the rules are reprojection.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "equations/shading_language.h"
#include "real_time/filtering/accumulation_records.h"
#include "real_time/filtering/pixel_light.glsl"
#include "real_time/filtering/reprojection.h"
#include "real_time/geometry_buffer/geometry_records.h"

layout(local_size_x = kAccumulationGroupColumns, local_size_y = kAccumulationGroupRows) in;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Frame { AccumulationFrame value; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Surfaces { SurfaceRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PastSurfaces { PastSurfaceRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Means { PixelSums value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Floats { float value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counts { AccumulationCounts value; };
layout(push_constant, scalar) uniform Push { AccumulationPush push; };

const uint kSamePixel = 1u, kSameSurface = 2u, kFourPixels = 3u;  // WayBack

AccumulationFrame frame;  // what the push constants point to

// At most four pixels of the past that saw the surface of a pixel, and their weights, whose sum is 1.
struct Taps {
  uint pixel[4];
  float weight[4];
  int count;
};

PastView past_view() {
  PastView view;
  view.eye = vector(frame.past_eye);
  view.right = vector(frame.past_right);
  view.up = vector(frame.past_up);
  view.forward = vector(frame.past_forward);
  view.pixel_size = frame.past_pixel_size;
  view.width = float(frame.width);
  view.height = float(frame.height);
  view.sub_pixel_x = frame.past_sub_pixel_x;
  view.sub_pixel_y = frame.past_sub_pixel_y;
  return view;
}

void add(inout Taps taps, PastSurfaceRecord seen, uint pixel, float weight, float width_there) {
  const PastSurfaceRecord was = PastSurfaces(frame.past_surfaces).value[pixel];
  if (was.diffuse_frames == 0.0 || was.material != seen.material) return;
  const Likeness like =
      likeness(vector(seen.position), vector(seen.normal), vector(seen.geometric_normal), vector(was.position),
               vector(was.normal), vector(was.geometric_normal));
  if (!is_same_surface(like, width_there)) return;
  taps.pixel[taps.count] = pixel;
  taps.weight[taps.count] = weight;
  ++taps.count;
}

void add_neighbours(inout Taps taps, PastSurfaceRecord seen, PastPlace place) {
  const float w = float(frame.width), h = float(frame.height);
  if (!(place.x > -1.0 && place.x < w && place.y > -1.0 && place.y < h)) return;
  const float left = floor(place.x), top = floor(place.y);
  for (int k = 0; k < 4; ++k) {
    const float column = left + float(k % 2), row = top + float(k / 2);
    const float weight = tap_weight(place, column, row);
    if (column < 0.0 || column >= w || row < 0.0 || row >= h || !(weight > least_tap_weight())) continue;
    add(taps, seen, uint(row) * frame.width + uint(column), weight, place.pixel_width);
  }
}

Taps taps_of(PastSurfaceRecord seen, uint pixel) {
  Taps taps;
  taps.count = 0;
  if (frame.way_back == kSamePixel) {
    taps.pixel[0] = pixel;
    taps.weight[0] = 1.0;
    taps.count = 1;
  } else if (frame.way_back == kSameSurface || frame.way_back == kFourPixels) {
    const PastPlace place = place_in_past(past_view(), vector(seen.position));
    if (place.pixel_width > 0.0) {
      if (frame.way_back == kSameSurface) {
        add(taps, seen, pixel, 1.0, place.pixel_width);
      } else {
        add_neighbours(taps, seen, place);
      }
    }
    float sum = 0.0;
    for (int k = 0; k < taps.count; ++k) sum += taps.weight[k];
    for (int k = 0; k < taps.count; ++k) taps.weight[k] /= sum;
  }
  return taps;
}

Light past_mean(uint64_t means, Taps taps) {
  Light mean = kDarkness;
  if (means == 0ul) return mean;
  for (int k = 0; k < taps.count; ++k) {
    const Light there = noisy_light(means, 0ul, 1.0, taps.pixel[k]);
    mean.diffuse += there.diffuse * taps.weight[k];
    mean.specular += there.specular * taps.weight[k];
  }
  return mean;
}

Light mean_of(Light past, Light now, PastSurfaceRecord surface) {
  return Light(mean_with_this(past.diffuse, now.diffuse, surface.diffuse_frames),
               mean_with_this(past.specular, now.specular, surface.specular_frames));
}

PixelSums sums_of(Light light) { return PixelSums(numbers(light.diffuse), numbers(light.specular), 0u, 0u); }

void write(uint index, PastSurfaceRecord surface, Light indirect, Light many) {
  PastSurfaces(frame.present_surfaces).value[index] = surface;
  Means(frame.present_indirect).value[index] = sums_of(indirect);
  if (frame.present_many != 0ul) Means(frame.present_many).value[index] = sums_of(many);
  if (frame.frames != 0ul) Floats(frame.frames).value[index] = surface.diffuse_frames;
}

PastSurfaceRecord surface_of(PixelRecord pixel, uint material) {
  return PastSurfaceRecord(pixel.position, 0.0, pixel.normal, 0.0, pixel.geometric_normal, material);
}

// What the taps know: whose means go on, `surface` says of how many frames.
void go_on(uint index, PixelRecord pixel) {
  PastSurfaceRecord surface = surface_of(pixel, Surfaces(frame.surfaces).value[index].material);
  const Taps taps = taps_of(surface, index);
  for (int k = 0; k < taps.count; ++k) {
    const PastSurfaceRecord was = PastSurfaces(frame.past_surfaces).value[taps.pixel[k]];
    surface.diffuse_frames += was.diffuse_frames * taps.weight[k];
    surface.specular_frames += was.specular_frames * taps.weight[k];
  }
  if (surface.specular_frames > 0.0) {
    surface.specular_frames *= worth_of_reflection(vector(pixel.position), vector(frame.eye), vector(frame.past_eye),
                                                   pixel.ggx_alpha);
  }
  const Light now = noisy_light(frame.sums, frame.more_sums, frame.weight, index);
  const Light now_many = noisy_light(frame.many_sums, 0ul, frame.weight, index);
  const bool good = is_finite(now), many_good = is_finite(now_many);
  if (!good) atomicAdd(Counts(frame.counts).value.not_finite, 1u);
  if (!many_good) atomicAdd(Counts(frame.counts).value.many_not_finite, 1u);
  Light mean = past_mean(frame.past_indirect, taps), mean_many = past_mean(frame.past_many, taps);
  if (good && many_good) {
    surface.diffuse_frames = frames_with_this(surface.diffuse_frames, frame.most);
    surface.specular_frames = frames_with_this(surface.specular_frames, frame.most);
    mean = mean_of(mean, now, surface);
    mean_many = mean_of(mean_many, now_many, surface);
  } else if (surface.diffuse_frames == 0.0) {
    mean = now;  // there is nothing to make it good with
    mean_many = now_many;
  }
  write(index, surface, mean, mean_many);
}

void main() {
  frame = Frame(push.frame).value;
  const uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= frame.width || at.y >= frame.height) return;
  const uint index = at.y * frame.width + at.x;
  const PixelRecord pixel = Pixels(frame.pixels).value[index];
  if (is_finite(pixel.depth)) {
    go_on(index, pixel);
  } else {
    write(index, surface_of(pixel, 0xffffffffu), kDarkness, kDarkness);
  }
}
