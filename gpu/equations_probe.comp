// SPDX-License-Identifier: Apache-2.0
// Every equation on the device, one input per invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "equations/equations_probe.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Inputs { ProbeInput value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Outputs { ProbeOutput value[]; };
layout(push_constant, scalar) uniform Push {
  Inputs inputs;
  Outputs outputs;
  uint count;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) outputs.value[i] = probe_equations(inputs.value[i]);
}
