// SPDX-License-Identifier: Apache-2.0
// The language of records that C++ and shaders share: a header in it is read by both, so that a struct is written once.
// Members are numbers of 4 bytes, arrays of these, and addresses; in scalar block layout they lie in shaders where C++
// puts them. Shaders pad nothing at the end, so whoever aligns a struct fills it up with a member `unused`.
#ifndef LUCIOLE_SHARED_RECORD_H
#define LUCIOLE_SHARED_RECORD_H

#if defined(__cplusplus)

#include <cstddef>
#include <cstdint>
#define LUCIOLE_RECORDS_BEGIN namespace luciole {
#define LUCIOLE_RECORDS_END }
#define LUCIOLE_ALIGNED(bytes) alignas(bytes)
namespace luciole {
using word_ = std::uint32_t;
using address_ = std::uint64_t;  // of device memory
}  // namespace luciole

#else  // GLSL, with GL_EXT_shader_explicit_arithmetic_types_int64

#define LUCIOLE_RECORDS_BEGIN
#define LUCIOLE_RECORDS_END
#define LUCIOLE_ALIGNED(bytes)
#define word_ uint
#define address_ uint64_t

#endif

#endif
