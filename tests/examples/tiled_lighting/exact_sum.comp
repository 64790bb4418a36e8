// SPDX-License-Identifier: Apache-2.0
// The truth, and how much one stochastic frame may scatter around it: every light at every pixel, without tiles.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "equations/stochastic_range.h"

layout(local_size_x = 16, local_size_y = 16) in;

struct Light {
  vec3 position;        // [m]
  float range;          // [m]
  vec3 intensity;       // [W/sr]
  float falloff_floor;  // [1/m^2]
};
struct Surface {
  vec3 position;  // [m]
  float albedo;   // 0: nothing is seen here
  vec3 normal;
  float padding;
};
layout(std430, binding = 0) readonly buffer Lights { Light lights[]; };
layout(std430, binding = 1) readonly buffer Surfaces { Surface surfaces[]; };
layout(std430, binding = 2) writeonly buffer Picture { vec4 picture[]; };    // radiance, lights accepted on average
layout(std430, binding = 3) writeonly buffer Variance { vec4 variance[]; };  // of one frame's radiance
layout(push_constant) uniform Frame { uint width, height, light_count, frame; };

void main() {
  uint place = gl_GlobalInvocationID.y * width + gl_GlobalInvocationID.x;
  Surface surface = surfaces[place];
  vec4 sum = vec4(0.0);
  vec3 sum_of_variances = vec3(0.0);
  for (uint i = 0u; i < light_count; ++i) {
    vec3 to_light = lights[i].position - surface.position;
    float distance_sq = dot(to_light, to_light);
    float cosine = max(dot(surface.normal, to_light) * inversesqrt(distance_sq), 0.0);
    vec3 reflected = lights[i].intensity * (cosine * surface.albedo / 3.14159265);
    float falloff = fall_off(distance_sq);
    sum.rgb += reflected * falloff;
    sum.a += survival_probability(falloff, lights[i].falloff_floor);
    sum_of_variances += reflected * reflected * fall_off_variance(falloff, lights[i].falloff_floor);
  }
  picture[place] = sum;
  variance[place] = vec4(sum_of_variances, 0.0);
}
