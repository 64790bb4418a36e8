// SPDX-License-Identifier: Apache-2.0
// What the tests of this room write: the number of the draw and a word that they push.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Corners { vec4 position[]; };
layout(push_constant, scalar) uniform Push {
  Corners corners;
  uint word;
};
layout(location = 0) flat in uint number;
layout(location = 0) out uvec2 words;

void main() { words = uvec2(number, word); }
