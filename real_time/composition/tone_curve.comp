// SPDX-License-Identifier: Apache-2.0
// What a screen shows of a picture: exposure, tone curve, and the 8-bit codes of sRGB, which are looked up among their
// edges, so that a display-linear value has the code that a PNG file gives it (image/png.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "equations/shading_language.h"
#include "image/pbr_neutral.h"
#include "real_time/composition/composition_records.h"

layout(local_size_x = kPictureGroupColumns, local_size_y = kPictureGroupRows) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Colours { PixelColour value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Edges { float value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Codes { uint value[]; };
layout(push_constant, scalar) uniform Push { ToneCurvePush push; };

// By its bits: what comparisons say of numbers that are none is up to the device.
float number_or_zero(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u ? 0.0 : x; }

vec3 exposed(PixelColour colour) {
  const vec3 scaled = vec3(colour.rgb[0], colour.rgb[1], colour.rgb[2]) * push.exposure;
  return vec3(number_or_zero(scaled.x), number_or_zero(scaled.y), number_or_zero(scaled.z));
}

// How many edges the value has reached.
uint code_of(float display) {
  uint code = 0u;
  for (uint step = 128u; step > 0u; step /= 2u) {
    if (display >= Edges(push.edges).value[code + step - 1u]) code += step;
  }
  return code;
}

void main() {
  const uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= push.width || at.y >= push.height) return;
  const uint index = at.y * push.width + at.x;
  vec3 display = above_zero3(exposed(Colours(push.picture).value[index]));
  if (push.curve == uint(kPbrNeutralCurve)) display = pbr_neutral(display);
  display = within_unit3(display);
  Codes(push.codes).value[index] =
      code_of(display.x) | code_of(display.y) << 8 | code_of(display.z) << 16 | 0xff000000u;
}
