// SPDX-License-Identifier: Apache-2.0
// What the tests of this room dispatch: multiplies numbers; `count` is believed, so that a test can make it wrong.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 256) in;
layout(constant_id = 0) const uint kOffset = 0u;  // added to each product
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Numbers { float value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Products { float value[]; };
layout(push_constant, scalar) uniform Push {
  Numbers numbers;
  Products products;
  uint count;
  float factor;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) products.value[i] = numbers.value[i] * factor + float(kOffset);
}
