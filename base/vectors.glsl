// SPDX-License-Identifier: Apache-2.0
// Between vectors and the arrays of shared records (shared_record.h).
#ifndef LUCIOLE_VECTORS_GLSL
#define LUCIOLE_VECTORS_GLSL

vec3 vector(float v[3]) { return vec3(v[0], v[1], v[2]); }
float[3] numbers(vec3 v) { return float[3](v.x, v.y, v.z); }

#endif
