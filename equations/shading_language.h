// SPDX-License-Identifier: Apache-2.0
// The only header that asks which language this is. The other equation headers are written in the common subset of
// C++, GLSL and HLSL: values in, values out; `select` instead of branches; constant trip counts; one return.
//
//   type      C++ scalar       C++ wide (16, 8 or 4 pixels)    GLSL     HLSL
//   real      float, double    SIMD register                   float    float
//   real2..4  struct           struct of registers             vec2..4  float2..4
//   uint_     std::uint32_t    integer register                uint     uint
//   mask      bool             lane mask                       bool     bool
//
// Beyond the functions that GLSL has: select(mask, a, b), inverse(x) (approximate in wide code, to 2e-7), inverse_sqrt,
// real_from_uint, uint_from_real (truncates), shift_left and shift_right (each lane by its own count). log2 is for
// normal positive numbers.
//
// C++ includes one of equations/cpp/float.h, double.h or wide.h, which define the types and read every header once in a
// namespace of their own; shaders include the headers that they need. Constants that a float cannot hold exactly are
// written LUCIOLE_REAL(3.14159265358979), so that the double instantiation keeps its digits.
#ifndef LUCIOLE_SHADING_LANGUAGE_H
#define LUCIOLE_SHADING_LANGUAGE_H

#if defined(GL_core_profile) || defined(GL_es_profile)
#if __VERSION__ < 500  // glslang reads HLSL with the macros of GLSL, as version 500
#define LUCIOLE_GLSL
#endif
#endif

#if defined(__cplusplus)

#if !defined(LUCIOLE_INSTANTIATING_EQUATIONS)
#error "In C++ include equations/cpp/float.h, equations/cpp/double.h or equations/cpp/wide.h instead of single headers."
#endif

#elif defined(LUCIOLE_GLSL)

#define LUCIOLE_FN
#define LUCIOLE_REAL(literal) literal
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#define uint_ uint
#define mask bool
#define select(condition, if_true, if_false) ((condition) ? (if_true) : (if_false))
#define inverse_sqrt inversesqrt
#define real_from_uint(u) float(u)
#define uint_from_real(x) uint(x)
#define shift_left(bits, by) ((bits) << (by))
#define shift_right(bits, by) ((bits) >> (by))
float inverse(float x) { return 1.0 / x; }  // beside GLSL's own, of matrices

#else  // HLSL

#define LUCIOLE_FN
#define LUCIOLE_REAL(literal) literal
#define real float
#define real2 float2
#define real3 float3
#define real4 float4
#define uint_ uint
#define mask bool
#define select(condition, if_true, if_false) ((condition) ? (if_true) : (if_false))
#define inverse_sqrt rsqrt
#define inverse(x) (1.0f / (x))
#define real_from_uint(u) float(u)
#define uint_from_real(x) uint(x)
#define shift_left(bits, by) ((bits) << (by))
#define shift_right(bits, by) ((bits) >> (by))

#endif

#endif
